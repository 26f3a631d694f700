//! Parts of a run, and the merged report of all parts.

use super::{BAR, FAILED, Folder, SOUND, assert_contains};
use crate::common::{built_in_suite, valid_suite};
use approx::assert_relative_eq;
use mpm_verify::prelude::{Extent, Suite};
use mpm_verify::study::{Shard, estimate, estimates, unit_seconds};
use rstest::rstest;

fn suites() -> Folder {
    let folder = Folder::with("verification/a.yaml", BAR);
    let other = BAR.replace("short-bar", "other-bar").replace("[4, 6, 8, 12]", "[3, 6, 9, 12]");
    folder.write("verification/b.yaml", other.replace("scheme: musl", "scheme: [musl, usl]"));
    folder
}

fn in_parts(folder: &Folder, count: usize) -> Vec<String> {
    let parts = (1..=count).map(|number| {
        let (shard, kept) = (format!("{number}/{count}"), format!("part-{number}"));
        folder.accepted(&["run", "--shard", &shard, "--resume", &kept, "--brief"])
    });
    parts.collect()
}

fn merged(folder: &Folder, format: &str) -> String {
    let parts = ["--from", "part-1", "--from", "part-2", "--from", "part-3"];
    folder.accepted(&[&["merge", "--format", format][..], &parts].concat())
}

#[test]
fn merged_parts_equal_one_run_byte_for_byte() {
    let folder = suites();
    let parts = in_parts(&folder, 3);
    let cases = |text: &str| text.lines().filter(|line| line.contains("::")).count();
    assert_eq!(parts.iter().map(|part| cases(part)).sum::<usize>(), 5, "{parts:#?}");
    assert!(parts.iter().all(|part| cases(part) > 0), "{parts:#?}");
    for format in ["text", "json"] {
        assert_eq!(merged(&folder, format), folder.call(&["run", "--format", format]).out);
    }
}

#[test]
fn missing_result_fails_a_merge() {
    let folder = suites();
    in_parts(&folder, 3);
    folder.call(&["merge", "--from", "part-1", "--from", "part-2", "--brief"]).ended(FAILED);
    let report = folder.call(&["merge", "--from", "part-1", "--from", "part-2"]);
    assert_contains(&report.out, &["no folder has the result of"]);
    let errors = folder.refused(&["merge", "--from", "part-9"]);
    assert_contains(&errors, &["error: --from part-9: "]);
}

#[test]
fn a_part_without_a_case_passes() {
    let folder = Folder::with("verification/a.yaml", BAR);
    let found = folder.call(&["run", "--shard", "7/7"]);
    assert_eq!((found.code, found.out.as_str()), (SOUND, ""));
    insta::assert_snapshot!(found.errors, @"note: this shard has no case");
}

#[test]
fn a_part_is_one_of_several() {
    for shard in ["0/3", "4/3", "3", "a/b", "1/10001"] {
        assert_contains(&suites().refused(&["run", "--shard", shard]), &["such as `2/5`"]);
    }
}

#[test]
fn cases_are_selected_by_name() {
    let folder = suites();
    let found = folder.call(&["run", "--case", "flip-usl", "--brief"]);
    let cases: Vec<&str> = found.out.lines().filter(|line| line.contains("::")).collect();
    assert!(cases.len() == 1 && cases[0].contains("other-bar::mpm-linear-flip-usl"), "{cases:?}");
    let errors = folder.refused(&["run", "--case", "apic"]);
    insta::assert_snapshot!(errors, @"error: --case apic: no case name contains this text");
}

#[test]
fn json_list_has_the_predicted_costs() {
    let listed = suites().call(&["list", "--format", "json"]).ended(SOUND).json();
    assert_eq!(listed["suites"][1]["suite"], "other-bar");
    let case = &listed["suites"][0]["cases"][0];
    assert_eq!(case["case"], "mpm-linear-flip-musl");
    // 16 + 24 + 32 + 48 particles, 50 steps each, and 2.5e-7 s for each.
    assert_eq!(case["particle_steps"], 6000.0);
    assert_relative_eq!(case["seconds"].as_f64().expect("a number"), 1.5e-3, max_relative = 1e-12);
}

/// Creates a translation of a body of 3 x 2 x 1 m (or less) in a grid of 6 x 5 x 4 m, until 1 s.
fn moving(dimension: usize, dt: f64, schemes: &str) -> Suite {
    let list = |all: [&str; 3]| all[..dimension].join(", ");
    let (from, to, end) = (list(["1", "2", "3"]), list(["4"; 3]), list(["6", "5", "4"]));
    let (rest, ppc) = (list(["0"; 3]), 1 << dimension);
    let [velocity, displacement] = ["0.1", "\"0.1*t\""].map(|first| list([first, "0", "0"]));
    valid_suite(&format!(
        r"suite: moving-{dimension}
title: A translation
source: none
scene:
  dimension: {dimension}
  body: {{box: {{from: [{from}], to: [{to}]}}}}
  grid: {{from: [{rest}], to: [{end}]}}
  material: {{hencky: {{young: 1, poisson: 0, density: 1}}}}
  initial_velocity: [{velocity}]
exact: {{equation: hencky, displacement: [{displacement}]}}
run: {{until: 1, dt: {dt}}}
refine: {{cells: [6, 12], full: [24], ppc: {ppc}}}
methods: [{{mpm: {{basis: linear, transfer: flip, scheme: {schemes}}}}}]
"
    ))
}

/// With 2^D particles per cell of 1, 1/2 and 1/4 m, the bodies have 6, 24 and 48 particles on the
/// coarsest level, and 2^D times as many on each finer level. The grids of the last two levels have
/// 13 and 25, 13 x 11 and 25 x 21, and 13 x 11 x 9 and 25 x 21 x 17 nodes. The memory in bytes is
/// `100 * 12 + 40 * 13` (bar), `250 * 96 + 70 * 143` (plate) and `450 * 384 + 100 * 1287` (block).
#[rstest]
#[case::bar(1, [6.0, 12.0, 24.0], 2.5e-7, [1720.0, 2400.0 + 1000.0])]
#[case::plate(2, [24.0, 96.0, 384.0], 6e-7, [34_010.0, 250.0 * 384.0 + 70.0 * 525.0])]
#[case::block(3, [48.0, 384.0, 3072.0], 1.8e-6, [301_500.0, 450.0 * 3072.0 + 100.0 * 8925.0])]
fn predicted_costs_by_hand(
    #[case] dimension: usize,
    #[case] particles: [f64; 3],
    #[case] seconds: f64,
    #[case] bytes: [f64; 2],
) {
    let suite = moving(dimension, 0.1, "[musl, usl]");
    let [coarse, fine, full] = particles.map(|particles| 10.0 * particles);
    let whole = estimate(&suite).expect("levels");
    assert_eq!((whole.particle_steps, whole.bytes), (2.0 * (coarse + fine), bytes[0]));
    assert_relative_eq!(whole.seconds, seconds * whole.particle_steps, max_relative = 1e-14);
    let each = estimates(&suite, Extent::Full);
    let case = each[1].expect("levels");
    assert_eq!((each.len(), case.particle_steps), (2, coarse + fine + full));
    assert_eq!(case.bytes, bytes[1]);
    let units = unit_seconds(&suite, Extent::Full);
    let expected = [coarse, fine, full, coarse, fine, full].map(|steps| seconds * steps);
    assert_eq!(units.len(), 6);
    for (unit, expected) in units.into_iter().zip(expected) {
        assert_relative_eq!(unit, expected, max_relative = 1e-14);
    }
}

/// Each case costs 1 ms for its set-up. Its steps cost 7.776 ms (block), 7.2 ms (each of the two
/// plate cases) or 0.045 ms (bar). A case of another kind of study counts as 500 ms. The next case
/// always goes to the shard with the least load.
#[test]
fn expensive_cases_are_distributed_first() {
    let suites = [
        moving(1, 0.1, "musl"),
        moving(2, 0.01, "[musl, usl]"),
        moving(3, 0.1, "musl"),
        built_in_suite("grid-crossing"),
    ];
    let part = |number: usize, count: usize, extent: Extent, suites: &[Suite]| -> String {
        let shard: Shard = format!("{number}/{count}").parse().expect("a shard");
        let part = shard.of(suites, extent).into_iter();
        let named = part.map(|suite| format!("{}:{} ", &suite.name[..8], suite.case_names().len()));
        named.collect()
    };
    let others = suites[3].case_names().len();
    for (number, expected) in [(1, "moving-1:1 moving-3:1 "), (2, "moving-2:2 ")] {
        assert_eq!(part(number, 2, Extent::Usual, &suites[..3]), expected);
    }
    let all =
        [format!("grid-cro:{others} "), "moving-1:1 moving-3:1 ".into(), "moving-2:2 ".into()];
    let found =
        [1, 2, 3].map(|number| part(number + others - 1, others + 2, Extent::Usual, &suites));
    assert_eq!(found[1..], all[1..]);
    // With the finest level the block costs 63 ms, more than the other cases together.
    for (number, expected) in [(1, "moving-3:1 "), (2, "moving-1:1 moving-2:2 ")] {
        assert_eq!(part(number, 2, Extent::Full, &suites[..3]), expected);
    }
}

//! Parts of a run, and the merged report of all parts.

use super::{BAR, FAILED, Folder, SOUND, ambitious, assert_contains};
use rstest::rstest;
use serde_json::Value;

/// Creates two suites with two and three cases.
fn suites() -> Folder {
    let folder = Folder::with("verification/a.yaml", BAR);
    let other = BAR.replace("short-bar", "other-bar").replace("[4, 6, 8, 12]", "[3, 6, 9, 12]");
    folder.write("verification/b.yaml", other.replace("scheme: musl", "scheme: [musl, usl]"));
    folder
}

/// Runs every part with its own folder.
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

#[rstest]
#[case("0/3")]
#[case("4/3")]
#[case("3")]
#[case("a/b")]
#[case("1/10001")]
fn a_part_is_one_of_several(#[case] shard: &str) {
    let errors = suites().refused(&["run", "--shard", shard]);
    assert_contains(&errors, &["such as `2/5`"]);
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
    let folder = suites();
    folder.write("verification/c.yaml", ambitious());
    let found = folder.call(&["list", "--format", "json"]).ended(SOUND);
    let listed: Value = serde_json::from_str(&found.out).expect("JSON");
    let suites = listed["suites"].as_array().expect("a list");
    let names: Vec<&str> = suites.iter().filter_map(|suite| suite["suite"].as_str()).collect();
    assert_eq!(names, ["short-bar", "other-bar", "ambitious-bar"]);
    let case = &suites[0]["cases"][0];
    assert_eq!(case["case"], "mpm-linear-flip-musl");
    // 16 + 24 + 32 + 48 particles, 50 steps each.
    assert_eq!(case["particle_steps"], 6000.0);
    assert!(case["seconds"].as_f64().is_some_and(|seconds| seconds > 0.0), "{case}");
}

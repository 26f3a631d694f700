//! `run --gate`: each row of the table in `docs/gate.md`.

use super::bar;
use super::program::{folder_of as folder, solver_of as script};
use crate::cli::{BAD_INPUT, BAR, FAILED, Folder, SOUND, on_one_grid};
use crate::common::edited;
use crate::common::folder::{Answer, assert_contains, flat};
use rstest::rstest;

fn gate(folder: &Folder, targets: &[&str], options: &[&str]) -> Answer {
    let start = ["run", "--gate", "--brief", "--solver", "sh solver.sh"];
    folder.call(&[&start[..], options, targets].concat())
}

/// Creates the bar with a named solver, without other methods and without expectation.
fn naming_the_solver() -> String {
    let text =
        bar().replace("  - fem: {element: linear, mass: lumped}", "  - external: {name: odd}");
    text[..text.find("expect:").expect("expectations")].to_owned()
}

fn with_any_method(text: &str, keys: &str) -> String {
    text.replace("expect:", &format!("any_method: {{{keys}, because: theory}}\n\nexpect:"))
}

#[rstest]
#[case::the_order("h*h", SOUND, "pass")]
#[case::a_better_order("h*h*h*h", SOUND, "order reached")]
#[case::a_lower_order("h", FAILED, "FAIL")]
#[case::no_order("0.1", FAILED, "FAIL")]
#[case::rounding("1e-16", SOUND, "at rounding")]
#[case::nothing("0", SOUND, "at rounding")]
#[case::rounding_on_the_last_level("(h < 0.1 ? 1e-16 : 0.5 + 1.6*h)", FAILED, "FAIL")]
fn the_order_has_a_lower_bound(#[case] error: &str, #[case] code: i32, #[case] words: &str) {
    let folder = folder(error);
    let found = gate(&folder, &["bar.yaml"], &[]).ended(code);
    assert!(found.out.contains(words), "{}", found.out);
    // A case that passes must not count as a known limit.
    let report = folder.call(&["run", "--gate", "--solver", "sh solver.sh", "bar.yaml"]);
    assert_eq!(report.out.contains("  result        1 pass\n"), code == SOUND, "{}", report.out);
    let is_at_rounding = error.contains("1e-16") || error == "0";
    assert_eq!(report.out.contains("count as rounding"), is_at_rounding, "{}", report.out);
    assert_eq!(report.out.contains("no evidence"), error == "h*h*h*h", "{}", report.out);
}

/// Errors below the rounding bound determine no order. An error above the bound is judged, even in
/// single precision.
#[rstest]
#[case::below_the_rounding_bound("0.03", "explored", "leaves too few levels for an order")]
#[case::above_the_rounding_bound("0.5", "FAIL", "order")]
fn rounding_error_does_not_fail_the_gate(
    #[case] error: &str,
    #[case] result: &str,
    #[case] reason: &str,
) {
    let folder = folder(error);
    let single = script(error).replace("\"version\"", "\"precision\":\"single\",\"version\"");
    folder.write("solver.sh", single);
    let found = gate(&folder, &["bar.yaml"], &[]);
    // An individually named suite must be gated.
    assert_eq!(found.code, FAILED, "{}{}", found.out, found.errors);
    assert_contains(&found.out, &[result, reason]);
}

#[test]
fn every_case_of_a_solver_that_a_suite_names_is_gated() {
    for (error, code) in [("h*h", SOUND), ("h^0.2", FAILED)] {
        let folder = folder(error);
        folder.write("bar.yaml", naming_the_solver());
        gate(&folder, &["bar.yaml"], &[]).ended(code);
    }
}

#[rstest]
#[case::regularity("order: 1", "h", SOUND)]
#[case::below_the_regularity("order: 1", "0.1", FAILED)]
#[case::above_the_formal_order("order: 3", "h*h", SOUND)]
#[case::a_bound("error_below: 1e-4", "0.1", SOUND)]
#[case::above_the_bound("error_below: 1e-7", "0.1", FAILED)]
fn requirement_is_limited_by_any_method(
    #[case] keys: &str,
    #[case] error: &str,
    #[case] code: i32,
) {
    let folder = folder(error);
    folder.write("bar.yaml", with_any_method(&bar(), keys));
    gate(&folder, &["bar.yaml"], &[]).ended(code);
}

#[rstest]
#[case("", "this entry states no requirement")]
#[case("order: 0,", "the order is 0, but must be above zero")]
#[case("order: 21,", "expected an order up to 20")]
#[case("error_below: -1,", "the bound on errors is -1")]
#[case("any_law: true,", "depends on the law, because it is neither a translation nor a small")]
#[case("gated: false, order: 1,", "with `gated: false`, a required order or bound has no effect")]
#[case("orders: 1,", "did you mean `order`?")]
fn a_mistake_in_any_method(#[case] keys: &str, #[case] words: &str) {
    let folder = folder("h");
    let stated = format!("any_method: {{{keys} because: theory}}\n\nexpect:");
    // Large strains, at which the law matters.
    let bar = bar().replace("1e-3*sin", "sin");
    folder.write("bar.yaml", bar.replace("expect:", &stated));
    let found = gate(&folder, &["bar.yaml"], &[]).ended(BAD_INPUT);
    assert!(found.errors.contains(words), "no `{words}` in\n{}", found.errors);
}

/// One level determines no order. The suite is named individually, so the gate must not skip it.
#[test]
fn one_level_is_not_gated_unless_the_suite_has_bounds() {
    let folder = folder("h*h");
    let single = on_one_grid(&bar()).replace("short-bar", "single-bar");
    folder.write("suites/single.yaml", &single);
    folder.write("suites/bar.yaml", bar());
    let found = gate(&folder, &["suites/single.yaml", "suites/bar.yaml"], &[]).ended(FAILED);
    assert!(found.out.contains("explored  single-bar::odd"), "{}", found.out);
    assert!(found.out.contains("one level, and an order needs 4"), "{}", found.out);
    assert!(found.errors.contains("not applicable or explored: single-bar"), "{}", found.errors);
    let allowed = ["--allow-not-applicable"];
    gate(&folder, &["suites/single.yaml", "suites/bar.yaml"], &allowed).ended(SOUND);
    // A folder does not name a suite individually.
    assert_eq!(gate(&folder, &["suites"], &[]).code, SOUND);
    // Nothing is tested, so the gate fails.
    assert_eq!(gate(&folder, &["suites/single.yaml"], &allowed).code, FAILED);
    let bounded = single.replace("- order: [1.7, 2.3]", "- error_below: 1e-4");
    folder.write("suites/single.yaml", bounded);
    assert_eq!(gate(&folder, &["suites/single.yaml"], &[]).code, SOUND);
    // Other solvers need not satisfy the bound of the suite's own methods; they must satisfy
    // `any_method`.
    let own = single.replace("- order: [1.7, 2.3]", "- error_below: 1e-9");
    folder.write("suites/single.yaml", &own);
    let found = gate(&folder, &["suites/single.yaml"], &[]);
    assert!(found.out.contains("explored  single-bar::odd"), "{}", found.out);
    folder.write("suites/single.yaml", with_any_method(&own, "error_below: 1e-9"));
    let found = gate(&folder, &["suites/single.yaml"], &[]);
    assert!(found.out.contains("FAIL  single-bar::odd"), "{}", found.out);
}

#[test]
fn a_named_suite_that_is_not_applicable_fails_unless_allowed() {
    let folder = folder("h*h");
    let foreign = bar().replace("short-bar", "hencky-bar").replace("linear_elastic:", "hencky:");
    folder.write("foreign.yaml", foreign.replace("small_strain", "hencky\n  tolerance: 1e-2"));
    // The JUnit file must agree with the gate.
    let (both, junit) = (["bar.yaml", "foreign.yaml"], ["--junit", "junit.xml"]);
    let failures = || folder.read("junit.xml").matches("<failure ").count();
    let found = gate(&folder, &both, &junit).ended(FAILED);
    assert_eq!(failures(), 1);
    // The line below the case must name the missing capability.
    let lines = found.out.lines().skip_while(|line| !line.contains("hencky-bar"));
    let lines = lines.take(2).collect::<Vec<_>>().concat();
    assert!(lines.contains("not applicable  hencky-bar::odd"), "{lines}");
    assert!(lines.contains("lacks laws: hencky"), "{lines}");
    assert!(found.errors.contains("hencky-bar; `--allow-not-applicable`"), "{}", found.errors);
    gate(&folder, &both, &[&junit[..], &["--allow-not-applicable"]].concat()).ended(SOUND);
    assert_eq!(failures(), 0);
    assert_eq!(gate(&folder, &["foreign.yaml"], &["--allow-not-applicable"]).code, FAILED);
}

/// The suite has one time step on all levels. Shorter steps show whether this step limits the
/// order.
#[rstest]
#[case::an_error_in_time("h*h + 7000*d*d", SOUND)]
#[case::an_error_in_space("h + 7000*d*d", FAILED)]
#[case::an_error_that_no_step_reduces("h*h + 0.03", FAILED)]
fn shorter_steps_restore_the_order(#[case] error: &str, #[case] code: i32) {
    let folder = folder(error);
    folder.write("bar.yaml", BAR.replace("until: 0.05", "until: 0.004"));
    gate(&folder, &["bar.yaml"], &[]).ended(code);
}

/// In sums over the body, the mass of a solver's own point is its weight times the density.
#[rstest]
#[case::right_weights("", SOUND)]
#[case::half_the_weights("0.5*", FAILED)]
fn sums_over_points_of_the_solver_have_an_order(#[case] factor: &str, #[case] code: i32) {
    let ready = r#"printf '%s\n' "$problem" | awk '{
        x = substr($0, index($0, "\"reference_position\":[") + 22)
        x = substr(x, 1, index(x, "]") - 1)
        n = split(x, X, ",")
        for (p = 1; p <= n; p++) w = w (p > 1 ? "," : "") sprintf("%.17g", FACTOR 1/n)
        printf "{\"type\":\"ready\",\"points\":{\"reference_position\":[%s],\"weight\":[%s]}}\n", x, w
    }'"#;
    let folder = Folder::new();
    let ready = ready.replace("FACTOR", factor);
    folder.write("solver.sh", script("h*h").replace("echo '{\"type\":\"ready\"}'", &ready));
    let text = bar().replace("observe: {at: [0.5]}", "judge: {of: kinetic_energy}");
    let text = text.replace("  - fem: {element: linear, mass: lumped}\n", "");
    folder.write("bar.yaml", text);
    gate(&folder, &["bar.yaml"], &[]).ended(code);
}

/// Steps proportional to the cells are refined with them, so a first-order error in time lowers the
/// order. Shorter steps would make this error too small to be noticed.
#[test]
fn steps_that_follow_the_cells_are_not_shortened() {
    gate(&folder("h*h + 25*d"), &["bar.yaml"], &[]).ended(FAILED);
}

/// A translation is run under a law that the solver does not support. The problem then uses a law
/// of the solver.
#[test]
fn a_translation_needs_no_particular_law() {
    let folder = folder("0");
    let elastic = "linear_elastic: {young: 100, poisson: 0, density: 1}";
    let moving = edited(
        &bar(),
        &[
            ("short-bar", "moving-block"),
            ("parameters:\n  omega: \"5*pi\"\n", ""),
            ("[1]}}\n", "[1]}}\n  grid: {from: [0], to: [2]}\n"),
            (elastic, "corotated: {young: 3, poisson: 0.25, density: 1}"),
            ("  boundary: {left: fixed}\n", ""),
            ("\"1e-3*sin(pi*X/2)\"", "0.1"),
            ("small_strain", "corotated"),
            ("1e-3*sin(pi*X/2)*sin(omega*t)/omega", "0.1*t"),
            ("until: 0.004, dt: \"h/250\"", "until: 0.05, dt: 1e-2"),
            ("  - fem: {element: linear, mass: lumped}\n", ""),
            ("observe: {at: [0.5]}\n", ""),
            ("order: [1.7, 2.3]", "error_below: 1e-12"),
        ],
    );
    folder.write("moving.yaml", &moving);
    let script = folder.read("solver.sh");
    let script = script.replace("s * sin(5 * pi * t) / (5 * pi)", "0.1 * t");
    let script = script.replace("s * cos(5 * pi * t)", "0.1");
    let logged = script.replace(
        "echo '{\"type\":\"ready\"}'",
        "echo \"$problem\" >>log; echo '{\"type\":\"ready\"}'",
    );
    folder.write("solver.sh", logged);
    let found = gate(&folder, &["moving.yaml"], &[]).ended(FAILED);
    assert!(found.out.contains("lacks laws: corotated"), "{}", found.out);
    folder.write("moving.yaml", with_any_method(&moving, "any_law: true"));
    let found = gate(&folder, &["moving.yaml"], &[]).ended(SOUND);
    assert!(found.out.contains("at rounding"), "{}", found.out);
    let problem = folder.read("log");
    assert_contains(&problem, &[r#""law":"linear_elastic""#, r#""young":3"#, r#""poisson":0.25"#]);
}

#[rstest]
#[case::a_formal_order("formal_order: 1", "h", SOUND, "order at least 0.90")]
#[case::a_higher_formal_order("formal_order: 3", "h*h", FAILED, "order at least 2.90")]
#[case::an_order("short-bar: {order: 1, because: a}", "h", SOUND, "order at least 0.90")]
#[case::a_bound("short-*: {error_below: 1e-4, because: a}", "0.1", SOUND, "within bounds")]
#[case::above_the_bound("short-*: {error_below: 1e-9, because: a}", "0.1", FAILED, "FAIL")]
#[case::the_first_that_fits(
    "short-bar: {order: 1, because: a}, '*': {order: 2, because: b}",
    "h",
    SOUND,
    "pass"
)]
#[case::an_exception("short-bar: {skip: soft walls}", "0.1", SOUND, "known limit  short-bar::odd")]
fn a_configuration_with(
    #[case] text: &str,
    #[case] error: &str,
    #[case] code: i32,
    #[case] words: &str,
) {
    let folder = folder(error);
    let is_of_solver = text.starts_with("formal_order");
    let config = if is_of_solver { text.to_owned() } else { format!("suites: {{{text}}}\n") };
    folder.write("solver.yaml", config);
    let found = gate(&folder, &["bar.yaml"], &["--solver-config", "solver.yaml"]).ended(code);
    assert!(found.out.contains(words), "no `{words}` in\n{}", found.out);
    if text.contains("skip") {
        for text in [&found.out, &found.errors] {
            assert!(text.contains("soft walls"), "{}{}", found.out, found.errors);
        }
    }
}

#[rstest]
#[case::an_unknown_suite("suites:\n  short-baz: {skip: why}\n", &["solver.yaml:2:3", "no suite has the name `short-baz`", "did you mean `short-bar`?"])]
#[case::an_unknown_pattern("suites:\n  long-*x: {skip: why}\n", &["no suite has the name `long-*x`", "`*` stands for any text"])]
#[case::an_unknown_key("formal-order: 2\n", &["solver.yaml:1:1", "did you mean `formal_order`?"])]
#[case::an_unknown_key_of_a_suite("suites:\n  short-bar: {skipp: why}\n", &["solver.yaml:2:15", "did you mean `skip`?"])]
#[case::text_for_a_number("formal_order: two\n", &["solver.yaml:1:15", "two"])]
#[case::no_order("formal_order: 0\n", &["the order is 0", "expected a number above 0 and up to 20"])]
#[case::not_a_number("suites:\n  short-bar: {order: .nan, because: why}\n", &["solver.yaml:2:22", "a finite number is expected here"])]
#[case::no_bound("suites:\n  short-bar: {error_below: 0, because: why}\n", &["the bound on errors is 0"])]
#[case::no_terms("suites:\n  short-bar: {}\n", &["solver.yaml:2:3", "this entry states no order, no bound"])]
#[case::no_reason("suites:\n  short-bar: {order: 1}\n", &["an order or a bound needs a reason"])]
#[case::an_empty_reason("suites:\n  short-bar: {skip: ''}\n", &["the reason is empty"])]
#[case::an_order_that_is_skipped("suites:\n  short-bar: {order: 1, skip: why}\n", &["remove `skip`"])]
#[case::a_suite_twice("suites:\n  short-bar: {skip: a}\n  short-bar: {skip: b}\n", &["short-bar"])]
fn a_mistake_in_a_configuration(#[case] text: &str, #[case] words: &[&str]) {
    let folder = folder("h");
    folder.write("solver.yaml", text);
    let found = gate(&folder, &["bar.yaml"], &["--solver-config", "solver.yaml"]).ended(BAD_INPUT);
    assert_contains(&found.errors, words);
    let none = gate(&folder, &["bar.yaml"], &["--solver-config", "none.yaml"]).ended(BAD_INPUT);
    assert_contains(&none.errors, &["none.yaml"]);
}

/// External solvers cannot run studies of the internals of a method.
#[test]
fn a_named_study_of_a_method_fails_unless_allowed() {
    let folder = folder("h*h");
    let targets = ["bar.yaml", "grid-crossing"];
    assert_eq!(gate(&folder, &targets, &[]).code, FAILED);
    assert_eq!(gate(&folder, &targets, &["--allow-not-applicable"]).code, SOUND);
}

/// Errors as large as the solution are a defect of the solver, and are not due to levels or
/// smoothness.
#[test]
fn diagnosis_recommends_doctor_for_errors_as_large_as_the_solution() {
    let folder = folder("-2");
    folder.write("bar.yaml", naming_the_solver());
    let found = folder.call(&["diagnose", "bar.yaml", "--solver", "sh solver.sh"]).ended(SOUND);
    let words = flat(&found.out);
    assert!(words.contains("the solver solves another problem"), "{words}");
    assert!(words.contains("`mpm-verify doctor` with the same `--solver`"), "{words}");
    assert!(!words.contains("not smooth"), "{words}");
}

/// A stability study is gated if an entry of `expect` has `any_method`. The energy of the exact
/// motion is constant.
#[rstest]
#[case::without_an_entry("", FAILED, "the suite states no expectation with `any_method`")]
#[case::that_is_met("figures: {energy_kept: {above: 0.99, below: 1.01}}", SOUND, "pass")]
#[case::that_is_not_met("figures: {energy_kept: {below: 0.9}}", FAILED, "FAIL")]
fn a_stability_study(#[case] figures: &str, #[case] code: i32, #[case] words: &str) {
    let folder = folder("0");
    let stress = r#"w = w (p > 1 ? "," : "") sprintf("%.17g", cos(pi*X[p]/2)*sin(5*pi*t)/100)"#;
    let edits = [
        (r#"["free","fixed"]"#, r#"["free","fixed"],"columns":["stress"]"#.to_owned()),
        (r#"\"velocity\":[%s]}"#, r#"\"velocity\":[%s],\"stress\":[%s]}"#.to_owned()),
        (r#"\n", u, v"#, r#"\n", u, v, w"#.to_owned()),
        (
            "            }\n            printf",
            format!("{stress}\n            }}\n            printf"),
        ),
    ];
    let script = edits.iter().fold(folder.read("solver.sh"), |script, (from, to)| {
        assert!(script.contains(from), "no `{from}`");
        script.replace(from, to)
    });
    folder.write("solver.sh", script);
    let (scene, _) = BAR.split_once("exact:").unwrap();
    let study = "particles: {cells: 8, ppc: 2}
run: {dt: 0.01, steps: 40}
sweep: {a: [1e-3]}
methods: [{mpm: {basis: linear, transfer: flip, scheme: musl}}]
expect:
  - {verdict: stable, because: a test}
";
    let entry = format!("  - {{any_method: true, {figures}, because: a test}}\n");
    let entry = if figures.is_empty() { "" } else { &entry };
    let scene = scene.replace("omega: \"5*pi\"", "a: 1e-3").replace("1e-3*sin", "a*sin");
    let scene = scene.replace("source:", "study: stability\nsource:");
    folder.write("stability.yaml", format!("{scene}{study}{entry}"));
    let found = gate(&folder, &["stability.yaml"], &[]).ended(code);
    assert!(found.out.contains(words), "{}", found.out);
}

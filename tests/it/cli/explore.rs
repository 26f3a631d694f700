//! Suites without expectations: the output of a run, and the expectations that it suggests.

use super::{BAD_INPUT, BAR, Folder, SOUND, assert_contains};
use serde_json::Value;

/// Returns the part of a suite before `expect`.
fn open(text: &str) -> &str {
    text.split("expect:").next().expect("the part before")
}

#[test]
fn suite_without_expectations_reports_results_and_passes() {
    let folder = Folder::with("bar.yaml", open(BAR));
    let found = folder.call(&["run", "bar.yaml"]);
    assert_eq!(found.code, SOUND, "{}{}", found.out, found.errors);
    assert_contains(
        &found.out,
        &[
            "  mpm-linear-flip-musl  explored ",
            "  a   nothing: neither the suite nor a gate has an expectation for it",
            "result        2 explored",
            "\n  conservation, all levels: largest change since t = 0, divided by the sum of magnitudes \
             over the\n  body\n",
        ],
    );
    let note = "note: short-bar has no expectations, so it is not a gate";
    assert!(found.errors.starts_with(note), "{}", found.errors);
    let checked = folder.call(&["check", "bar.yaml"]);
    assert!(checked.out.ends_with("; no expectation, so it is not a gate\n"), "{}", checked.out);
    let json = folder.call(&["run", "bar.yaml", "--format", "json"]).out;
    let document: Value = serde_json::from_str(&json).expect("one document");
    let case = &document["suites"][0]["cases"][0];
    assert!(case["expected"].is_null() && case["passed"] == true, "{case}");
    assert!(case["observed_order"]["value"].is_f64(), "{case}");
}

#[test]
fn failed_run_does_not_fail_a_suite_without_expectations() {
    let folder = Folder::new();
    let long = open(BAR).replace("dt: 1e-3", "dt: 0.2").replace("until: 0.05", "until: 20");
    folder.write("bar.yaml", long);
    let found = folder.call(&["run", "bar.yaml", "--brief"]);
    assert_eq!(found.code, SOUND, "{}{}", found.out, found.errors);
    assert_contains(&found.out, &["failed"]);
}

/// Two cases with different orders: FEM starts as a leapfrog, MPM with `v(0)`.
const STEPS: &str = r#"suite: steps
title: Steps
source: a textbook
parameters: {omega: "5*pi"}
scene:
  dimension: 1
  body: {box: {from: [0], to: [1]}}
  material: {linear_elastic: {young: 100, poisson: 0, density: 1}}
  boundary: {left: fixed}
  initial_velocity: ["1e-3*sin(pi*X/2)"]
exact:
  equation: small_strain
  displacement: ["1e-3*sin(pi*X/2)*sin(omega*t)/omega"]
run: {until: 0.05, dt: "h/100"}
refine: {cells: [4, 6, 8, 12, 16], ppc: 4}
methods:
  - mpm: {basis: linear, transfer: flip, scheme: musl}
  - fem: {element: linear, mass: lumped}
"#;

#[test]
fn what_is_proposed_passes() {
    let folder = Folder::with("open.yaml", STEPS);
    let proposed = folder.call(&["propose", "open.yaml"]);
    assert_eq!(proposed.code, SOUND, "{}", proposed.errors);
    folder.write("gated.yaml", format!("{STEPS}{}", proposed.out));
    let found = folder.call(&["run", "gated.yaml", "--brief"]);
    assert_eq!(found.code, SOUND, "{}\n{}{}", proposed.out, found.out, found.errors);
    assert_contains(&found.out, &["pass  steps::"]);
    assert!(!found.errors.contains("not a gate"), "{}", found.errors);
    assert_contains(
        &proposed.out,
        &["order: [1.9, 2.1]  # from theory", "mass: 1e-14", "# from the run"],
    );
}

#[test]
fn expectations_are_proposed_for_chosen_cases() {
    let folder = Folder::with("open.yaml", STEPS);
    let found = folder.call(&["propose", "open.yaml", "--case", "fem"]);
    assert_eq!(found.code, SOUND, "{}", found.errors);
    assert!(found.out.contains("order:") && !found.out.contains("mpm-linear"), "{}", found.out);
    let found = folder.call(&["propose", "open.yaml", "--case", "fen"]);
    assert_eq!(found.code, BAD_INPUT, "{}", found.out);
    insta::assert_snapshot!(found.errors, @"error: steps: no case name contains the text of `--case`");
}

#[test]
fn proposals_do_not_depend_on_existing_expectations() {
    let folder = Folder::new();
    let wrong = "expect:\n  - order: [3.9, 4.1]\n    because: a guess\n";
    folder.write("open.yaml", STEPS);
    folder.write("wrong.yaml", format!("{STEPS}{wrong}"));
    let proposals = ["open.yaml", "wrong.yaml"].map(|file| folder.call(&["propose", file]).out);
    assert_eq!(proposals[0], proposals[1]);
}

/// In addition to the results of the run, a proposal states the gain of a smaller amplitude.
#[test]
fn proposal_states_the_effect_of_the_amplitude() {
    let folder = Folder::with("large.yaml", STEPS.replace("1e-3*", "0.1*"));
    let found = folder.call(&["propose", "large.yaml"]);
    assert_eq!(found.code, SOUND, "{}", found.errors);
    let begin = found.out.split("expect:").next().expect("the part before");
    for words in ["the exact solution assumes small strains", "a tenth of the amplitude reduces"] {
        assert!(begin.replace("\n# ", " ").contains(words), "no `{words}` in\n{begin}");
    }
}

#[test]
fn only_convergence_studies_have_proposals() {
    let folder = Folder::new();
    let found = folder.call(&["propose", "courant-limit"]);
    assert_eq!(found.code, BAD_INPUT);
    insta::assert_snapshot!(found.errors, @"error: courant-limit: expectations are proposed for convergence studies only");
}

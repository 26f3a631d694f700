//! Suites without expectations: the output of a run, and the expectations that it suggests.

use super::json::document;
use super::{BAD_INPUT, BAR, Folder, SOUND, assert_contains};

fn open(text: &str) -> &str {
    text.split("expect:").next().expect("the part before")
}

#[test]
fn suite_without_expectations_reports_results_and_passes() {
    let folder = Folder::with("bar.yaml", open(BAR));
    let found = folder.call(&["run", "bar.yaml"]).ended(SOUND);
    assert_contains(
        &found.out,
        &[
            "  mpm-linear-flip-musl  explored ",
            "  a   nothing: neither the suite nor a gate has an expectation for it",
            "result        2 explored",
        ],
    );
    let note = "note: short-bar has no expectations, so it is not a gate";
    assert!(found.errors.starts_with(note), "{}", found.errors);
    let checked = folder.call(&["check", "bar.yaml"]);
    assert!(checked.out.ends_with("; no expectation, so it is not a gate\n"), "{}", checked.out);
    let document = document(&folder, &["bar.yaml"], SOUND);
    let case = &document["suites"][0]["cases"][0];
    assert!(case["expected"].is_null() && case["passed"] == true, "{case}");
    assert!(case["observed_order"]["value"].is_f64(), "{case}");
}

#[test]
fn failed_run_does_not_fail_a_suite_without_expectations() {
    let folder = Folder::new();
    let long = open(BAR).replace("dt: 1e-3", "dt: 0.2").replace("until: 0.05", "until: 20");
    folder.write("bar.yaml", long);
    let found = folder.call(&["run", "bar.yaml", "--brief"]).ended(SOUND);
    assert_contains(&found.out, &["failed"]);
}

/// Creates a suite with two cases of different orders: FEM starts as a leapfrog, MPM with `v(0)`.
fn steps() -> String {
    let text = open(BAR).replace("short-bar", "steps").replace("dt: 1e-3", "dt: \"h/100\"");
    text.replace("[4, 6, 8, 12]", "[4, 6, 8, 12, 16]").replace("observe: {at: [0.5]}\n", "")
}

#[test]
fn what_is_proposed_passes() {
    let folder = Folder::with("open.yaml", steps());
    let proposed = folder.call(&["propose", "open.yaml"]).ended(SOUND);
    folder.write("gated.yaml", format!("{}{}", steps(), proposed.out));
    let found = folder.call(&["run", "gated.yaml", "--brief"]).ended(SOUND);
    assert_contains(&found.out, &["pass  steps::"]);
    assert!(!found.errors.contains("not a gate"), "{}", found.errors);
    let parts = ["order: [1.9, 2.1]  # from theory", "mass: 1e-14", "# from the run"];
    assert_contains(&proposed.out, &parts);
}

#[test]
fn expectations_are_proposed_for_chosen_cases() {
    let folder = Folder::with("open.yaml", steps());
    let found = folder.call(&["propose", "open.yaml", "--case", "fem"]).ended(SOUND);
    assert!(found.out.contains("order:") && !found.out.contains("mpm-linear"), "{}", found.out);
    let found = folder.call(&["propose", "open.yaml", "--case", "fen"]).ended(BAD_INPUT);
    insta::assert_snapshot!(found.errors, @"error: steps: no case name contains the text of `--case`");
}

#[test]
fn proposals_do_not_depend_on_existing_expectations() {
    let folder = Folder::new();
    let wrong = "expect:\n  - order: [3.9, 4.1]\n    because: a guess\n";
    folder.write("open.yaml", steps());
    folder.write("wrong.yaml", steps() + wrong);
    let proposals = ["open.yaml", "wrong.yaml"].map(|file| folder.call(&["propose", file]).out);
    assert_eq!(proposals[0], proposals[1]);
}

/// In addition to the results of the run, a proposal states the gain of a smaller amplitude.
#[test]
fn proposal_states_the_effect_of_the_amplitude() {
    let folder = Folder::with("large.yaml", steps().replace("1e-3*", "0.1*"));
    let found = folder.call(&["propose", "large.yaml"]).ended(SOUND);
    let begin = found.out.split("expect:").next().expect("the part before");
    for words in ["the exact solution assumes small strains", "a tenth of the amplitude reduces"] {
        assert!(begin.replace("\n# ", " ").contains(words), "no `{words}` in\n{begin}");
    }
}

#[test]
fn only_convergence_studies_have_proposals() {
    let folder = Folder::new();
    let found = folder.call(&["propose", "courant-limit"]).ended(BAD_INPUT);
    insta::assert_snapshot!(found.errors, @"error: courant-limit: expectations are proposed for convergence studies only");
}

//! The command line: outputs, and exit status.

mod arguments;
mod check;
mod compare;
mod estimate;
mod explain;
mod explore;
mod exports;
mod hostile;
#[cfg(unix)]
mod interrupt;
mod json;
mod new;
mod page;
mod plans;
mod printed;
mod problem;
mod run;
mod shards;
mod snapshots;
mod steps;
mod time_series;

pub(crate) use crate::common::folder::{Folder, assert_contains, without_files};
use rstest::rstest;

/// Exit status of a run without a failure.
pub(crate) const SOUND: i32 = 0;

/// Exit status if some expectation was not met.
pub(crate) const FAILED: i32 = 1;

/// Exit status if an input cannot be used.
pub(crate) const BAD_INPUT: i32 = 2;

/// A suite with two cases that runs in milliseconds.
pub(crate) const BAR: &str = r#"suite: short-bar
title: Short bar
source: a textbook

parameters:
  omega: "5*pi"

scene:
  dimension: 1
  body: {box: {from: [0], to: [1]}}
  material: {linear_elastic: {young: 100, poisson: 0, density: 1}}
  boundary: {left: fixed}
  initial_velocity: ["1e-3*sin(pi*X/2)"]

exact:
  equation: small_strain
  displacement: ["1e-3*sin(pi*X/2)*sin(omega*t)/omega"]

run: {until: 0.05, dt: 1e-3}
refine: {cells: [4, 6, 8, 12], ppc: 4}

methods:
  - mpm: {basis: linear, transfer: flip, scheme: musl}
  - fem: {element: linear, mass: lumped}

observe: {at: [0.5]}

expect:
  - order: [1.7, 2.3]
    because: linear basis functions have order 2
"#;

/// Changes the cells of a suite like [`BAR`] to one level. Each level is timed for a while, and
/// some tests need only one.
pub(crate) fn on_one_grid(suite: &str) -> String {
    suite.replace("[4, 6, 8, 12]", "[4]")
}

/// Asserts the messages of refused calls, each below `$ ` and its arguments.
pub(crate) fn assert_refusals(folder: &Folder, expected: &str) {
    for (call, message) in expected.split("\n$ ").filter_map(|call| call.split_once('\n')) {
        let arguments = shlex::split(call).expect("arguments");
        let errors = folder.refused(&arguments.iter().map(String::as_str).collect::<Vec<_>>());
        let lines = errors.lines().filter(|line| !line.is_empty() && !line.starts_with("For more"));
        assert_eq!(lines.collect::<Vec<_>>().join("\n"), message.trim_end(), "{call}");
    }
}

/// Creates a [`BAR`] with an expectation that it does not meet.
fn ambitious() -> String {
    BAR.replace("short-bar", "ambitious-bar").replace("[1.7, 2.3]", "[2.9, 3.1]")
}

/// Creates a [`BAR`] with a mistake in line nine.
fn mistaken() -> String {
    BAR.replace("short-bar", "mistaken-bar").replace("dimension:", "dimensions:")
}

#[test]
fn built_in_suites_are_listed_without_a_folder() {
    let folder = Folder::new();
    let out = folder.accepted(&["list"]);
    assert!(out.lines().count() <= 40, "{out}");
    let parts = ["\nthe-talk                          14 suites    61 cases\n", "\nnext: "];
    assert_contains(&out, &parts);
    let out = folder.accepted(&["list", "--cases"]);
    for line in ["oedometer: Oedometer at large strain", "  mpm-linear-flip-usl-vs-exact"] {
        assert!(out.lines().any(|found| found == line), "{out}");
    }
}

#[test]
fn folder_of_suites_replaces_the_built_in_ones() {
    let folder = Folder::with("verification/short-bar.yaml", BAR);
    folder.write("verification/notes.txt", "not a suite");
    let wanted = "short-bar: Short bar\n1 suite, 2 cases\n";
    assert_eq!(folder.call(&["list"]).out, wanted);
    assert_eq!(folder.call(&["list", "short-bar"]).out, wanted);
    assert_eq!(folder.call(&["list", "verification"]).out, wanted);
    // Built-in suites can still be selected by name.
    assert!(folder.call(&["list", "oedometer"]).out.starts_with("oedometer: "));
}

/// A list does not check solutions.
#[test]
fn suite_with_a_wrong_solution_is_listed() {
    let wrong = BAR.replace("omega: \"5*pi\"", "omega: \"6*pi\"");
    let folder = Folder::with("verification/short-bar.yaml", &wrong);
    assert!(folder.accepted(&["list"]).starts_with("short-bar: Short bar\n"));
    assert!(folder.refused(&["explain"]).contains("not a solution"));
}

#[test]
fn suite_may_be_in_any_folder() {
    let folder = Folder::new();
    let path = folder.write("some where/bar.yaml", BAR);
    for target in ["some where/bar.yaml", "some where", path.to_str().expect("a name")] {
        let found = folder.call(&["check", target]);
        let line = "short-bar: sound, 2 cases, about ";
        assert!(found.code == SOUND && found.out.starts_with(line), "{}", found.out);
    }
}

#[test]
fn check_reports_valid_and_invalid_suites() {
    let folder = Folder::with("a.yaml", BAR);
    folder.write("b.yaml", mistaken());
    folder
        .write("c.yaml", BAR.replace("short-bar", "c-bar").replace("sin(omega*t)", "cos(omega*t)"));
    assert_eq!(folder.call(&["check", "a.yaml"]).code, SOUND);
    let found = folder.call(&["check", "."]);
    assert_eq!((found.code, found.out.lines().count()), (BAD_INPUT, 1));
    assert!(found.out.starts_with("short-bar: sound, 2 cases"), "{}", found.out);
    insta::assert_snapshot!(found.errors, @r#"
    error: unknown key `dimensions`
     --> ./b.yaml:9:3
      |
    9 |   dimensions: 1
      |   ^^^^^^^^^^ not a known key
      |
      = help: did you mean `dimension`?
    error: initial condition u_X(X, 0) = 0 is violated at X = (0.913473), t = 0.000000: expected
           0.000000e0, found 6.307486e-5 m (off by 6.307e-5, at most 6.4e-13 allowed)
      --> ./c.yaml:17:18
       |
    17 |   displacement: ["1e-3*sin(pi*X/2)*cos(omega*t)/omega"]
       |                  ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ this is not a solution of the problem that the scene states
       |
       = help: correct the formula, or the scene: loads, boundary, initial state
    2 errors, 2 notes (printed with `--notes`, or for suites that are named)
    "#);
}

#[test]
fn built_in_suites_have_no_errors_or_warnings() {
    let answer = Folder::new().call(&["check", "--strict"]).ended(SOUND);
    assert!(answer.out.lines().all(|line| line.contains(": sound, ")), "{}", answer.out);
    assert!(!answer.errors.contains("warning: "), "{}", answer.errors);
}

#[test]
fn every_command_refuses_names_and_folders_without_a_suite() {
    let folder = Folder::with("empty/notes.txt", "nothing");
    for command in ["list", "check", "explain", "run", "cost"] {
        let words = ["there is no suite called `odometer`", "did you mean `oedometer`?"];
        assert_contains(&folder.refused(&[command, "odometer"]), &words);
        let errors = folder.refused(&[command, "empty"]);
        assert_contains(&errors, &["this folder contains no suite"]);
    }
}

#[rstest]
#[case::the_nearest_and_not_the_first("vibratin-bar", "did you mean `vibrating-bar`?")]
#[case::a_local_one("shrot-bar", "did you mean `short-bar`?")]
#[case::a_file_beside(
    "verification/short-baar.yaml",
    "did you mean `verification/short-bar.yaml`?"
)]
#[case::a_file_that_is_built_in("oedometre.yaml", "did you mean the suite `oedometer`?")]
#[case::none("zzz", "`mpm-verify list` shows the ")]
fn existing_suites_are_suggested(#[case] name: &str, #[case] help: &str) {
    let folder = Folder::with("verification/short-bar.yaml", BAR);
    let errors = folder.refused(&["check", name]);
    assert_contains(&errors, &[help]);
}

#[rstest]
#[case("chek", "did you mean the command `check`?")]
#[case("lst", "did you mean the command `list`?")]
#[case("odometer", "did you mean `oedometer`?")]
fn misspelt_command_gets_a_suggestion(#[case] word: &str, #[case] help: &str) {
    for words in [&[word][..], &[word, "--strict", "bar.yaml"], &["--color", "never", word]] {
        let errors = Folder::new().refused(words);
        let understood = help.contains("command") || !words.contains(&"--strict");
        assert_eq!(errors.contains(help), understood, "{errors}");
    }
    let behind_a_command = Folder::new().call(&["check", "chek"]);
    assert!(!behind_a_command.errors.contains("command"), "{}", behind_a_command.errors);
}

#[test]
fn more_similar_suite_is_suggested_instead_of_a_command() {
    let folder = Folder::with("verification/checks.yaml", BAR);
    let found = folder.call(&["cheks"]);
    insta::assert_snapshot!(found.errors, @"
    error: there is no suite called `cheks`
    --> cheks
     = help: did you mean `checks`?
    ");
}

//! Suites of a folder as tests: suites that pass, that fail, and that do neither.

use super::conformance::{Fault, FaultySubject};
use super::own_solver::{OwnSolver, SWINGING_BAR};
use crate::common::folder::Folder;
use crate::common::solver::solver;
use mpm_verify::prelude::*;

const SNAPSHOT: &str = include_str!("../../../examples/own_solver/suites/swinging-bar.snap");

/// Creates a folder with the suite of the example, and its snapshot in another folder.
fn folder() -> Folder {
    let folder = Folder::with("suites/swinging-bar.yaml", SWINGING_BAR);
    folder.write("kept/swinging-bar.snap", SNAPSHOT);
    folder
}

fn tests(folder: &Folder) -> SuiteFolder {
    let path = |name| folder.path().join(name);
    SuiteFolder::new(path("suites")).snapshots(path("kept")).judging(OwnSolver)
}

/// Creates the suite with an expectation for the solver.
fn stated(expected: &str) -> String {
    let methods = "  - external: {name: own-solver}\n";
    format!("{SWINGING_BAR}{methods}expect:\n  - {expected}\n    because: linear functions\n")
}

/// Runs the tests that the arguments select. Returns whether they pass, and the printed text.
fn run(tests: &SuiteFolder, arguments: &[&str]) -> (bool, String) {
    let folder = Folder::new();
    let log = folder.path().join("log").display().to_string();
    let words = ["tests", "--logfile", &log].into_iter().chain(arguments.iter().copied());
    (tests.run(words), folder.read("log"))
}

/// Whether the test of this name passes, or all tests if there is no name.
fn passes(tests: &SuiteFolder, name: Option<&str>) -> bool {
    run(tests, &name.map_or(vec![], |name| vec!["--exact", name])).0
}

#[test]
fn a_solver_passes_by_theory_contract_and_snapshot() {
    let (passed, said) = run(&tests(&folder()), &[]);
    assert!(passed && said.contains("3 passed; 0 failed; 0 ignored"), "{said}");
}

/// The tests are listed as nextest requests it.
#[test]
fn tests_have_names() {
    let (_, said) = run(&tests(&folder()), &["--list", "--format", "terse"]);
    let names = ["swinging-bar::own-solver", "swinging-bar::conformance", "swinging-bar::report"];
    assert_eq!(said.lines().collect::<Vec<_>>(), names.map(|name| format!("{name}: test")));
}

#[test]
fn theory_and_snapshot_checks_are_independent() {
    let folder = folder();
    folder.write("suites/swinging-bar.yaml", stated("order: [0.9, 1.1]"));
    assert!(!passes(&tests(&folder), Some("swinging-bar::own-solver")));
    folder.write("suites/swinging-bar.yaml", stated("order: [1.9, 2.1]"));
    let drifted_from = SNAPSHOT.replace("9.161e-07", "9.361e-07");
    folder.write("kept/swinging-bar.snap", &drifted_from);
    let drifted = tests(&folder);
    assert!(passes(&drifted, Some("swinging-bar::own-solver")));
    assert!(!passes(&drifted, Some("swinging-bar::report")));
    // The environment determines whether a new report is written next to the snapshot.
    assert_eq!(folder.read("kept/swinging-bar.snap"), drifted_from);
}

#[test]
fn a_report_without_a_snapshot_fails() {
    let folder = folder();
    let beside = SuiteFolder::new(folder.path().join("suites")).judging(OwnSolver);
    assert!(!passes(&beside, Some("swinging-bar::report")));
    assert!(!folder.path().join("suites/swinging-bar.snap").exists());
}

#[test]
fn breach_of_the_contract_fails_its_own_test() {
    let folder = folder();
    let idle = solver("idle", |problem| {
        let (sound, fault) = (OwnSolver.subject(problem)?, Fault::NoWork);
        Ok(Box::new(FaultySubject { sound, fault, steps: 0, number: 0 }))
    });
    let idle = SuiteFolder::new(folder.path().join("suites")).judging(idle);
    assert!(passes(&idle, Some("swinging-bar::idle")));
    assert!(!passes(&idle, Some("swinging-bar::conformance")));
}

/// A case that requires a missing capability is ignored. A solver without an applicable case does
/// not pass.
#[test]
fn suite_without_an_applicable_case_does_not_pass() {
    let folder = folder();
    let other = SWINGING_BAR.replace("left: fixed", "left: roller").replace("swinging", "rolling");
    folder.write("suites/rolling-bar.yaml", &other);
    let (passed, said) = run(&tests(&folder), &[]);
    assert!(passed && said.contains("ignored (the solver lacks conditions: roller)"), "{said}");
    // Applicable cases that the command line excludes are not an error.
    let (passed, said) = run(&tests(&folder), &["--skip", "swinging"]);
    assert!(passed && said.contains("0 passed; 0 failed; 1 ignored"), "{said}");
    let alone = Folder::new();
    alone.write("suites/rolling-bar.yaml", &other);
    assert!(!passes(&tests(&alone), None), "nothing at all");
    alone.write(
        "suites/courant-limit.yaml",
        include_str!("../../../verification/stability/courant-limit.yaml"),
    );
    assert!(!passes(&tests(&alone), None), "a study of another kind");
}

/// The solver refuses the first of two cases.
#[test]
fn report_with_one_applicable_case_is_compared() {
    let folder = folder();
    let two = SWINGING_BAR.replace("until: 0.5", "until: [0.25, 0.5]");
    folder.write("suites/swinging-bar.yaml", &two);
    let refusing = solver("refusing", |problem| {
        if problem.until < 0.5 { Err("a short run".into()) } else { OwnSolver.subject(problem) }
    });
    let (_, said) = run(&tests(&folder).judging(refusing), &[]);
    assert!(said.contains("1 passed; 1 failed; 2 ignored"), "{said}");
}

#[test]
fn invalid_files_fail() {
    let empty = Folder::new();
    assert!(!passes(&tests(&empty), None), "no folder");
    empty.write("suites/README.md", "no suite");
    assert!(!passes(&tests(&empty), None), "no suite");
    let folder = folder();
    folder.write("suites/other-name.yaml", SWINGING_BAR);
    assert!(!passes(&tests(&folder), Some("other-name::parse")));
    folder.write("suites/other-name.yaml", "suite: [");
    assert!(!passes(&tests(&folder), Some("other-name::parse")));
}

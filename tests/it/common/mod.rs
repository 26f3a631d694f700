//! Helpers of several tests: suites, solvers, folders, JSON Schemas and VTK files.

pub(crate) mod folder;
pub(crate) mod json_schema;
pub(crate) mod solver;
pub(crate) mod vtk;

use mpm_verify::embedded;
use mpm_verify::study::Runner;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::Source;
use mpm_verify::verify::{CaseOutcome, LevelOutcome};

/// Reads and loads a valid suite.
#[track_caller]
pub(crate) fn read_suite(text: &str) -> (Source, Suite) {
    let source = Source::from_text("suite.yaml", text).expect("a text");
    let suite = Suite::load(&source).unwrap_or_else(|diagnostic| panic!("{diagnostic}\n{text}"));
    (source, suite)
}

/// Loads a valid suite.
#[track_caller]
pub(crate) fn valid_suite(text: &str) -> Suite {
    read_suite(text).1
}

#[track_caller]
pub(crate) fn built_in_source(name: &str) -> Source {
    embedded::source(name).expect(name).expect("a text")
}

#[track_caller]
pub(crate) fn built_in_suite(name: &str) -> Suite {
    Suite::load(&built_in_source(name)).expect("a valid suite")
}

/// Replaces the first of each text in a suite by another text.
#[track_caller]
pub(crate) fn edited(suite: &str, edits: &[(&str, &str)]) -> String {
    edits.iter().fold(suite.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "the suite does not say `{from}`");
        text.replacen(from, to, 1)
    })
}

/// Runs the cases of a valid suite.
#[track_caller]
pub(crate) fn cases(text: &str) -> Vec<CaseOutcome> {
    Runner::new(&valid_suite(text)).run(&|| ()).cases
}

#[track_caller]
pub(crate) fn levels(case: &CaseOutcome) -> &[LevelOutcome] {
    &case.convergence().expect(&case.reason).levels
}

/// Returns the judged errors, level by level.
#[track_caller]
pub(crate) fn errors(case: &CaseOutcome) -> Vec<f64> {
    levels(case).iter().map(|level| level.error).collect()
}

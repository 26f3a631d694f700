//! `mpm-verify list`, `check` and `explain`.

use super::{
    output, select,
    status::{BAD_INPUT, PASSED},
};
use mpm_verify::suite::{StudyPlan, Suite, statement};
use std::path::PathBuf;

/// Prints every suite with its cases.
pub(super) fn list(targets: &[PathBuf]) -> u8 {
    each(targets, |suite| {
        let cases = suite.case_names().join("\n  ");
        format!("{}: {}\n  {cases}\n", suite.name, suite.title)
    })
}

/// Says of every suite that it is sound, or what is wrong with it.
pub(super) fn check(targets: &[PathBuf]) -> u8 {
    each(targets, |suite| {
        let cases = suite.case_names().len();
        let noun = if cases == 1 { "case" } else { "cases" };
        format!("{}: sound, {cases} {noun}\n", suite.name)
    })
}

/// Prints the problem, its source and what is expected.
pub(super) fn explain(targets: &[PathBuf]) -> u8 {
    each(targets, explanation)
}

fn each(targets: &[PathBuf], page: impl Fn(&Suite) -> String) -> u8 {
    let mut code = PASSED;
    for suite in select::suites(targets) {
        match suite {
            Ok(suite) => output::print(&page(&suite)),
            Err(complaint) => {
                output::complain(&complaint.to_string());
                code = BAD_INPUT;
            }
        }
    }
    code
}

fn explanation(suite: &Suite) -> String {
    let mut page = format!("{}: {}\n\n{}\n\n", suite.name, suite.title, suite.about.trim());
    page += &format!("  {:18}{}\n", "source", suite.source);
    for (key, value) in statement::rows(suite) {
        page += &format!("  {key:18}{value}\n");
    }
    for (case, expected, because) in expectations(suite) {
        page += &format!("\n{case}\n  expected: {expected}\n  because: {because}\n");
    }
    page + "\n"
}

/// Each case with what is expected of it and why.
fn expectations(suite: &Suite) -> Vec<(String, String, String)> {
    match &suite.study {
        StudyPlan::Convergence(plan) => plan
            .cases
            .iter()
            .map(|case| {
                let expected = &case.expectation;
                (case.name.clone(), expected.summary(), expected.because.clone())
            })
            .collect(),
        StudyPlan::InternalForce(plan) => plan
            .cases
            .iter()
            .map(|case| {
                let expected = case.expected.summary();
                (case.name.clone(), expected, case.because.clone())
            })
            .collect(),
    }
}

//! `--title` and `--label`: texts of figures and LaTeX tables.

use super::args::{CaseLabel, ReportArgs};
use crate::cli::status::CommandError;
use crate::cli::suite_runs::SuiteRuns;
use mpm_verify::nearest;
use mpm_verify::verify::SuiteOutcome;
use std::collections::BTreeSet;

/// Checks the labels of the command line against the cases of the run.
///
/// # Errors
/// A label is for no case, two cases would have the same label, or several suites would have one
/// title.
pub(super) fn check(args: &ReportArgs, runs: &[SuiteRuns]) -> Result<(), CommandError> {
    if let Some(title) = args.title.as_ref().filter(|_| runs.len() > 1) {
        return Err(CommandError::option("--title", title, "expected one suite"));
    }
    let cases: BTreeSet<&str> =
        runs.iter().flat_map(SuiteRuns::parts).flat_map(|part| part.suite.case_names()).collect();
    let mut texts = BTreeSet::new();
    for CaseLabel { case, text } in &args.label {
        if !cases.contains(case.as_str()) {
            let near = nearest(case, cases.iter().copied());
            let hint = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
            return Err(CommandError::option(
                "--label",
                case,
                format!("no case of this name{hint}"),
            ));
        }
        if !texts.insert(text) || cases.contains(text.as_str()) {
            return Err(CommandError::option("--label", text, "another case has this label"));
        }
    }
    Ok(())
}

/// The outcomes with the texts of the command line.
pub(super) fn labelled(args: &ReportArgs, outcomes: &[SuiteOutcome]) -> Vec<SuiteOutcome> {
    let mut outcomes = outcomes.to_vec();
    for outcome in &mut outcomes {
        if let Some(title) = &args.title {
            outcome.title.clone_from(title);
        }
        for case in &mut outcome.cases {
            if let Some(label) = args.label.iter().find(|label| label.case == case.case) {
                case.case.clone_from(&label.text);
            }
        }
    }
    outcomes
}

//! Prints the text of a run.

use super::args::{CaseLabel, ReportArgs, RunFormat};
use crate::cli::output::{self, CommandError};
use crate::cli::suite_runs::SuiteRuns;
use mpm_verify::suite::yaml::Source;
use mpm_verify::verify::SuiteOutcome;
use mpm_verify::{nearest, report};
use std::collections::BTreeSet;
use std::path::Path;

/// Maximum number of individually named suites for which full reports are printed.
const FEW: usize = 5;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Printing {
    Json,
    Csv,
    Latex,
    /// All reports, followed by one line for each case.
    Reports,
    /// One line for each case.
    Verdicts,
    /// The overview, and the cases with unexpected results.
    Overview,
    Unexpected,
}

impl Printing {
    pub(super) fn of(args: &ReportArgs, suites: usize) -> Self {
        let few_are_named = !args.targets.targets.is_empty() && suites <= FEW;
        match args.format {
            RunFormat::Json => Self::Json,
            RunFormat::Csv => Self::Csv,
            RunFormat::Latex => Self::Latex,
            RunFormat::Text if args.print.quiet => Self::Unexpected,
            RunFormat::Text if args.print.brief => Self::Verdicts,
            RunFormat::Text if args.print.reports || few_are_named => Self::Reports,
            RunFormat::Text => Self::Overview,
        }
    }

    /// Prints the text for a suite as soon as the suite has finished.
    pub(super) fn of_suite(self, outcome: &SuiteOutcome) {
        if self == Self::Reports {
            output::print(&format!("{}\n", report::text(outcome)));
        }
    }

    pub(super) fn of_all(self, args: &ReportArgs, sources: &[Source], outcomes: &[SuiteOutcome]) {
        match self {
            Self::Json => output::print(&report::json(outcomes)),
            Self::Csv => output::print(&report::csv(outcomes)),
            Self::Latex => output::print(&report::latex(&labelled(args, outcomes))),
            _ if outcomes.is_empty() => {}
            Self::Reports | Self::Verdicts => output::print(&report::summary(outcomes)),
            Self::Overview => {
                output::print(&report::glance(outcomes));
                output::print(&format!("\n{}{}\n", unexpected(outcomes), place(args, sources)));
            }
            Self::Unexpected => output::print(&unexpected(outcomes)),
        }
    }
}

/// Formats the reports of all cases with unexpected results, with the suite name above each group.
fn unexpected(outcomes: &[SuiteOutcome]) -> String {
    let mut text = String::new();
    for outcome in outcomes.iter().filter(|outcome| !outcome.passed()) {
        text += &format!("{}: {}\n\n", outcome.suite, outcome.title);
        for case in outcome.cases.iter().filter(|case| !case.passed()) {
            text += &format!("{}\n", report::case(case));
        }
    }
    text
}

/// Returns a line that describes where the reports are.
fn place(args: &ReportArgs, sources: &[Source]) -> String {
    if let Some(folder) = &args.out {
        return format!("reports: {}", folder.join("SUITE.txt").display());
    }
    let accepted = |source: &Source| Path::new(source.name()).with_extension("snap").is_file();
    let accepted = if sources.iter().any(accepted) {
        "accepted snapshots in verification/GROUP/SUITE.snap; for this run, "
    } else {
        ""
    };
    format!("reports: {accepted}`--reports` prints them, `--out DIR` writes them")
}

/// Checks the labels of the command line against the cases of the run.
///
/// # Errors
/// If a label matches no case, two cases would have the same label, or several suites would have
/// the same title.
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
            let reason = format!("no case has this name{hint}");
            return Err(CommandError::option("--label", case, reason));
        }
        if !texts.insert(text) || cases.contains(text.as_str()) {
            return Err(CommandError::option("--label", text, "another case has this label"));
        }
    }
    Ok(())
}

/// Replaces the titles and labels in the outcomes by those from the command line.
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

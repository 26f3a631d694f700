//! Printed text of a run, and the time of printing.

use super::args::{ReportArgs, RunFormat};
use super::labels::labelled;
use crate::cli::output;
use mpm_verify::report;
use mpm_verify::suite::yaml::Source;
use mpm_verify::verify::SuiteOutcome;
use std::path::Path;

/// Largest number of named suites whose reports are printed.
const FEW: usize = 5;

/// Extent of the printed text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Printing {
    /// One JSON document.
    Json,
    /// One table of comma-separated values.
    Csv,
    /// LaTeX tables.
    Latex,
    /// Every report, then one line for each case.
    Reports,
    /// One line for each case.
    Verdicts,
    /// The overview, and the cases with unexpected results.
    Overview,
    /// The cases with unexpected results.
    Unexpected,
}

impl Printing {
    /// The extent that the options request, for `suites` suites.
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

    /// Prints the output for a suite as soon as it has ended.
    pub(super) fn of_suite(self, outcome: &SuiteOutcome) {
        if self == Self::Reports {
            output::print(&format!("{}\n", report::text(outcome)));
        }
    }

    /// Prints the output at the end.
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

/// The full reports of cases with unexpected results, below the names of their suites.
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

/// One line with the places of the reports.
fn place(args: &ReportArgs, sources: &[Source]) -> String {
    if let Some(folder) = &args.out {
        return format!("reports: {}", folder.join("SUITE.txt").display());
    }
    let accepted = |source: &Source| Path::new(source.name()).with_extension("snap").is_file();
    let accepted = if sources.iter().any(accepted) {
        "verification/GROUP/SUITE.snap, as they were accepted; of this run: "
    } else {
        ""
    };
    format!("reports: {accepted}`--reports` prints them, `--out DIR` writes them")
}

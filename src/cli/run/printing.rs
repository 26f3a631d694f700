//! Prints the text of a run.

use super::args::{CaseLabel, ReportArgs, RunFormat};
use crate::cli::output::{self, CommandError};
use crate::cli::suite_runs::SuiteRuns;
use mpm_verify::suite::yaml::{Diagnostic, Source};
use mpm_verify::suite::{next_command, violations};
use mpm_verify::verify::{CaseOutcome, SuiteOutcome};
use mpm_verify::{nearest, report};
use std::collections::BTreeSet;
use std::io::IsTerminal;
use std::time::Duration;

/// Maximum number of individually named suites for which full reports are printed.
const FEW: usize = 5;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Printing {
    Json,
    Csv,
    Latex,
    /// All reports, followed by one line for each case.
    Reports,
    Verdicts,
    /// One line for each suite or group, and the failing cases.
    Overview,
    Failures,
}

impl Printing {
    pub(super) fn of(args: &ReportArgs, suites: usize) -> Self {
        let few_are_named = !args.targets.targets.is_empty() && suites <= FEW;
        match args.format {
            RunFormat::Json => Self::Json,
            RunFormat::Csv => Self::Csv,
            RunFormat::Latex => Self::Latex,
            RunFormat::Text | RunFormat::Github => match &args.print {
                print if print.quiet => Self::Failures,
                print if print.brief => Self::Verdicts,
                print if print.reports || few_are_named => Self::Reports,
                _ => Self::Overview,
            },
        }
    }

    /// Whether people read standard output, not programs.
    pub(super) fn is_text(self) -> bool {
        !matches!(self, Self::Json | Self::Csv | Self::Latex)
    }

    /// Prints the end of the text: the violated expectations with their positions in the files of
    /// the suites, the names of the written files, and the verdict on the run.
    pub(super) fn end(
        self,
        args: &ReportArgs,
        sources: &[Source],
        outcomes: &[SuiteOutcome],
        time: Duration,
    ) {
        for (source, suite, case) in failed(sources, outcomes) {
            for violation in violations(source, suite, case) {
                match args.format {
                    RunFormat::Github => output::print(&annotation(&violation)),
                    RunFormat::Text => output::print(&format!("{violation}\n")),
                    _ => output::diagnose(&violation),
                }
            }
        }
        if !outcomes.is_empty() && !self.is_text() {
            written(args).for_each(|line| output::complain(&line));
        }
        if outcomes.is_empty() || self == Self::Failures || !self.is_text() {
            return;
        }
        written(args).for_each(|line| output::print(&line));
        print_verdict(args, sources, outcomes, time);
    }

    pub(super) fn of_suite(self, outcome: &SuiteOutcome) {
        if self == Self::Reports {
            output::print(&format!("{}\n", report::text(outcome)));
        }
    }

    pub(super) fn of_all(self, args: &ReportArgs, outcomes: &[SuiteOutcome]) {
        match self {
            Self::Json => output::print(&report::json(outcomes)),
            Self::Csv => output::print(&report::csv(outcomes)),
            Self::Latex => output::print(&report::latex(&labelled(args, outcomes))),
            _ if outcomes.is_empty() => {}
            // Each report begins with the results of its cases.
            Self::Reports => {}
            Self::Verdicts => output::print(&report::summary(outcomes)),
            Self::Overview => {
                if args.print.overview {
                    output::print(&format!("{}\n", report::overview(outcomes)));
                }
                let plotted = report::plotted(outcomes.iter()).filter(|_| args.print.plot);
                if let Some(plot) = plotted.and_then(report::convergence_plot) {
                    output::print(&format!("{plot}\n"));
                }
                output::print(&format!("{}\n", report::glance(outcomes)));
                output::print(&failures(outcomes));
            }
            Self::Failures => output::print(&failures(outcomes)),
        }
    }
}

fn written(args: &ReportArgs) -> impl Iterator<Item = String> {
    let paths = [&args.out, &args.html, &args.junit].into_iter().flatten();
    paths.map(|path| format!("wrote {}\n", path.display()))
}

/// Prints the last lines of a run: the counts, and useful commands. The time is omitted if the
/// output goes to a file, because equal results then give equal bytes.
fn print_verdict(args: &ReportArgs, sources: &[Source], outcomes: &[SuiteOutcome], time: Duration) {
    let cases: Vec<&CaseOutcome> = outcomes.iter().flat_map(|suite| &suite.cases).collect();
    let time = if std::io::stdout().is_terminal() {
        format!(" in {:.1} s", time.as_secs_f64())
    } else {
        String::new()
    };
    let text = format!(
        "{}, {}{time}: {}{}\n",
        report::counted(outcomes.len(), "suite"),
        report::counted(cases.len(), "case"),
        report::counts(cases.iter().copied()),
        if cases.iter().all(|case| case.passed()) { ", 0 FAIL" } else { "" }
    );
    let failed = failed(sources, outcomes).next();
    let plotted = report::plotted(outcomes.iter()).map_or("", |suite| &suite.suite);
    let next = match failed.map(|(source, suite, case)| next_command(source, suite, case)) {
        Some(command) => vec![(command, "")],
        None if args.print.plot => vec![
            ("run".to_owned(), "all suites"),
            (format!("run {plotted}"), "one report"),
            ("doctor --solver COMMAND".to_owned(), "your own solver"),
        ],
        None => Vec::new(),
    };
    output::print(&text);
    output::next(next.iter().map(|(command, purpose)| (command.as_str(), *purpose)));
}

/// Formats a diagnostic as a workflow command of GitHub, which annotates the line of the file.
fn annotation(diagnostic: &Diagnostic) -> String {
    let data = |text: &str| text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A");
    let property = |text: &str| data(text).replace(':', "%3A").replace(',', "%2C");
    let place = diagnostic
        .place()
        .map_or_else(String::new, |place| format!(",line={},col={}", place.line(), place.column()));
    let (file, title) = (property(diagnostic.file()), diagnostic.code().unwrap_or("mpm-verify"));
    let help = diagnostic.help().unwrap_or_default();
    let text = data(&format!("{}\n{help}", diagnostic.message()));
    format!("::error file={file}{place},title={title}::{text}\n")
}

fn failed<'a>(
    sources: &'a [Source],
    outcomes: &'a [SuiteOutcome],
) -> impl Iterator<Item = (&'a Source, &'a str, &'a CaseOutcome)> {
    sources.iter().zip(outcomes).flat_map(|(source, outcome)| {
        let failed = outcome.cases.iter().filter(|case| !case.passed());
        failed.map(move |case| (source, outcome.suite.as_str(), case))
    })
}

/// Formats the reports of all failing cases, with the suite name above each group.
fn failures(outcomes: &[SuiteOutcome]) -> String {
    let mut text = String::new();
    for outcome in outcomes.iter().filter(|outcome| !outcome.passed()) {
        text += &format!("{}: {}\n\n", outcome.suite, outcome.title);
        for case in outcome.cases.iter().filter(|case| !case.passed()) {
            text += &format!("{}\n", report::case(case));
        }
    }
    text
}

/// Checks that each label matches a case, that no two cases have the same label, and that no two
/// suites have the same title.
pub(super) fn check(args: &ReportArgs, runs: &[SuiteRuns]) -> Result<(), CommandError> {
    if let Some(title) = args.title.as_ref().filter(|_| runs.len() > 1) {
        return Err(CommandError::option("--title", title, "expected one suite"));
    }
    let cases: BTreeSet<&str> =
        runs.iter().flat_map(|runs| &runs.parts).flat_map(|part| part.suite.case_names()).collect();
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

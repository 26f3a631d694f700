//! `mpm-verify check`.

use super::arguments::{FormatArgs, SolverArgs, Targets};
use super::output::{CommandError, Status};
use super::{output, select, solver};
use clap::Args;
use mpm_verify::report::{self, indented};
use mpm_verify::study;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::{Diagnostic, Place, Severity, Source};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::collections::BTreeMap;

#[derive(Debug, Args)]
pub(super) struct CheckArgs {
    #[command(flatten)]
    targets: Targets,
    /// Exit with status 1 if there are warnings
    #[arg(long)]
    strict: bool,
    /// Omit valid suites and notes
    #[arg(long, short)]
    quiet: bool,
    /// Print all notes [default: only notes about named suites, and the number of other notes]
    #[arg(long, conflicts_with = "quiet")]
    notes: bool,
    #[command(flatten)]
    format: FormatArgs,
    #[command(flatten)]
    solver: SolverArgs,
}

pub(super) fn check(args: &CheckArgs) -> Result<Status, CommandError> {
    let found = select::with_sources(&args.targets.targets);
    let mut counts = Counts::default();
    let mut findings = CheckFindings::new(args, found.len());
    let mut names: BTreeMap<String, String> = BTreeMap::new();
    let solver = solver::greeted(&args.solver)?;
    let checked = found.into_par_iter().map(|found| {
        let (source, mut suite) = found?;
        let mut lacks = Vec::new();
        if let Some(solver) = &solver {
            match study::under(&suite, solver, false) {
                Some(under_solver) if under_solver.case_names().is_empty() => {
                    lacks
                        .push("a case: each solution applies to a built-in method only".to_owned());
                }
                Some(under_solver) => suite = under_solver,
                None => lacks.push("features that this kind of study needs".to_owned()),
            }
            lacks.extend(study::lacking(&suite, solver));
        }
        let diagnostics = study::preflight(&suite, &source);
        Ok((source, suite, lacks, diagnostics))
    });
    for found in checked.collect::<Vec<Result<_, Diagnostic>>>() {
        let (source, suite, lacks, mut diagnostics) = match found {
            Ok(found) => found,
            Err(diagnostic) => {
                counts.add(Severity::Error);
                findings.refused(&diagnostic);
                continue;
            }
        };
        if !lacks.is_empty() {
            findings.lacking(&suite, &source, &lacks);
            continue;
        }
        let earlier = names.insert(suite.name.clone(), source.name().to_owned());
        diagnostics.extend(earlier.map(|earlier| named_twice(&suite, &source, &earlier)));
        if findings.has_summary() {
            diagnostics.retain(|diagnostic| diagnostic.severity() == Severity::Error);
        }
        for diagnostic in &diagnostics {
            counts.add(diagnostic.severity());
        }
        findings.sound(&suite, &source, &diagnostics, solver.is_some());
    }
    findings.end(counts);
    Ok(match counts {
        Counts { errors: 1.., .. } => Status::BadInput,
        Counts { warnings: 1.., .. } if args.strict => Status::Failed,
        _ => Status::Passed,
    })
}

fn named_twice(suite: &Suite, source: &Source, earlier: &str) -> Diagnostic {
    let message = format!("two suites have the name `{}`: the first is in {earlier}", suite.name);
    let diagnostic = source.diagnostic_at(&["suite".into()], &message);
    let help = "reports and tests are identified by this name";
    diagnostic.with_severity(Severity::Warning).with_help(help)
}

/// Collected findings. Text is printed immediately, JSON at the end.
struct CheckFindings {
    is_json: bool,
    is_quiet: bool,
    /// Whether notes are printed instead of only counted.
    has_notes: bool,
    suites: Vec<Value>,
    /// Summary of the suites that the external solver can run; `None` without an external solver.
    applicable: Option<ApplicableSuites>,
}

/// Suites that an external solver can run, and the capabilities that it lacks for the rest.
#[derive(Default)]
struct ApplicableSuites {
    names: Vec<String>,
    /// Number of suites that require each missing capability.
    lacking: BTreeMap<String, usize>,
    others: usize,
}

impl ApplicableSuites {
    fn text(mut self) -> String {
        self.names.sort_unstable();
        let (count, all) = (self.names.len(), self.names.len() + self.others);
        let mut text = format!("\nthe solver can run {count} of {all} suites:\n");
        text += &indented(&self.names.join(", "));
        let mut lacking: Vec<(String, usize)> = self.lacking.into_iter().collect();
        lacking.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        if !lacking.is_empty() {
            let written = |(what, count): &(String, usize)| format!("{what} ({count})");
            let lacking: Vec<String> = lacking.iter().take(MOST_LACKING).map(written).collect();
            text += "most frequent missing capabilities, with the number of suites:\n";
            text += &indented(&lacking.join(", "));
        }
        text
    }
}

const MOST_LACKING: usize = 8;

impl CheckFindings {
    /// Creates empty findings. Notes are printed in full if every target is a single suite.
    fn new(args: &CheckArgs, count: usize) -> Self {
        let applicable = args.solver.solver.is_some() && count > 1;
        let is_named = count <= args.targets.targets.len();
        Self {
            is_json: args.format.is_json(),
            is_quiet: args.quiet,
            has_notes: args.notes || (is_named && !args.quiet),
            suites: Vec::new(),
            applicable: applicable.then(ApplicableSuites::default),
        }
    }

    /// Whether the output ends with a summary for a solver, without warnings and notes.
    fn has_summary(&self) -> bool {
        self.applicable.is_some()
    }

    fn refused(&mut self, diagnostic: &Diagnostic) {
        if !self.is_json {
            return output::diagnose(diagnostic);
        }
        let file = diagnostic.file();
        self.suites.push(json!({"file": file, "diagnostics": [of_diagnostic(diagnostic)]}));
    }

    fn lacking(&mut self, suite: &Suite, source: &Source, lacks: &[String]) {
        let name = &suite.name;
        if let Some(applicable) = &mut self.applicable {
            applicable.others += 1;
            for lacking in lacks {
                *applicable.lacking.entry(lacking.clone()).or_default() += 1;
            }
        }
        if self.is_json {
            let file = source.name();
            let suite = json!({"file": file, "suite": name, "lacks": lacks, "diagnostics": []});
            self.suites.push(suite);
        } else if !(self.is_quiet && self.has_summary()) {
            let lacks = lacks.join(", ");
            output::print(&format!("{name}: not applicable, the solver lacks {lacks}\n"));
        }
    }

    fn sound(&mut self, suite: &Suite, source: &Source, found: &[Diagnostic], has_solver: bool) {
        if let Some(applicable) = &mut self.applicable {
            applicable.names.push(suite.name.clone());
        }
        if !self.is_json {
            if !self.is_quiet {
                let is_explored = suite.explores() && !has_solver;
                output::print(&sound(suite, is_explored));
            }
            let is_printed = |one: &&Diagnostic| self.has_notes || one.severity() != Severity::Note;
            return found.iter().filter(is_printed).for_each(output::diagnose);
        }
        let cost = study::estimate(suite);
        let linearised = study::linearisation(suite);
        self.suites.push(json!({
            "file": source.name(),
            "suite": suite.name,
            "cases": suite.case_names().len(),
            "gate": !suite.explores(),
            "seconds": cost.map(|cost| cost.seconds),
            "bytes": cost.map(|cost| cost.bytes),
            "linearised": linearised.map(|left| {
                json!({"residual": left.residual, "error": left.error})
            }),
            "lacks": [],
            "diagnostics": found.iter().map(of_diagnostic).collect::<Vec<_>>(),
        }));
    }

    fn end(self, counts: Counts) {
        if !self.is_json {
            if let Some(applicable) = self.applicable {
                output::print(&applicable.text());
            }
            let counts = if self.is_quiet { Counts { notes: 0, ..counts } } else { counts };
            return counts.print(self.has_notes);
        }
        let Counts { errors, warnings, notes } = counts;
        let document =
            json!({"suites": self.suites, "errors": errors, "warnings": warnings, "notes": notes});
        output::print(&format!("{document:#}\n"));
    }
}

fn of_diagnostic(diagnostic: &Diagnostic) -> Value {
    let severity = match diagnostic.severity() {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    };
    let place = diagnostic.place();
    json!({
        "severity": severity,
        "file": diagnostic.file(),
        "line": place.map(Place::line),
        "column": place.map(Place::column),
        "message": diagnostic.message(),
        "label": diagnostic.label(),
        "help": diagnostic.help(),
    })
}

#[derive(Debug, Default, Clone, Copy)]
struct Counts {
    errors: usize,
    warnings: usize,
    notes: usize,
}

impl Counts {
    fn add(&mut self, severity: Severity) {
        *match severity {
            Severity::Error => &mut self.errors,
            Severity::Warning => &mut self.warnings,
            Severity::Note => &mut self.notes,
        } += 1;
    }

    fn print(self, has_notes: bool) {
        let counts = [(self.errors, "error"), (self.warnings, "warning"), (self.notes, "note")];
        let counts = counts.into_iter().filter(|(count, _)| *count > 0);
        let said: Vec<String> = counts.map(|(count, noun)| report::counted(count, noun)).collect();
        let hidden = self.notes > 0 && !has_notes;
        let hint =
            if hidden { " (printed with `--notes`, or for suites that are named)" } else { "" };
        if !said.is_empty() {
            output::complain(&format!("{}{hint}", said.join(", ")));
        }
    }
}

fn sound(suite: &Suite, is_explored: bool) -> String {
    let cases = report::counted(suite.case_names().len(), "case");
    let gate = if is_explored { "; no expectation, so it is not a gate" } else { "" };
    let cost = study::estimate(suite).map_or(String::new(), |cost| {
        let (seconds, mb) = (rounded(cost.seconds), rounded(cost.bytes / 1e6));
        format!(", about {seconds} s of one thread and {mb} MB")
    });
    let linearised = study::linearisation(suite).map_or(String::new(), |left| {
        let (residual, error) = (left.residual, rounded(left.error));
        format!("; linearised: residual {residual:.1e} of the terms of the equations, error about {error:e} m")
    });
    format!("{}: sound, {cases}{cost}{linearised}{gate}\n", suite.name)
}

/// Rounds an estimate to one significant digit.
fn rounded(value: f64) -> f64 {
    format!("{value:.0e}").parse().unwrap_or(value)
}

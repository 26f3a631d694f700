//! Findings of `mpm-verify check`, as text or as JSON.

use crate::cli::args::CheckArgs;
use crate::cli::output;
use mpm_verify::study;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::{Diagnostic, Place, Severity, Source};
use serde_json::{Value, json};

/// The findings so far: text is printed at once, JSON in the end.
pub(super) struct CheckFindings {
    is_json: bool,
    is_quiet: bool,
    /// Whether notes are printed in full.
    has_notes: bool,
    suites: Vec<Value>,
}

impl CheckFindings {
    /// Findings about `count` suites. Notes are printed if every target names one suite.
    pub(super) fn new(args: &CheckArgs, count: usize) -> Self {
        let is_named = count <= args.targets.targets.len();
        Self {
            is_json: args.format.is_json(),
            is_quiet: args.print.quiet,
            has_notes: args.print.notes || (is_named && !args.print.quiet),
            suites: Vec::new(),
        }
    }

    /// A file that cannot be used.
    pub(super) fn refused(&mut self, diagnostic: &Diagnostic) {
        if !self.is_json {
            return output::diagnose(diagnostic);
        }
        let file = diagnostic.file();
        self.suites.push(json!({"file": file, "diagnostics": [of_diagnostic(diagnostic)]}));
    }

    /// A suite for which the solver lacks something.
    pub(super) fn lacking(&mut self, suite: &Suite, source: &Source, lacks: &[String]) {
        let name = &suite.name;
        if !self.is_json {
            let lacks = lacks.join(", ");
            let text = format!("{name}: not applicable, the solver lacks {lacks}\n");
            return output::print(&text);
        }
        let file = source.name();
        self.suites.push(json!({"file": file, "suite": name, "lacks": lacks, "diagnostics": []}));
    }

    /// A suite that can run. An external solver has an expectation, that of `run --gate`.
    pub(super) fn sound(
        &mut self,
        suite: &Suite,
        source: &Source,
        found: &[Diagnostic],
        has_solver: bool,
    ) {
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

    /// Says how many complaints there are.
    pub(super) fn end(self, counts: Counts) {
        if !self.is_json {
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

/// Complaints by severity.
#[derive(Debug, Default, Clone, Copy)]
pub(super) struct Counts {
    pub(super) errors: usize,
    pub(super) warnings: usize,
    pub(super) notes: usize,
}

impl Counts {
    pub(super) fn add(&mut self, severity: Severity) {
        *match severity {
            Severity::Error => &mut self.errors,
            Severity::Warning => &mut self.warnings,
            Severity::Note => &mut self.notes,
        } += 1;
    }

    /// One line on standard error, if there is anything to count.
    fn print(self, has_notes: bool) {
        let counted = [(self.errors, "error"), (self.warnings, "warning"), (self.notes, "note")];
        let said = |(count, noun): (usize, &str)| match count {
            0 => None,
            1 => Some(format!("1 {noun}")),
            _ => Some(format!("{count} {noun}s")),
        };
        let said: Vec<String> = counted.into_iter().filter_map(said).collect();
        let hidden = self.notes > 0 && !has_notes;
        let hint =
            if hidden { " (printed with `--notes`, or for suites that are named)" } else { "" };
        if !said.is_empty() {
            output::complain(&format!("{}{hint}", said.join(", ")));
        }
    }
}

fn sound(suite: &Suite, is_explored: bool) -> String {
    let cases = suite.case_names().len();
    let noun = if cases == 1 { "case" } else { "cases" };
    let gate = if is_explored { "; nothing is expected, it is no gate" } else { "" };
    let cost = study::estimate(suite).map_or(String::new(), |cost| {
        let (seconds, mb) = (rounded(cost.seconds), rounded(cost.bytes / 1e6));
        format!(", about {seconds} s of one thread and {mb} MB")
    });
    let linearised = study::linearisation(suite).map_or(String::new(), |left| {
        let (residual, error) = (left.residual, rounded(left.error));
        format!("; linearised to {residual:.1e} of its terms, an error of about {error:e} m")
    });
    format!("{}: sound, {cases} {noun}{cost}{linearised}{gate}\n", suite.name)
}

/// One significant digit: an estimate has no more.
fn rounded(value: f64) -> f64 {
    format!("{value:.0e}").parse().unwrap_or(value)
}

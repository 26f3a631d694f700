//! `mpm-verify check`, and pages about suites.

use super::args::CheckArgs;
use super::status::{BAD_INPUT, FAILED, PASSED};
use super::{output, select, solver, watch};
use mpm_verify::study;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::{Diagnostic, Severity, Source};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Checks suites, once or whenever their files change.
pub(super) fn check(args: &CheckArgs) -> u8 {
    if args.watch { watch::repeat(&args.targets.targets, || all(args)) } else { all(args) }
}

/// Says of every suite that it is sound, or what is wrong with it, and warns of what will not do
/// what it seems to.
fn all(args: &CheckArgs) -> u8 {
    let found = select::with_sources(&args.targets.targets);
    let mut counts = Counts::default();
    let mut names: BTreeMap<String, String> = BTreeMap::new();
    let solver = match solver::greeted(&args.solver) {
        Ok(solver) => solver,
        Err(message) => {
            output::complain(&message);
            return BAD_INPUT;
        }
    };
    let checked = found.into_par_iter().map(|found| {
        let (source, mut suite) = found?;
        let mut lacks = Vec::new();
        if let Some(solver) = &solver {
            match study::under(&suite, solver, false) {
                Some(under_solver) => suite = under_solver,
                None => lacks.push("what a study of this kind asks for".to_owned()),
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
                output::diagnose(&diagnostic);
                counts.add(Severity::Error);
                continue;
            }
        };
        if !lacks.is_empty() {
            let (name, lacks) = (&suite.name, lacks.join(", "));
            output::print(&format!("{name}: not applicable, the solver lacks {lacks}\n"));
            continue;
        }
        output::print(&sound(&suite));
        let earlier = names.insert(suite.name.clone(), source.name().to_owned());
        diagnostics.extend(earlier.map(|earlier| named_twice(&suite, &source, &earlier)));
        for diagnostic in diagnostics {
            output::diagnose(&diagnostic);
            counts.add(diagnostic.severity());
        }
    }
    counts.say();
    match counts {
        Counts { errors: 1.., .. } => BAD_INPUT,
        Counts { warnings: 1.., .. } if args.strict => FAILED,
        _ => PASSED,
    }
}

/// Complaints by severity.
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

    /// One line on standard error, if there is anything to count.
    fn say(self) {
        let counted = [(self.errors, "error"), (self.warnings, "warning"), (self.notes, "note")];
        let said = |(count, noun): (usize, &str)| match count {
            0 => None,
            1 => Some(format!("1 {noun}")),
            _ => Some(format!("{count} {noun}s")),
        };
        let said: Vec<String> = counted.into_iter().filter_map(said).collect();
        if !said.is_empty() {
            output::complain(&said.join(", "));
        }
    }
}

fn sound(suite: &Suite) -> String {
    let cases = suite.case_names().len();
    let noun = if cases == 1 { "case" } else { "cases" };
    let gate = if suite.explores() { "; nothing is expected, it is no gate" } else { "" };
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

fn named_twice(suite: &Suite, source: &Source, earlier: &str) -> Diagnostic {
    let message = format!("a second suite is called `{}`: {earlier} is the first", suite.name);
    let diagnostic = source.diagnostic_at(&["suite".into()], &message);
    diagnostic.with_severity(Severity::Warning).with_help("names tell reports and tests apart")
}

/// Prints a page of each suite that can be loaded, and the complaints about others.
pub(super) fn each(targets: &[PathBuf], page: impl Fn(&Suite) -> String) -> u8 {
    try_each(targets, |_, suite| Ok(page(suite)))
}

/// The same with pages that read the file too, and that there may be a complaint about.
pub(super) fn try_each(
    targets: &[PathBuf],
    page: impl Fn(&Source, &Suite) -> Result<String, String>,
) -> u8 {
    let mut code = PASSED;
    for found in select::with_sources(targets) {
        let found = found.map_err(|diagnostic| diagnostic.styled());
        match found.and_then(|(source, suite)| page(&source, &suite)) {
            Ok(page) => output::print(&page),
            Err(message) => {
                output::complain(&message);
                code = BAD_INPUT;
            }
        }
    }
    code
}

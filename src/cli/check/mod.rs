//! `mpm-verify check`.

mod findings;

use super::args::CheckArgs;
use super::status::{BAD_INPUT, FAILED, PASSED};
use super::{output, select, solver, watch};
use findings::{CheckFindings, Counts};
use mpm_verify::study;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::{Diagnostic, Severity, Source};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Checks suites, once or whenever their files change.
pub(super) fn check(args: &CheckArgs) -> u8 {
    if args.watch { watch::repeat(&args.targets.targets, || all(args)) } else { all(args) }
}

/// Says of every suite that it is sound, or what is wrong with it, and warns of what will not do
/// what it seems to.
fn all(args: &CheckArgs) -> u8 {
    let found = select::with_sources(&args.targets.targets);
    let mut counts = Counts::default();
    let mut findings = CheckFindings::new(args, found.len());
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
                Some(under_solver) if under_solver.case_names().is_empty() => {
                    lacks
                        .push("a case: each solution belongs to a method of this crate".to_owned());
                }
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
    match counts {
        Counts { errors: 1.., .. } => BAD_INPUT,
        Counts { warnings: 1.., .. } if args.strict => FAILED,
        _ => PASSED,
    }
}

fn named_twice(suite: &Suite, source: &Source, earlier: &str) -> Diagnostic {
    let message = format!("a second suite is called `{}`: {earlier} is the first", suite.name);
    let diagnostic = source.diagnostic_at(&["suite".into()], &message);
    diagnostic.with_severity(Severity::Warning).with_help("names tell reports and tests apart")
}

//! Examines a solver on small problems. Each problem reveals one kind of defect, and findings
//! describe the probable mistake in the solver's code (docs/doctor.md).
//!
//! ```text
//! finding       findings, and the report as text
//! scene         small scenes, passed to the solver like those of suites
//! patient       capabilities of a solver, its runs, and the type of an examination
//! course        recorded runs, quantities computed from them, and vector fields
//! prelude       the names that most examinations use
//! rules         findings by tables of expected values
//! motion/       causes of errors in uniform motion
//! examination/  one file for each examination
//! ```

mod course;
mod examination;
mod finding;
mod motion;
mod patient;
mod prelude;
mod rules;
mod scene;
#[cfg(test)]
mod tests;

pub use finding::{
    DoctorReport, ExaminationReport, ExaminationResult, FindingWeight, SolverFinding,
    UnexaminedCapability, brief_page, page,
};

use crate::embedded;
use crate::external::{Capabilities, SolverFactory};
use crate::study::{needs_of_suite, under};
use crate::suite::Suite;
use examination::ALL;
use patient::{Examination, Examined, Hindrance, Patient};
use rayon::prelude::*;

/// Runs all examinations of a solver, starting with the simplest, and calls `progress` with the
/// name of each. An examination is skipped if one on which it depends reports defects.
pub fn doctor(solver: &dyn SolverFactory, progress: &dyn Fn(&str)) -> DoctorReport {
    let mut report = DoctorReport {
        solver: solver.name().to_owned(),
        settings: solver.settings(),
        silent: None,
        examinations: Vec::new(),
        not_examined: Vec::new(),
    };
    let patient = Patient {
        solver,
        #[cfg(test)]
        built_in: None,
    };
    // Names of examinations whose quantity the method masks.
    let mut masked: Vec<&str> = Vec::new();
    for examination in ALL {
        // A solver of load steps refuses all problems in time.
        if report.silent.is_some() && !examination.covers.contains(&"load_steps") {
            continue;
        }
        progress(examination.name);
        let source = masked.iter().find(|name| examination.after.contains(name));
        let result = if let Some(after) = ground(examination, &report) {
            ExaminationResult::Skipped { after }
        } else if let Some(name) = source {
            ExaminationResult::NotApplicable { lacks: format!("a result of `{name}`") }
        } else {
            let outcome = (examination.examine)(&patient);
            if matches!(outcome, Err(Hindrance::Masked(_))) {
                masked.push(examination.name);
            }
            examined(outcome)
        };
        let is_examined = matches!(result, ExaminationResult::Examined { .. });
        let Examination { name, expected, .. } = *examination;
        report.silent = if report.examinations.is_empty() {
            silent(&result)
        } else {
            report.silent.filter(|_| !is_examined)
        };
        report.examinations.push(ExaminationReport { examination: name, expected, result });
        if report.silent.is_some() && is_examined {
            return report;
        }
    }
    if report.silent.is_some() {
        report.examinations.truncate(1);
        return report;
    }
    report.not_examined = unexamined(solver, &report.examinations);
    report
}

fn silent(first: &ExaminationResult) -> Option<String> {
    match first {
        ExaminationResult::Examined { findings, .. } => {
            let broke = findings.iter().find(|finding| finding.name == BROKE);
            broke.map(|finding| finding.seen.clone())
        }
        ExaminationResult::NotApplicable { lacks } => Some(format!(
            "the solver does not support the simplest problem, a body whose faces are all free: \
             {lacks}"
        )),
        ExaminationResult::Skipped { .. } => None,
    }
}

/// Name of the finding for a run that did not complete.
const BROKE: &str = "does-not-get-through";

fn examined(outcome: Result<Examined, Hindrance>) -> ExaminationResult {
    match outcome {
        Ok(Examined { measured, findings }) => ExaminationResult::Examined { measured, findings },
        Err(Hindrance::Lacks(lacks) | Hindrance::Masked(lacks)) => {
            ExaminationResult::NotApplicable { lacks }
        }
        Err(Hindrance::Broke(seen)) => ExaminationResult::Examined {
            measured: "nothing, because the run did not complete".to_owned(),
            findings: vec![SolverFinding::defect(
                BROKE,
                seen,
                "the solver stopped, reported a failure or violated the protocol during the run",
                "the solver's standard error; the table of errors in docs/protocol.md; indices \
                 that are computed from `grid.origin` and `grid.cells` of the problem, which \
                 differ between axes",
            )],
        },
    }
}

/// Returns the first examination with defects on which `examination` depends, even indirectly.
fn ground(examination: &Examination, report: &DoctorReport) -> Option<&'static str> {
    let is_ground = |made: &&ExaminationReport| examination.after.contains(&made.examination);
    let has_defect = |made: &&ExaminationReport| {
        let findings = made.result.findings();
        let is_skipped = matches!(made.result, ExaminationResult::Skipped { .. });
        is_skipped || findings.iter().any(|finding| finding.weight == FindingWeight::Defect)
    };
    let found = report.examinations.iter().filter(is_ground).find(has_defect)?;
    Some(match found.result {
        ExaminationResult::Skipped { after } => after,
        _ => found.examination,
    })
}

const SUITES: usize = 3;

/// Lists the capabilities that `solver` declares and that no examination covers. Skipped
/// examinations count, because they run once the defects are corrected; those that are not
/// applicable do not.
fn unexamined(
    solver: &dyn SolverFactory,
    reports: &[ExaminationReport],
) -> Vec<UnexaminedCapability> {
    let applies = |name: &str| {
        let is_not = |result: &_| matches!(result, ExaminationResult::NotApplicable { .. });
        reports.iter().any(|made| made.examination == name && !is_not(&made.result))
    };
    let covered: Vec<&str> =
        ALL.iter().filter(|one| applies(one.name)).flat_map(|one| one.covers).copied().collect();
    let claimed = solver.capabilities().map_or(Vec::new(), Capabilities::entries);
    let left: Vec<String> =
        claimed.into_iter().filter(|entry| !covered.contains(&entry.as_str())).collect();
    if left.is_empty() {
        return Vec::new();
    }
    let names: Vec<&str> = embedded::names().collect();
    let runnable = names.into_par_iter().filter_map(|name| Some((name, required(name, solver)?)));
    let mut suites: Vec<(&str, Vec<String>)> = runnable.collect();
    // Suites that need little else come first. The sort is stable, so equal ones stay in order.
    suites.sort_by_key(|(_, needs)| needs.len());
    let of = |capability: String| {
        let testing = suites.iter().filter(|(_, needs)| needs.contains(&capability));
        let suites = testing.map(|(name, _)| *name).take(SUITES).collect();
        UnexaminedCapability { capability, suites }
    };
    left.into_iter().map(of).collect()
}

/// Returns the capabilities that a built-in suite requires; `None` if the solver cannot run it.
fn required(name: &str, solver: &dyn SolverFactory) -> Option<Vec<String>> {
    let suite = Suite::load(&embedded::source(name)?.ok()?.trusted()).ok()?;
    let needs = needs_of_suite(&suite)?;
    let can_run =
        solver.lacks(&needs).is_empty() && !under(&suite, solver, false)?.case_names().is_empty();
    can_run.then(|| Capabilities::default().lacking(&needs))
}

//! Checks whether a solver conforms to the contract of [`Subject`](crate::subject::Subject).
//!
//! ```text
//! course   columns, labels, weights and motion at the start; counters and sums over a few steps
//!          and repeated sampling, a half-length step and a repeated run
//! record   recorded runs, and the type of a breach
//! ```

mod course;
mod record;

pub use record::Breach;

use crate::embedded;
use crate::external::{LevelProblem, SolverFactory};
use crate::study::{lacking, level_problem};
use crate::subject::SubjectError;
use crate::suite::Suite;
use record::{RunState, record};

const STEPS: usize = 6;

/// Built-in suites, the simplest first. At rest, a wrong step length would have no effect.
const SUITES: [&str; 4] =
    ["vibrating-bar", "mms-periodic-bar-sin", "translating-body", "mms-axis-aligned-2d"];

/// Returns all breaches of the contract on the coarsest level of the first built-in suite that the
/// solver supports; empty if there are none.
///
/// ```no_run
/// # use mpm_verify::prelude::*;
/// # use mpm_verify::testing::conformance;
/// # fn test(solver: &dyn SolverFactory) {
/// let breaches = conformance(solver);
/// assert!(breaches.is_empty(), "{breaches:#?}");
/// # }
/// ```
pub fn conformance(solver: &dyn SolverFactory) -> Vec<Breach> {
    let mut refused = Vec::new();
    for name in SUITES {
        let source = embedded::source(name).and_then(Result::ok);
        let Some(suite) = source.and_then(|source| Suite::load(&source).ok()) else { continue };
        match examined(solver, &suite) {
            Ok(breaches) => return breaches,
            Err(why) => refused.push(format!("{name}: {why}")),
        }
    }
    let wanted = "the solver to accept one of the built-in suites; use `conformance_on` for a \
                  suite of your own";
    vec![Breach::new("problem", wanted, refused.join("; "))]
}

/// Returns all breaches of the contract on the coarsest level of `suite`; empty if there are none.
pub fn conformance_on(solver: &dyn SolverFactory, suite: &Suite) -> Vec<Breach> {
    examined(solver, suite).unwrap_or_else(|why| {
        let wanted = format!("the solver to accept the suite `{}`", suite.name);
        vec![Breach::new("problem", wanted, why.to_string())]
    })
}

/// Returns all breaches on the coarsest level of `suite`, or why the solver cannot run the suite.
pub(crate) fn examined(
    solver: &dyn SolverFactory,
    suite: &Suite,
) -> Result<Vec<Breach>, SubjectError> {
    Ok(breaches(solver, &problem(solver, suite)?))
}

fn problem(solver: &dyn SolverFactory, suite: &Suite) -> Result<LevelProblem, SubjectError> {
    let plan = suite.convergence().ok_or("the suite is not a convergence study")?;
    let lacks = lacking(suite, solver);
    if !lacks.is_empty() {
        return Err(format!("the solver lacks {}", lacks.join(", ")).into());
    }
    let level = plan.refine.levels.first().ok_or("the suite has no level")?;
    let case = plan.cases.first().ok_or("the suite has no case")?;
    let problem = level_problem(&suite.name, plan, case, *level)?;
    solver.subject(problem.clone())?;
    Ok(problem)
}

fn breaches(solver: &dyn SolverFactory, problem: &LevelProblem) -> Vec<Breach> {
    let make = || solver.subject(problem.clone());
    let mut subject = match make() {
        Ok(subject) => subject,
        Err(why) => {
            let wanted = "the solver to accept the same problem a second time";
            return vec![Breach::new("problem", wanted, why.to_string())];
        }
    };
    let mut states = vec![RunState::from_subject(subject.as_ref())];
    let mut breaches = course::counts(problem, &states[0].samples);
    if !breaches.is_empty() {
        // The remaining checks need valid columns.
        return breaches;
    }
    breaches.extend(course::start(problem, &states[0].samples));
    breaches.extend(course::sample(subject.as_ref(), &states[0].samples));
    let steps = STEPS.min(problem.steps as usize);
    if let Err(failure) = record(subject.as_mut(), steps, problem.dt, &mut states) {
        let wanted = format!("{steps} steps of {:e} s on the coarsest level", problem.dt);
        let seen = format!("step {} fails: {failure}", states.len());
        breaches.push(Breach::new("step", wanted, seen));
    }
    breaches.extend(course::samples(&states));
    breaches.extend(course::counters(problem, &states));
    breaches.extend(course::totals(problem, &states));
    if breaches.is_empty() {
        breaches.extend(course::repeat(&make, &states, problem.dt));
    }
    // This comparison is meaningful only if runs are repeatable.
    if breaches.is_empty() {
        breaches.extend(course::step_length(&make, &states, problem.dt));
    }
    breaches.extend(course::work(&states));
    breaches
}

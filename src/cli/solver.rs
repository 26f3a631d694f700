//! Starts external solvers, and replaces the methods of suites by external solvers.

use super::arguments::{SolverArgs, SolverCommand, SolverLimitArgs, SolversArgs};
use super::output::{self, CommandError};
use mpm_verify::external::{ProgramLimits, SolverFactory, SolverProgram};
use mpm_verify::study::under_on;
use mpm_verify::suite::{GateTerms, Suite};
use mpm_verify::verify::SuiteOutcome;
use std::collections::BTreeSet;
use std::time::Duration;

pub(super) fn greeted(args: &SolverArgs) -> Result<Option<SolverProgram>, CommandError> {
    args.solver.as_deref().map(|command| greet(command, &args.limits)).transpose()
}

/// Starts all solvers of the command line, whose names must differ.
pub(super) fn greet_all(args: &SolversArgs) -> Result<Vec<SolverProgram>, CommandError> {
    let mut names = BTreeSet::new();
    for one in &args.solver {
        let (value, reason) = match &one.name {
            None if args.solver.len() > 1 => {
                (&one.command, "several solvers need a name each: `NAME=COMMAND`")
            }
            Some(name) if !names.insert(name) => (name, "another solver has this name"),
            _ => continue,
        };
        return Err(CommandError::option("--solver", value, reason));
    }
    let greet = |one: &SolverCommand| -> Result<SolverProgram, CommandError> {
        let program = greet(&one.command, &args.limits)?;
        let Some(name) = &one.name else { return Ok(program) };
        program.called(name).map_err(|error| CommandError::option("--solver", name, error))
    };
    args.solver.iter().map(greet).collect()
}

pub(super) fn greet(
    command: &str,
    limits: &SolverLimitArgs,
) -> Result<SolverProgram, CommandError> {
    let silence = Duration::try_from_secs_f64(limits.solver_timeout)
        .map_err(|error| CommandError::about("--solver-timeout", error))?;
    let memory = limits.solver_memory.map(|mb| mb.saturating_mul(1_000_000));
    let limits = ProgramLimits { silence, memory };
    let solver = SolverProgram::greet(command, limits);
    let solver = solver.map_err(|error| {
        CommandError::option("--solver", command, format_args!("the solver {error}"))
    })?;
    for warning in solver.warnings() {
        output::complain(&format!("warning: capabilities of the solver: {warning}"));
    }
    Ok(solver)
}

/// Replaces the methods of the suite by the solver, if there is one. Prints a note and returns
/// `None` if the suite tests internals of the built-in methods.
pub(super) fn in_place_of_methods(
    suite: Suite,
    solver: Option<&dyn SolverFactory>,
) -> Option<Suite> {
    match solver {
        Some(solver) => suite_of_solver(&suite, solver, None),
        None => Some(suite),
    }
}

fn suite_of_solver(
    suite: &Suite,
    solver: &dyn SolverFactory,
    terms: Option<&GateTerms>,
) -> Option<Suite> {
    let judged = under_on(suite, solver, terms);
    if judged.is_none() {
        let why = "skipped, because it examines the internals of the built-in methods";
        output::complain(&format!("note: {}: {why}", suite.name));
    }
    judged
}

/// Replaces the methods of the suites by the solver, which must meet `terms`, if any. Also returns
/// the names of the skipped suites, which test internals of the built-in methods.
pub(super) fn suites_of_solver(
    suites: Vec<Suite>,
    solver: &dyn SolverFactory,
    terms: impl Fn(&Suite) -> Option<GateTerms>,
) -> (Vec<Suite>, Vec<String>) {
    let (mut judged, mut left_out) = (Vec::new(), Vec::new());
    for suite in suites {
        match suite_of_solver(&suite, solver, terms(&suite).as_ref()) {
            Some(suite) => judged.push(suite),
            None => left_out.push(suite.name),
        }
    }
    (judged, left_out)
}

pub(super) fn is_applicable(outcomes: &[SuiteOutcome]) -> bool {
    outcomes.iter().flat_map(|outcome| &outcome.cases).any(|case| case.lacks.is_empty())
}

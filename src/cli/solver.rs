//! Suites under a solver of another program.

use super::args::SolverArgs;
use super::output;
use mpm_verify::external::{ProgramLimits, SolverFactory, SolverProgram};
use mpm_verify::study::under;
use mpm_verify::suite::Suite;
use mpm_verify::verify::SuiteOutcome;
use std::time::Duration;

/// The solver that the command line names, if it does.
///
/// # Errors
/// One line that says what is wrong with it.
pub(super) fn greeted(args: &SolverArgs) -> Result<Option<SolverProgram>, String> {
    let Some(command) = &args.solver else { return Ok(None) };
    let silence = Duration::try_from_secs_f64(args.solver_timeout)
        .map_err(|error| format!("error: --solver-timeout: {error}"))?;
    let memory = args.solver_memory.map(|mb| mb.saturating_mul(1_000_000));
    let limits = ProgramLimits { silence, memory };
    let solver = SolverProgram::greet(command, limits);
    let solver =
        solver.map_err(|reason| format!("error: --solver {command}: the solver {reason}"))?;
    for warning in solver.warnings() {
        output::complain(&format!("warning: capabilities of the solver: {warning}"));
    }
    Ok(Some(solver))
}

/// The suites with the solver in place of their methods; those that look inside a method are left
/// out.
pub(super) fn judged(suites: Vec<Suite>, solver: &SolverProgram, gate: bool) -> Vec<Suite> {
    suites.into_iter().filter_map(|suite| judged_suite(&suite, solver, gate)).collect()
}

/// The suite with the solver, if there is one, in place of its methods; `None` if the suite is left
/// out, with a note.
pub(super) fn in_place_of_methods(
    suite: Suite,
    solver: Option<&dyn SolverFactory>,
) -> Option<Suite> {
    match solver {
        Some(solver) => judged_suite(&suite, solver, false),
        None => Some(suite),
    }
}

fn judged_suite(suite: &Suite, solver: &dyn SolverFactory, gate: bool) -> Option<Suite> {
    let judged = under(suite, solver, gate);
    if judged.is_none() {
        let why = "left out, since it looks inside the methods of this crate";
        output::complain(&format!("note: {}: {why}", suite.name));
    }
    judged
}

/// Whether there is a case that the solver could be put to.
pub(super) fn is_applicable(outcomes: &[SuiteOutcome]) -> bool {
    outcomes.iter().flat_map(|outcome| &outcome.cases).any(|case| case.lacks.is_empty())
}

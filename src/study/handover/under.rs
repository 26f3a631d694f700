//! Suites under a solver that is not of this crate.

use super::level_problem;
use crate::external::SolverFactory;
use crate::study::build::dispatch::subject;
use crate::subject::Subject;
use crate::suite::model::external_method::ExternalMethod;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{Case, ConvergencePlan, Suite};

/// The suite with `solver` in place of its methods; see [`Suite::of_external`].
pub fn under(suite: &Suite, solver: &dyn SolverFactory, gate: bool) -> Option<Suite> {
    let (name, formal_order) = (solver.name(), solver.formal_order());
    suite.of_external(ExternalMethod { name, formal_order, precision: solver.precision() }, gate)
}

/// The subject of one level of a case of the suite called `suite`: that of `solver`, if there is
/// one, or of the case's own method.
///
/// # Errors
/// One line that says why there is none.
pub(crate) fn subject_under(
    solver: Option<&dyn SolverFactory>,
    suite: &str,
    plan: &ConvergencePlan,
    case: &Case,
    level: LevelPlan,
) -> Result<Box<dyn Subject>, String> {
    match solver {
        None => subject(plan, case.method, level),
        Some(solver) => solver.subject(level_problem(suite, plan, case, level)?),
    }
}

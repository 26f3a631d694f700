//! Suites with an external solver in place of their methods.

use super::{level_problem, needs};
use crate::external::SolverFactory;
use crate::mpm::{MaterialParameter, MaterialPlan, Range};
use crate::study::setup::dispatch::subject;
use crate::subject::Subject;
use crate::suite::model::method::{ExternalMethod, GateTerms};
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{Case, ConvergencePlan, Suite};
use std::sync::Arc;

/// The suite with `solver` in place of its methods, gated or not; see [`Suite::of_external`].
pub fn under(suite: &Suite, solver: &dyn SolverFactory, gate: bool) -> Option<Suite> {
    under_on(suite, solver, gate.then(GateTerms::default).as_ref())
}

/// The suite with `solver` in place of its methods, gated on the `terms` of the solver's author, if
/// any. Where nothing deforms, the solver gets a law that it has.
pub fn under_on(
    suite: &Suite,
    solver: &dyn SolverFactory,
    terms: Option<&GateTerms>,
) -> Option<Suite> {
    let (name, formal_order) = (solver.name(), solver.formal_order());
    let method = ExternalMethod { name, formal_order, precision: solver.precision() };
    let under = suite.of_external_on(method, terms)?;
    let plan = under.plan::<ConvergencePlan>().and_then(|plan| with_law_of(solver, plan));
    Some(match plan {
        Some(plan) => Suite { study: Arc::new(plan), ..under },
        None => under,
    })
}

/// The plan with a law that `solver` has, if any law will do and the solver lacks the stated one.
fn with_law_of(solver: &dyn SolverFactory, plan: &ConvergencePlan) -> Option<ConvergencePlan> {
    let needs = needs(plan);
    let lacking = if plan.any_method.any_law { solver.lacks(&needs).len() } else { 0 };
    let own = plan.scene.material;
    let mut laws = MaterialPlan::every(|parameter| replaced(&own, parameter)).into_iter();
    let law = laws.find(|law| {
        let mut needs = needs.clone();
        needs.laws = vec![law.name()];
        solver.lacks(&needs).len() < lacking
    })?;
    let mut plan = plan.clone();
    plan.scene.material = law;
    plan.scene.bodies.iter_mut().for_each(|body| body.material = law);
    Some(plan)
}

/// Value of a parameter of another law: that of the stated one if it has the parameter, and
/// otherwise its stiffness, so that the time step remains stable.
fn replaced(own: &MaterialPlan, parameter: &MaterialParameter) -> f64 {
    let parameters = own.parameters();
    let known = parameters.iter().find(|(other, _)| other.what == parameter.what);
    let stiffness = || parameters.iter().find(|(other, _)| other.range == Range::Positive);
    match (known, parameter.range) {
        (Some((_, value)), _) => *value,
        (None, Range::Positive) => stiffness().map_or(1.0, |(_, value)| *value),
        (None, Range::NotNegative | Range::PoissonsRatio | Range::Angle) => 0.0,
    }
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

//! Capabilities that a suite requires of a solver, and suites with an external solver.

use super::level_problem;
use super::particles::starts_deformed;
use crate::external::{ProblemNeeds, SMALL_STRAIN, SolverFactory};
use crate::mpm::{MaterialParameter, MaterialPlan, Range};
use crate::study::kind::study;
use crate::study::setup::dispatch::subject;
use crate::subject::{PlaneState, Subject, SubjectError};
use crate::suite::grammar::CrossingLevels;
use crate::suite::model::method::{ExternalMethod, GateTerms, LawChoice};
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{Case, ConvergencePlan, Scene, SceneFace, Suite};
use crate::suite::scene::load::{ListedLoad, LoadTarget};
use crate::verify::{Quantity, StepKind, SumNeed};

/// Returns the capabilities that a convergence study requires.
pub fn needs(plan: &ConvergencePlan) -> ProblemNeeds {
    let mut needs = ProblemNeeds {
        columns: plan.of.columns(plan.scene.dimension()),
        manufactured: plan.manufactured().is_some(),
        initial_deformation: starts_deformed(plan),
        load_steps: plan.steps == StepKind::Load,
        crossings: plan.crossing_levels == CrossingLevels::Excluded,
        velocity: plan.of == Quantity::Velocity
            || plan.of.is_sum()
            || plan.exact.as_ref().is_some_and(|exact| exact.at_rest),
        small_strain: plan
            .exact
            .as_ref()
            .is_some_and(|exact| exact.equation.name() == SMALL_STRAIN),
        ..of_scene(&plan.scene)
    };
    let energy_or_wall = [SumNeed::StoredEnergy, SumNeed::Wall];
    if plan.refine.levels.iter().any(|level| level.ppc.is_none()) {
        needs.beyond.push("levels without particles (`refine` states no `ppc`)");
    }
    if plan.of.sum_need().is_some_and(|need| energy_or_wall.contains(&need)) {
        needs.beyond.push("the judged energy or reaction");
    }
    needs
}

/// Returns the capabilities that a scene requires, without those for judged quantities.
pub(crate) fn of_scene(scene: &Scene) -> ProblemNeeds {
    let mut needs = ProblemNeeds {
        dimension: scene.dimension(),
        laws: scene.each().iter().map(|body| body.material.name()).collect(),
        conditions: scene.faces.iter().map(SceneFace::condition).collect(),
        loads: scene.loads.iter().map(|load| load.effect.name()).collect(),
        several_bodies: !scene.bodies.is_empty(),
        contact: scene.contact.is_some(),
        plane_stress: scene.plane == PlaneState::Stress,
        axisymmetric: scene.plane == PlaneState::Axisymmetric,
        initial_stress: scene.each().iter().any(|body| !body.initial_stress.is_none()),
        varying_density: scene.each().iter().any(|body| body.density.uniform().is_none()),
        loaded_rims: scene.loads.iter().any(|load| matches!(load.target(), LoadTarget::Rim(_))),
        displacement_force: scene.terms().iter().any(|term| term.depends_on_displacement()),
        ..ProblemNeeds::default()
    };
    for names in [&mut needs.laws, &mut needs.conditions, &mut needs.loads] {
        names.sort_unstable();
        names.dedup();
    }
    let is_not_handed_over = |load: &&ListedLoad| load.numbers().is_empty();
    let beyond = scene.loads.iter().filter(is_not_handed_over);
    needs.beyond.extend(beyond.map(|load| load.effect.name()));
    needs
}

/// Lists the capabilities that `suite` requires and `solver` lacks; empty for a study that external
/// solvers cannot run.
pub fn lacking(suite: &Suite, solver: &dyn SolverFactory) -> Vec<String> {
    study(suite).needs().map_or(Vec::new(), |needs| solver.lacks(&needs))
}

/// Replaces the methods of the suite by `solver`. If `gate` is true, the cases get the requirements
/// of `run --gate` (see [`Suite::of_external`]).
pub fn under(suite: &Suite, solver: &dyn SolverFactory, gate: bool) -> Option<Suite> {
    under_on(suite, solver, gate.then(GateTerms::default).as_ref())
}

/// Replaces the methods of the suite by `solver`. If `terms` are given, the cases get the
/// requirements of `run --gate`, as modified by these terms of the solver's author. If the suite
/// states `any_law`, the law may be replaced by one that the solver supports.
pub fn under_on(
    suite: &Suite,
    solver: &dyn SolverFactory,
    terms: Option<&GateTerms>,
) -> Option<Suite> {
    let (name, formal_order) = (solver.name(), solver.formal_order());
    let method = ExternalMethod { name, formal_order, precision: solver.precision() };
    let under = suite.of_external(method, terms)?;
    let plan = under.convergence().and_then(|plan| with_law_of(solver, plan));
    Some(match plan {
        Some(plan) => Suite { study: plan.into(), ..under },
        None => under,
    })
}

/// Copies the plan with a law that `solver` supports. `None` if `solver` supports the law of the
/// plan or no law, or if the results depend on the law.
fn with_law_of(solver: &dyn SolverFactory, plan: &ConvergencePlan) -> Option<ConvergencePlan> {
    let needs = needs(plan);
    let lacking = solver.lacks(&needs).len();
    let laws = |own: &MaterialPlan| MaterialPlan::every(|parameter| replaced(own, parameter));
    let may_replace = |law: &MaterialPlan| match plan.any_method.law {
        LawChoice::Stated => false,
        LawChoice::SameModuli => law.is_isotropic_elastic(),
        LawChoice::Any => true,
    };
    let number = laws(&plan.scene.material).iter().position(|law| {
        let needs = ProblemNeeds { laws: vec![law.name()], ..needs.clone() };
        may_replace(law) && solver.lacks(&needs).len() < lacking
    })?;
    let mut plan = plan.clone();
    plan.scene.material = laws(&plan.scene.material)[number];
    for body in &mut plan.scene.bodies {
        body.material = laws(&body.material)[number];
    }
    Some(plan)
}

/// Returns a parameter of the replacing law: that of the law `own`, if it has one. Otherwise a
/// positive parameter gets the stiffness of `own`, so the time step remains stable.
fn replaced(own: &MaterialPlan, parameter: &MaterialParameter) -> f64 {
    let parameters = own.parameters();
    let known = parameters.iter().find(|(other, _)| other.what == parameter.what);
    let stiffness = || parameters.iter().find(|(other, _)| other.range == Range::Positive);
    match (known, parameter.range) {
        (Some((_, value)), _) => *value,
        (None, Range::Positive) => stiffness().map_or(1.0, |(_, value)| *value),
        (None, Range::AboveOne) => 2.0,
        (None, Range::NotNegative | Range::PoissonsRatio | Range::Angle) => 0.0,
    }
}

pub(crate) fn subject_under(
    solver: Option<&dyn SolverFactory>,
    suite: &str,
    plan: &ConvergencePlan,
    case: &Case,
    level: LevelPlan,
) -> Result<Box<dyn Subject>, SubjectError> {
    match solver {
        None => subject(plan, case.method, level),
        Some(solver) => {
            let mut problem = level_problem(suite, plan, case, level)?;
            let needs = needs(plan);
            let rate_form = ProblemNeeds { small_strain: false, ..needs.clone() };
            if needs.small_strain && !solver.lacks(&rate_form).is_empty() {
                problem.replace_by_small_strain();
            }
            solver.subject(problem)
        }
    }
}

//! Abilities that a suite asks of a solver.

use super::particles::starts_deformed;
use crate::external::{ProblemNeeds, SolverFactory};
use crate::study::kind::study;
use crate::subject::PlaneState;
use crate::suite::model::{ConvergencePlan, Scene, SceneFace, Suite};
use crate::suite::scene::load::ListedLoad;
use crate::verify::{Quantity, SumNeed};

/// The needs of a convergence study.
pub fn needs(plan: &ConvergencePlan) -> ProblemNeeds {
    let mut needs = ProblemNeeds {
        column: column(plan.of),
        manufactured: plan.manufactured().is_some(),
        initial_deformation: starts_deformed(plan),
        ..of_scene(&plan.scene)
    };
    let energy_or_wall = [SumNeed::StoredEnergy, SumNeed::Wall];
    if plan.of.sum_need().is_some_and(|need| energy_or_wall.contains(&need)) {
        needs.beyond.push("the judged energy or reaction");
    }
    needs
}

/// The needs of a scene, whatever is asked of it.
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

/// Everything that `suite` needs and `solver` lacks; nothing of a study that is none of a solver.
pub fn lacking(suite: &Suite, solver: &dyn SolverFactory) -> Vec<String> {
    study(suite).needs().map_or(Vec::new(), |needs| solver.lacks(&needs))
}

/// The column that is judged, if it is none that every solver gives.
fn column(of: Quantity) -> Option<&'static str> {
    (of.is_optional() && !of.is_sum()).then(|| of.name())
}

//! Computes the initial particles of a run, and their exact state at a later time.

use crate::exact::Truth;
use crate::external::ProblemParticles;
use crate::mpm::input::{MpmMethod, initial_particles};
use crate::mpm::{
    BasisName, FrameName, MassName, SchemeName, TransferName, VolumeName, det_of_rows,
};
use crate::study::setup::body::{Body, scene_input};
use crate::study::setup::initial_state::Initial;
use crate::subject::{Perturbable, Precision, Start, SubjectError};
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{ConvergencePlan, Scene};

pub(super) fn particles(
    plan: &ConvergencePlan,
    level: LevelPlan,
) -> Result<ProblemParticles, SubjectError> {
    let bare = unloaded(&plan.scene);
    let body = |own| Body { manufactured: None, ..Body::of(plan, own) };
    let bodies: Vec<Body<'_>> = bare.iter().map(body).collect();
    start(bodies, level, &mut |_| ())
}

/// Copies the bodies of a scene without their loads, which do not affect the initial state.
pub(crate) fn unloaded(scene: &Scene) -> Vec<Scene> {
    scene.each().iter().map(|own| Scene { loads: Vec::new(), ..own.clone() }).collect()
}

pub(crate) fn start(
    bodies: Vec<Body<'_>>,
    level: LevelPlan,
    disturb: &mut dyn FnMut(&mut dyn Perturbable),
) -> Result<ProblemParticles, SubjectError> {
    // A method is chosen that stores no state except that of the particles.
    let method = MpmMethod {
        basis: BasisName::Linear,
        transfer: TransferName::Flip.into(),
        scheme: SchemeName::Usl,
        start: Start::AtZero,
        mass: MassName::Lumped,
        frame: FrameName::Updated,
        volume: VolumeName::Particle,
        precision: Precision::Double,
    };
    let d = bodies.first().map_or(1, |body| body.scene.dimension());
    let stresses: Vec<_> = bodies.iter().map(|body| &body.own.initial_stress).collect();
    let is_stressed = stresses.iter().any(|stress| !stress.is_none());
    let is_stressed_across =
        stresses.iter().any(|stress| stress.components().iter().any(|(i, ..)| *i >= d));
    let tables = initial_particles(scene_input(bodies, level)?, method, disturb)?;
    let mut all = ProblemParticles::default();
    for (number, (table, initial_stress)) in tables.into_iter().zip(stresses).enumerate() {
        if is_stressed {
            for label in table.reference_position.chunks_exact(d) {
                let stress = initial_stress.at(label);
                all.initial_stress.extend((0..d * d).map(|k| stress[k / d][k % d]));
                if is_stressed_across {
                    all.initial_stress_across.extend((d..3).map(|i| stress[i][i]));
                }
            }
        }
        all.body.extend(vec![number as f64; table.mass.len()]);
        all.reference_position.extend(table.reference_position);
        all.position.extend(table.position);
        all.velocity.extend(table.velocity);
        all.mass.extend(table.mass);
        all.reference_volume.extend(table.reference_volume);
        all.volume.extend(table.volume);
        all.deformation_gradient.extend(table.deformation_gradient);
        all.stress.extend(table.stress);
        all.hoop_stress.extend(table.hoop_stress);
    }
    Ok(all)
}

/// Whether a particle of the coarsest level is displaced at the start, or F differs from I.
pub(super) fn starts_deformed(plan: &ConvergencePlan) -> bool {
    let displaced = |body: &Scene| Initial::of_body(plan, body).is_displaced();
    if !plan.scene.each().iter().any(displaced) {
        return false;
    }
    let level = plan.refine.levels.first();
    // If a level cannot be passed to a solver, its run reports the reason.
    let start = level.and_then(|level| particles(plan, *level).ok());
    start.is_some_and(|start| is_deformed(&start, plan.scene.dimension()))
}

pub(crate) fn is_deformed(start: &ProblemParticles, d: usize) -> bool {
    let identity = |k: usize| f64::from(u8::from(k / d == k % d));
    let mut f = start.deformation_gradient.iter().enumerate();
    start.position != start.reference_position || f.any(|(k, f)| *f != identity(k % (d * d)))
}

/// Returns the particles in their exact state at time `t` (s): position and velocity, and F, volume
/// and stress if these are known. Masses and reference positions are copied from `start`.
///
/// # Errors
/// The reason why there is no exact state.
pub fn exact_state(
    plan: &ConvergencePlan,
    start: &ProblemParticles,
    t: f64,
) -> Result<ProblemParticles, SubjectError> {
    let truth = plan.exact.as_ref().ok_or("the suite states no exact motion")?;
    let d = plan.scene.dimension();
    let mut state = start.clone();
    for (p, label) in start.reference_position.chunks_exact(d).enumerate() {
        let (vector, tensor) = (p * d..(p + 1) * d, p * d * d..(p + 1) * d * d);
        let position = &mut state.position[vector.clone()];
        truth.displacement(label, t, position);
        position.iter_mut().zip(label).for_each(|(u, label)| *u += label);
        truth.velocity(label, t, &mut state.velocity[vector]);
        let f = &mut state.deformation_gradient[tensor.clone()];
        if truth.deformation_gradient(label, t, f) {
            state.volume[p] = det_of_rows(d, f) * start.reference_volume[p];
        }
        truth.stress(label, t, &mut state.stress[tensor]);
    }
    Ok(state)
}

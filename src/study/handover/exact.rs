//! The exact state at the places of a level's particles.

use crate::exact::Truth;
use crate::external::ProblemParticles;
use crate::mpm::det_of_rows;
use crate::suite::model::ConvergencePlan;

/// The particles as the exact motion has them at time `t` (s): position, velocity, and where they
/// are known F, volume and stress. Masses and reference positions are those of `start`.
///
/// # Errors
/// One line that says why there is no exact state.
pub fn exact_state(
    plan: &ConvergencePlan,
    start: &ProblemParticles,
    t: f64,
) -> Result<ProblemParticles, String> {
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

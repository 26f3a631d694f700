//! Mass-proportional damping, for dynamic relaxation.
//!
//! `dv/dt = -alpha(t) v` for every material point, as the exact factor `exp(-alpha dt)` on the
//! velocities of the particles, once a step, after they have been taken from the grid.
//!
//! It is not a force `-alpha m_i v_i` on the nodes: FLIP keeps the part of the particle velocities
//! in the null space of the map to the grid, which such a force would never damp. On particles the
//! damping is stable for every alpha and dt, scheme and transfer. Strain and positions follow in
//! the same step with MUSL and in the next with USF and USL, so that the damping has first order in
//! time. It has no effect on a body at rest. An affine state (APIC) is not scaled: it comes from
//! grid velocities, which are mapped from damped velocities.

use super::contract::Effect;
use crate::mpm::foundation::particles::Particles;

/// A rate of damping alpha(t) (1/s).
pub struct Damping(pub Box<dyn Fn(f64) -> f64 + Send>);

impl<const D: usize> Effect<D> for Damping {
    fn name(&self) -> &'static str {
        "damping"
    }

    fn modify_velocity(&self, t: f64, dt: f64, particles: &mut Particles<D>) {
        let factor = libm::exp(-(self.0)(t - 0.5 * dt) * dt);
        for v in &mut particles.v {
            *v *= factor;
        }
    }
}

//! Mass-proportional damping, for dynamic relaxation.
//!
//! `dv/dt = -alpha(t) v` for every material point. Once per step, after G2P, the particle
//! velocities are multiplied by the exact factor `exp(-alpha dt)`.
//!
//! A force `-alpha m_i v_i` on the nodes would not damp the null-space part of the particle
//! velocities, which FLIP retains. Damping of particles is stable for every alpha, dt, scheme and
//! transfer. The damping affects strain and positions in the same step with MUSL, and in the next
//! step with USF and USL. The damping is therefore of first order in time. The damping has no
//! effect on a body at rest. The affine velocity of APIC is not multiplied by the factor, because
//! this velocity comes from grid velocities that were mapped from damped velocities.

use super::contract::Effect;
use crate::mpm::foundation::particles::Particles;

/// Mass-proportional damping with the rate alpha(t) (1/s).
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

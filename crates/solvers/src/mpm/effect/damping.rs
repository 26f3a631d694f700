//! Mass-proportional damping, for dynamic relaxation.
//!
//! `dv/dt = -alpha(t) v` for every material point. Once per step, after G2P, the particle
//! velocities are multiplied by the exact factor `exp(-alpha dt)`.
//!
//! Damping of particles is stable for every alpha, dt, scheme and transfer. Unlike a force
//! `-alpha m_i v_i` on the nodes, it also damps the part of the particle velocities that FLIP
//! retains although the grid does not resolve it (the null space). Strain and positions are
//! affected in the same step with MUSL, and in the next step with USF and USL, so the damping is of
//! first order in time. The affine velocity of APIC is not multiplied by the factor, because it is
//! computed from damped velocities.

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

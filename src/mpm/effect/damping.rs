//! Mass-proportional damping, for dynamic relaxation.
//!
//! `dv/dt = -alpha(t) v` for every material point, as the exact factor `exp(-alpha dt)` on the
//! velocities of the particles, once a step, after they have been taken from the grid.
//!
//! Not as a force `-alpha m_i v_i` on the nodes: FLIP keeps what the grid does not see of its
//! particles' velocities, and that would never come to rest. On particles it is stable for every
//! alpha and dt, whatever the scheme and the transfer. Strain and positions follow in the same step
//! with MUSL and in the next with USF and USL: on the way the damping is of first order in time; at
//! rest it is nothing. An affine state (APIC) is left as it came from the grid, which saw the
//! damped velocities.

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

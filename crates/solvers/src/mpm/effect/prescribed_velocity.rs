//! A set of particles with a prescribed velocity.
//!
//! The particle velocities are set after the transfer from the grid, and the particles move with
//! these velocities instead of the grid velocity. The rest of the body is affected by the next P2G
//! of velocities: in the same step with MUSL, in the next step with USF and USL.

use super::contract::Effect;
use crate::mpm::boundary::{VelocityField, continued};
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::particles::Particles;
use mpm_subject::Column;

/// Prescribed velocity v(X, t) (m/s) of a set of particles.
pub struct PrescribedVelocity<const D: usize> {
    value: VelocityField<D>,
    /// Index and initial position (m) of each particle.
    members: Vec<(usize, Vector<D>)>,
}

impl<const D: usize> PrescribedVelocity<D> {
    /// Prescribes the velocity `value` for the particles `members`.
    pub fn on(particles: &Particles<D>, members: &[usize], value: VelocityField<D>) -> Self {
        Self { value, members: members.iter().map(|&p| (p, particles.x[p])).collect() }
    }
}

impl<const D: usize> Effect<D> for PrescribedVelocity<D> {
    fn name(&self) -> &'static str {
        "velocity"
    }

    fn columns(&self) -> Vec<Column<'_>> {
        vec![Column::of_particles("prescribed", &self.members)]
    }

    fn modify_velocity(&self, t: f64, _: f64, particles: &mut Particles<D>) {
        for (p, _) in &self.members {
            particles.v[*p] = continued(&self.value, &particles.x0[*p], t);
        }
    }

    fn modify_position(&mut self, dt: f64, particles: &mut Particles<D>) {
        for (p, x) in &mut self.members {
            *x += particles.v[*p] * dt;
            particles.positions_mut()[*p] = *x;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A leapfrog method starts with velocities at -dt/2. At this time, the velocity
    /// `v = X (1 + 2 t)` is X (1 - dt).
    #[test]
    fn a_velocity_is_continued_before_the_start() {
        let mut particles = Particles::cubes([2]);
        let value: VelocityField<1> = Box::new(|x, t| x * (1.0 + 2.0 * t));
        let driven = PrescribedVelocity::on(&particles, &[1], value);
        for (t, expected) in [(-0.125, 0.75), (0.0, 1.0), (0.125, 1.25)] {
            driven.modify_velocity(t, 0.25, &mut particles);
            assert_eq!((particles.v[0][0], particles.v[1][0]), (0.0, 1.5 * expected));
        }
    }
}

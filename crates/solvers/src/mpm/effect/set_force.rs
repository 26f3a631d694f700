//! A force on a set of particles, distributed in proportion to the reference volumes of the
//! particles.
//!
//! `f_ext_i += f(t) sum_p (V0_p/V0) N_i(x_p)` over the set, with its total reference volume V0.
//! This is a body force that is uniform in the reference configuration and follows the particles.

use super::contract::{BodyOnGrid, Effect};
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::particles::Particles;
use mpm_subject::Column;

/// A total force f(t) on a set of particles (N, per m^(3-D) of thickness).
pub struct SetForce<const D: usize> {
    value: Box<dyn Fn(f64) -> Vector<D> + Send>,
    /// Index of each particle with its fraction of the force. The sum of the fractions is 1.
    shares: Vec<(usize, f64)>,
}

impl<const D: usize> SetForce<D> {
    /// Applies the force `value` to the particles `members`.
    pub fn on(
        particles: &Particles<D>,
        members: &[usize],
        value: Box<dyn Fn(f64) -> Vector<D> + Send>,
    ) -> Self {
        let volume: f64 = members.iter().map(|&p| particles.vol0[p]).sum();
        Self { value, shares: members.iter().map(|&p| (p, particles.vol0[p] / volume)).collect() }
    }
}

impl<const D: usize> Effect<D> for SetForce<D> {
    fn name(&self) -> &'static str {
        "force"
    }

    fn columns(&self) -> Vec<Column<'_>> {
        vec![Column::of_particles("force share", &self.shares)]
    }

    fn add_force(&mut self, t: f64, body: &mut BodyOnGrid<'_, D>) -> u64 {
        let force = (self.value)(t);
        for &(p, share) in &self.shares {
            body.add_point_force(p, &(force * share));
        }
        body.pairs(self.shares.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_particles_have_a_large_share() {
        let mut particles = Particles::cubes([3]);
        particles.vol0 = vec![1.0, 5.0, 3.0];
        let force = SetForce::on(&particles, &[0, 2], Box::new(|_| Vector::zeros()));
        assert_eq!(force.shares, [(0, 0.25), (2, 0.75)]);
    }
}

//! A set of particles that move as they are told.
//!
//! Their velocity is set once the grid's has been taken, and they move with it rather than with the
//! grid. What is around them learns of it when velocities are mapped to the grid: in MUSL within
//! the same step, in USF and USL in the next.

use super::{contract::Effect, name::EffectName};
use crate::{
    mpm::{
        algebra::Vector,
        boundary::{VelocityField, continued},
        particles::Particles,
    },
    subject::{Checkpoint, Column},
};

/// A velocity v(X, t) (m/s) that a set of particles has.
pub struct PrescribedVelocity<const D: usize> {
    value: VelocityField<D>,
    /// Particles and where they are (m).
    members: Vec<(usize, Vector<D>)>,
}

impl<const D: usize> PrescribedVelocity<D> {
    /// The velocity `value` for the particles `members`.
    pub fn on(particles: &Particles<D>, members: &[usize], value: VelocityField<D>) -> Self {
        Self { value, members: members.iter().map(|&p| (p, particles.x[p])).collect() }
    }
}

impl<const D: usize> Effect<D> for PrescribedVelocity<D> {
    fn name(&self) -> EffectName {
        EffectName::PrescribedVelocity
    }

    fn columns(&self) -> Vec<Column> {
        vec![Column::of_particles("driven", &self.members)]
    }

    fn checkpoint(&mut self, checkpoint: &mut Checkpoint<'_>) {
        self.members.iter_mut().for_each(|(_, x)| checkpoint.visit(x));
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

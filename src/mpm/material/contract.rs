//! What a material is to the rest of the solver.

use crate::{
    mpm::particles::Particles,
    subject::{Checkpoint, Column},
};

/// A constitutive law, with the state that only it reads. It meets the solver between stages: one
/// virtual call per step.
pub trait Material<const D: usize>: Send {
    /// Whether the law reads F: the column exists only then, or if the basis asks for it.
    fn reads_deformation(&self) -> bool;

    /// What the law remembers of each particle.
    fn columns(&self) -> Vec<Column> {
        Vec::new()
    }

    /// Shows what the law remembers.
    fn checkpoint(&mut self, _: &mut Checkpoint<'_>) {}

    /// Energy that all particles store, over the whole body (J); `None` where what stress has done is
    /// no function of the state. What a law dissipates is not stored.
    fn energy(&self, _: &Particles<D>) -> Option<f64> {
        None
    }

    /// New stresses and volumes of all particles from their velocity gradients over `dt` (s). F,
    /// where it exists, is that of the end of the step already. Allocates in the first call only.
    fn update(&mut self, dt: f64, particles: &mut Particles<D>);
}

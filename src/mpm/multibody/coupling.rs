//! What couples bodies at the nodes where they meet.

use crate::{
    mpm::solver::Solver,
    subject::{Checkpoint, Column},
};

/// A coupling of two or more bodies. Each method comes after all bodies have taken a stage.
pub(in crate::mpm) trait Coupling<const D: usize>: Send {
    /// Name, as suites write it, if it is an effect.
    fn name(&self) -> Option<&'static str>;

    /// What it keeps for nodes.
    fn columns(&self) -> Vec<Column>;

    /// Shows what it remembers from step to step.
    fn checkpoint(&mut self, _: &mut Checkpoint<'_>) {}

    /// Whether it reads velocities before accelerations.
    fn reads_velocity(&self) -> bool;

    /// Takes in that bodies have moved; their masses are up to date.
    fn meet(&mut self, bodies: &mut [Solver<D>]);

    /// The nodes at which bodies meet.
    fn nodes(&self) -> &[usize];

    /// Velocities have been mapped and are still to be advanced.
    fn velocity(&mut self, bodies: &mut [Solver<D>]);

    /// Velocities have been mapped, and strains follow from them next.
    fn straining_velocity(&mut self, bodies: &mut [Solver<D>]);

    /// Strains have followed from velocities that are still to be advanced.
    fn strained(&mut self, bodies: &mut [Solver<D>]);

    /// Accelerations over `dt` (s) have been found.
    fn acceleration(&mut self, bodies: &mut [Solver<D>], dt: f64);
}

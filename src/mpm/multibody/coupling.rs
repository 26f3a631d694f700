//! Contract of a coupling of bodies with their steps.

use crate::mpm::step::schedule::CouplingPoint;
use crate::mpm::step::solver::Solver;
use crate::subject::{Checkpoint, Column};

/// Coupling of two or more bodies at the nodes of their interface.
pub(in crate::mpm) trait Coupling<const D: usize>: Send {
    /// Name in suites, if it is an effect.
    fn name(&self) -> Option<&'static str>;

    /// Columns for nodes.
    fn columns(&self) -> Vec<Column<'_>>;

    /// State between two steps.
    fn checkpoint(&mut self, _: &mut Checkpoint<'_>) {}

    /// Whether it reads velocities before they advance.
    fn reads_velocity(&self) -> bool;

    /// Nodes at which bodies meet.
    fn nodes(&self) -> &[usize];

    /// Couples the bodies at one point of a step of `dt` (s).
    fn couple(&mut self, at: CouplingPoint, bodies: &mut [Solver<D>], dt: f64);
}

//! What an effect is to the rest of the solver.

use crate::mpm::{grid::Grid, kernel::Kernel, particles::Particles};

/// A pass between stages. Hooks are empty unless an effect fills them.
pub trait Effect<const D: usize>: Send {
    /// Adds external forces at time `t` (s) to `grid.force`; the masses of the grid are up to date.
    /// Returns the particle-node pairs visited.
    fn add_force(
        &self,
        t: f64,
        particles: &Particles<D>,
        kernel: &dyn Kernel<D>,
        grid: &mut Grid<D>,
    ) -> u64;
}

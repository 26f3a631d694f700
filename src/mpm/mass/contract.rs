//! Contract of a mass matrix with the rest of the solver.

use crate::mpm::boundary::Boundary;
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::Kernel;
use crate::subject::Failure;

/// Turns nodal momenta into velocities, and forces into accelerations.
pub trait MassMatrix<const D: usize>: Send + Sync {
    /// Assembles the matrix for new positions of the particles; `grid.mass` is up to date. Returns
    /// the passes over particles that it took.
    ///
    /// # Errors
    /// [`Failure::Solve`] if there is no inverse.
    fn assemble(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &Grid<D>,
        boundary: &[Box<dyn Boundary<D>>],
    ) -> Result<u64, Failure>;

    /// Divides `field` (kg m/s, or N) by the matrix. Values on held nodes are not defined.
    fn solve(&self, grid: &Grid<D>, field: &mut [Vector<D>]);
}

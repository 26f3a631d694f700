//! Row sums on the diagonal: `m_i = sum_p m_p N_i(x_p)`.
//!
//! Second order at best, whatever the degree of the basis.

use super::contract::MassMatrix;
use crate::mpm::boundary::Boundary;
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::Kernel;
use crate::subject::Failure;

/// The mass matrix of the original MPM.
#[derive(Debug, Clone, Copy)]
pub struct Lumped;

impl<const D: usize> MassMatrix<D> for Lumped {
    fn assemble(
        &mut self,
        _: &dyn Kernel<D>,
        _: &Particles<D>,
        _: &Grid<D>,
        _: &[Box<dyn Boundary<D>>],
    ) -> Result<u64, Failure> {
        Ok(0)
    }

    fn solve(&self, grid: &Grid<D>, field: &mut [Vector<D>]) {
        grid.divide_by_mass(field);
    }
}

//! The consistent matrix, `M_ij = sum_p m_p N_i(x_p) N_j(x_p)` (Sulsky, Chen & Schreyer 1994, eq.
//! 2.16), solved by a sparse Cholesky factorisation.
//!
//! It is what order p + 1 needs with a basis of degree p > 1. Nodes without mass have no row, held
//! nodes none in the component that is held. A node that too few particles see makes the matrix
//! singular, and the run fails with that reason. Assembling allocates in every step.

use super::contract::MassMatrix;
use crate::{
    mpm::{algebra::Vector, boundary::Fixed, grid::Grid, kernel::Kernel, particles::Particles},
    subject::Failure,
};
use nalgebra::DVector;
use nalgebra_sparse::{CooMatrix, CscMatrix, factorization::CscCholesky};

/// The consistent mass matrix.
#[derive(Default)]
pub struct Consistent {
    /// Row of each node; None where it has none.
    row: Vec<Option<usize>>,
    rows: usize,
    factor: Option<CscCholesky<f64>>,
}

impl Consistent {
    /// Numbers the nodes that have mass and are not held.
    fn number<const D: usize>(&mut self, grid: &Grid<D>, fixed: &[Fixed]) {
        let mut free: Vec<bool> = grid.mass.iter().map(|m| *m > 0.0).collect();
        for &node in fixed.iter().flat_map(Fixed::nodes) {
            free[node] = false;
        }
        self.rows = 0;
        self.row.clear();
        for free in free {
            self.row.push(free.then_some(self.rows));
            self.rows += usize::from(free);
        }
    }
}

impl<const D: usize> MassMatrix<D> for Consistent {
    fn assemble(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &Grid<D>,
        fixed: &[Fixed],
    ) -> Result<u64, Failure> {
        self.number(grid, fixed);
        let mut entries = CooMatrix::new(self.rows, self.rows);
        kernel.mass_entries(grid, particles, &mut |i, j, mass| {
            if let (Some(i), Some(j)) = (self.row[i], self.row[j]) {
                entries.push(i, j, mass);
            }
        });
        let factor = CscCholesky::factor(&CscMatrix::from(&entries)).map_err(|_| {
            Failure::Solve(
                "the consistent mass matrix is singular: a node is seen by too few particles"
                    .to_owned(),
            )
        })?;
        self.factor = Some(factor);
        // Every pair of nodes is visited.
        Ok(1 + kernel.support())
    }

    fn solve(&self, _: &Grid<D>, field: &mut [Vector<D>]) {
        let Some(factor) = &self.factor else { return };
        for axis in 0..D {
            let mut side = DVector::zeros(self.rows);
            for (value, row) in field.iter().zip(&self.row) {
                if let Some(row) = row {
                    side[*row] = value[axis];
                }
            }
            factor.solve_mut(&mut side);
            for (value, row) in field.iter_mut().zip(&self.row) {
                value[axis] = row.map_or(0.0, |row| side[row]);
            }
        }
    }
}

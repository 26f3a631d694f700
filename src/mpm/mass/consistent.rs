//! The consistent matrix, `M_ij = sum_p m_p N_i(x_p) N_j(x_p)` (Sulsky, Chen & Schreyer 1994, eq.
//! 2.16), solved by a sparse Cholesky factorisation.
//!
//! It is what order p + 1 needs with a basis of degree p > 1. Nodes without mass have no row, held
//! nodes none in the component that is held: there, walls must be at rest. A node that too few
//! particles see makes the matrix singular, and the run fails with that reason. Assembling allocates
//! in every step; where the factor has its entries is found anew only if those of the matrix have moved.

use super::contract::MassMatrix;
use crate::{
    mpm::{algebra::Vector, boundary::Boundary, grid::Grid, kernel::Kernel, particles::Particles},
    subject::Failure,
};
use nalgebra::DVector;
use nalgebra_sparse::{
    CooMatrix, CscMatrix,
    factorization::{CholeskyError, CscCholesky, CscSymbolicCholesky},
    pattern::SparsityPattern,
};

/// The consistent mass matrix.
#[derive(Default)]
pub struct Consistent {
    /// One for each axis, but for axes on which the same nodes are held.
    factors: Vec<Factor>,
}

/// The matrix of the nodes that are free along an axis.
struct Factor {
    /// Row of each node; None where it has none.
    row: Vec<Option<usize>>,
    rows: usize,
    /// Where the matrix has entries.
    pattern: SparsityPattern,
    cholesky: CscCholesky<f64>,
}

impl Factor {
    /// The factor after `last`, that of the step before.
    fn after(
        last: Option<Self>,
        free: &[bool],
        entries: &[(usize, usize, f64)],
    ) -> Result<Self, Failure> {
        let mut rows = 0;
        let mut number = |free: &bool| {
            rows += usize::from(*free);
            free.then(|| rows - 1)
        };
        let row: Vec<_> = free.iter().map(&mut number).collect();
        let mut matrix = CooMatrix::new(rows, rows);
        for &(i, j, mass) in entries {
            if let (Some(i), Some(j)) = (row[i], row[j]) {
                matrix.push(i, j, mass);
            }
        }
        let (pattern, values) = CscMatrix::from(&matrix).into_pattern_and_values();
        let cholesky = factorised(last, &pattern, &values).map_err(|_| {
            let why = "the consistent mass matrix is singular: too few particles see some node";
            Failure::Solve(why.to_owned())
        })?;
        Ok(Self { row, rows, pattern, cholesky })
    }

    fn solve<const D: usize>(&self, axis: usize, field: &mut [Vector<D>]) {
        let mut side = DVector::zeros(self.rows);
        for (value, row) in field.iter().zip(&self.row) {
            if let Some(row) = row {
                side[*row] = value[axis];
            }
        }
        self.cholesky.solve_mut(&mut side);
        for (value, row) in field.iter_mut().zip(&self.row) {
            value[axis] = row.map_or(0.0, |row| side[row]);
        }
    }
}

/// The Cholesky factor, in the place of that of a matrix with the same pattern if there is one: the steps
/// of the factorisation, and so its bits, are the same.
fn factorised(
    last: Option<Factor>,
    pattern: &SparsityPattern,
    values: &[f64],
) -> Result<CscCholesky<f64>, CholeskyError> {
    match last.filter(|last| last.pattern == *pattern) {
        Some(Factor { mut cholesky, .. }) => cholesky.refactor(values).map(|()| cholesky),
        None => CscCholesky::factor_numerical(CscSymbolicCholesky::factor(pattern.clone()), values),
    }
}

/// Where nothing is held and there is mass: one where a component is free, zero elsewhere.
fn free<const D: usize>(grid: &Grid<D>, boundary: &[Box<dyn Boundary<D>>]) -> Vec<Vector<D>> {
    let has_mass = |m: &f64| Vector::from_element(f64::from(u8::from(*m > 0.0)));
    let mut free: Vec<Vector<D>> = grid.mass.iter().map(has_mass).collect();
    for condition in boundary {
        condition.clear(&mut free);
    }
    free
}

impl<const D: usize> MassMatrix<D> for Consistent {
    fn assemble(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &Grid<D>,
        boundary: &[Box<dyn Boundary<D>>],
    ) -> Result<u64, Failure> {
        let mut entries = Vec::new();
        kernel.mass_entries(grid, particles, &mut |i, j, mass| entries.push((i, j, mass)));
        let free = free(grid, boundary);
        let along = |axis: usize| free.iter().map(|f| f[axis] > 0.0).collect::<Vec<bool>>();
        let mut last = std::mem::take(&mut self.factors).into_iter();
        let same = (1..D).all(|axis| along(axis) == along(0));
        for axis in 0..if same { 1 } else { D } {
            self.factors.push(Factor::after(last.next(), &along(axis), &entries)?);
        }
        // Every pair of nodes is visited.
        Ok(1 + kernel.support())
    }

    fn solve(&self, _: &Grid<D>, field: &mut [Vector<D>]) {
        for axis in 0..D {
            if let Some(factor) = self.factors.get(axis).or(self.factors.first()) {
                factor.solve(axis, field);
            }
        }
    }
}

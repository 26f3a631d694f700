//! Mass matrices, and the solve that turns forces into accelerations.

use nalgebra::DMatrixViewMut;
use nalgebra_sparse::factorization::CscCholesky;
use nalgebra_sparse::{CooMatrix, CscMatrix};

use super::Mass;
use super::mesh::Mesh;
use mpm_subject::Failure;

/// Mass matrix of a bar, factorised once.
pub(super) enum BarMassMatrix {
    /// Diagonal of the lumped matrix.
    Lumped(Vec<f64>),
    /// Cholesky factor of the consistent matrix, which is banded and needs no reordering.
    Consistent(Box<CscCholesky<f64>>),
}

impl BarMassMatrix {
    pub(super) fn new(
        mass: Mass,
        mesh: &Mesh,
        density: f64,
        fixed: [bool; 2],
    ) -> Result<Self, Failure> {
        match mass {
            Mass::Lumped => Ok(Self::Lumped(lumped(mesh, density))),
            Mass::Consistent => {
                let matrix = CscMatrix::from(&held(&consistent(mesh, density), fixed));
                let factor = CscCholesky::factor(&matrix)
                    .map_err(|error| Failure::Solve(format!("mass matrix: {error}")))?;
                Ok(Self::Consistent(Box::new(factor)))
            }
        }
    }

    /// Converts forces to accelerations in place, without allocation. The force on a fixed node
    /// must be zero; the acceleration is then zero.
    pub(super) fn solve(&self, force: &mut [f64]) {
        match self {
            Self::Lumped(diagonal) => {
                for (force, mass) in force.iter_mut().zip(diagonal) {
                    *force /= mass;
                }
            }
            Self::Consistent(factor) => {
                let rows = force.len();
                factor.solve_mut(DMatrixViewMut::from_slice(force, rows, 1));
            }
        }
    }
}

/// Adds the reference length of each node, `int N_i dX` (m), to `lengths`.
pub(super) fn add_nodal_lengths(mesh: &Mesh, lengths: &mut [f64]) {
    for cell in 0..mesh.cells() {
        let shares = mesh.element().shares();
        for (length, share) in mesh.local_mut(cell, lengths).iter_mut().zip(shares) {
            *length += share * mesh.cell_length();
        }
    }
}

/// Returns the row sums of the consistent matrix (kg/m2).
pub(super) fn lumped(mesh: &Mesh, density: f64) -> Vec<f64> {
    let mut lengths = vec![0.0; mesh.node_count()];
    add_nodal_lengths(mesh, &mut lengths);
    lengths.into_iter().map(|length| density * length).collect()
}

/// Assembles the matrix `int rho0 N_i N_j dX` (kg/m2), element by element.
pub(super) fn consistent(mesh: &Mesh, density: f64) -> CooMatrix<f64> {
    let mut matrix = CooMatrix::new(mesh.node_count(), mesh.node_count());
    for cell in 0..mesh.cells() {
        let first = mesh.first_node(cell);
        for a in 0..mesh.element().nodes() {
            for b in 0..mesh.element().nodes() {
                matrix.push(first + a, first + b, density * product(mesh, a, b));
            }
        }
    }
    matrix
}

/// Integrates `N_a N_b` over one element (m).
fn product(mesh: &Mesh, a: usize, b: usize) -> f64 {
    mesh.points().iter().map(|point| point.weight * (point.shape[a] * point.shape[b])).sum()
}

/// Restricts the matrix to free nodes. The row and column of a fixed node become a row and column
/// of the identity matrix, so the matrix remains positive definite.
fn held(matrix: &CooMatrix<f64>, fixed: [bool; 2]) -> CooMatrix<f64> {
    let size = matrix.nrows();
    let is_fixed = |i: usize| (fixed[0] && i == 0) || (fixed[1] && i + 1 == size);
    let mut free = CooMatrix::new(size, size);
    for (i, j, &value) in matrix.triplet_iter() {
        if !is_fixed(i) && !is_fixed(j) {
            free.push(i, j, value);
        }
    }
    for i in [0, size - 1].into_iter().filter(|&i| is_fixed(i)) {
        free.push(i, i, 1.0);
    }
    free
}

//! The mass matrix, and accelerations from forces.

use nalgebra_sparse::CooMatrix;

use super::Mass;
use super::mesh::Mesh;
use crate::subject::Failure;

/// A mass matrix that is ready to be solved with, as often as there are steps.
pub(super) enum BarMassMatrix {
    /// The diagonal.
    Lumped(Vec<f64>),
    /// The factors of the matrix.
    Consistent(BandFactor),
}

impl BarMassMatrix {
    /// Assembles, and factorises if there is something to factorise.
    pub(super) fn new(
        mass: Mass,
        mesh: &Mesh,
        density: f64,
        fixed: [bool; 2],
    ) -> Result<Self, Failure> {
        match mass {
            Mass::Lumped => Ok(Self::Lumped(lumped(mesh, density))),
            Mass::Consistent => {
                let matrix = held(&consistent(mesh, density), fixed);
                let factor = BandFactor::new(&matrix, mesh.element().degree());
                let singular = "mass matrix: the matrix is not positive definite";
                factor.map(Self::Consistent).ok_or_else(|| Failure::Solve(singular.to_owned()))
            }
        }
    }

    /// Turns forces into accelerations, in place: neither branch allocates. The force on a fixed
    /// node has to be zero, and so its acceleration will be.
    pub(super) fn solve(&self, force: &mut [f64]) {
        match self {
            Self::Lumped(diagonal) => {
                for (force, mass) in force.iter_mut().zip(diagonal) {
                    *force /= mass;
                }
            }
            Self::Consistent(factor) => factor.solve(force),
        }
    }
}

/// Largest number of diagonals below that of a matrix.
const MOST_BELOW: usize = 2;

/// Factors `L D L^T` of a symmetric, positive definite band matrix (Golub & Van Loan, *Matrix
/// Computations*, 2013, section 4.3.6). L has a unit diagonal: only products and sums depend on the
/// row before, and all quotients are independent of each other.
pub(super) struct BandFactor {
    /// D.
    diagonal: Vec<f64>,
    /// The entries of each column of L below its diagonal.
    below: Vec<[f64; MOST_BELOW]>,
    /// Number of these entries that may differ from zero.
    width: usize,
}

impl BandFactor {
    /// Factorises a matrix with `width` diagonals below its own, from the entries of its lower
    /// half; entries of the same place are added. `None` if the matrix is not positive definite.
    pub(super) fn new(matrix: &CooMatrix<f64>, width: usize) -> Option<Self> {
        let size = matrix.nrows();
        let (mut diagonal, mut below) = (vec![0.0; size], vec![[0.0; MOST_BELOW]; size]);
        for (i, j, value) in matrix.triplet_iter().filter(|(i, j, _)| i >= j) {
            if i == j {
                diagonal[j] += value;
            } else {
                below[j][i - j - 1] += value;
            }
        }
        for j in 0..size {
            let pivot = diagonal[j];
            if !(pivot > 0.0) {
                return None;
            }
            let column = below[j];
            for (a, entry) in column.iter().enumerate().take(width.min(size - 1 - j)) {
                let factor = entry / pivot;
                diagonal[j + 1 + a] -= factor * entry;
                for b in a + 1..width {
                    below[j + 1 + a][b - a - 1] -= factor * column[b];
                }
                below[j][a] = factor;
            }
        }
        Some(Self { diagonal, below, width })
    }

    /// Replaces the right side by the solution.
    pub(super) fn solve(&self, side: &mut [f64]) {
        match self.width {
            1 => self.solve_band::<1>(side),
            _ => self.solve_band::<MOST_BELOW>(side),
        }
    }

    /// Solves with W entries below the diagonal of each column. The last W results are kept in
    /// registers: each row would otherwise wait for the store of the row before.
    fn solve_band<const W: usize>(&self, side: &mut [f64]) {
        // What the rows above subtract from the next W rows.
        let mut pending = [0.0; W];
        for (value, below) in side.iter_mut().zip(&self.below) {
            *value -= pending[0];
            for k in 0..W {
                let term = below[k] * *value;
                pending[k] = if k + 1 < W { pending[k + 1] + term } else { term };
            }
        }
        for (value, diagonal) in side.iter_mut().zip(&self.diagonal) {
            *value /= diagonal;
        }
        let mut later = [0.0; W];
        for (value, below) in side.iter_mut().zip(&self.below).rev() {
            for k in (0..W).rev() {
                *value -= below[k] * later[k];
            }
            for k in (1..W).rev() {
                later[k] = later[k - 1];
            }
            later[0] = *value;
        }
    }
}

/// Adds the reference length that belongs to each node, `int N_i dX` (m), to `lengths`.
pub(super) fn add_nodal_lengths(mesh: &Mesh, lengths: &mut [f64]) {
    for cell in 0..mesh.cells() {
        let shares = mesh.element().shares();
        for (length, share) in mesh.local_mut(cell, lengths).iter_mut().zip(shares) {
            *length += share * mesh.cell_length();
        }
    }
}

/// Sums of the rows of the consistent matrix (kg/m2).
pub(super) fn lumped(mesh: &Mesh, density: f64) -> Vec<f64> {
    let mut lengths = vec![0.0; mesh.node_count()];
    add_nodal_lengths(mesh, &mut lengths);
    lengths.into_iter().map(|length| density * length).collect()
}

/// `int rho0 N_i N_j dX` (kg/m2), element after element.
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

/// `int N_a N_b dX` over one element (m).
fn product(mesh: &Mesh, a: usize, b: usize) -> f64 {
    mesh.points().iter().map(|point| point.weight * (point.shape[a] * point.shape[b])).sum()
}

/// The matrix of the nodes that are free to move: the row and the column of a fixed node become
/// those of the identity, which keeps the numbering and leaves the matrix positive definite.
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

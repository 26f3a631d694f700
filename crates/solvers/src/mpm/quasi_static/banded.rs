//! Direct solution of a banded linear system: LU with partial pivoting (Golub & Van Loan, *Matrix
//! Computations*, 4th ed., 2013, section 4.3.5).
//!
//! The tangent of a quasi-static step may be indefinite, and is symmetric only for elastic and
//! associated laws, so Cholesky factorisation does not apply. The operations have a fixed order and
//! no fused products, so results are bit-identical on any machine.

/// A square matrix with `band` diagonals on either side of the main diagonal.
#[derive(Debug, Clone)]
pub(super) struct BandedSystem {
    rows: usize,
    band: usize,
    /// Columns `i - band ..= i + 2 band` of each row `i`; pivoting fills the last `band` columns.
    entries: Vec<f64>,
}

impl BandedSystem {
    pub(super) fn zeros(rows: usize, band: usize) -> Self {
        let band = band.min(rows.saturating_sub(1));
        Self { rows, band, entries: vec![0.0; rows * (3 * band + 1)] }
    }

    /// Returns the number of stored entries of a matrix of this size.
    pub(super) fn size(rows: usize, band: usize) -> usize {
        rows.saturating_mul(3 * band + 1)
    }

    #[inline]
    fn place(&self, i: usize, j: usize) -> usize {
        i * (3 * self.band + 1) + (j + self.band - i)
    }

    /// Adds `value` to the entry in row `i` and column `j`, which must be within the band.
    #[inline]
    pub(super) fn add(&mut self, i: usize, j: usize, value: f64) {
        let place = self.place(i, j);
        self.entries[place] += value;
    }

    /// Solves the system for the right-hand side `side`. If the matrix is singular or an entry is
    /// not finite, the error is the first row without a pivot in elimination order.
    pub(super) fn solve(mut self, mut side: Vec<f64>) -> Result<Vec<f64>, usize> {
        let Self { rows, band, .. } = self;
        for k in 0..rows {
            self.eliminate(k, (k + band).min(rows - 1), &mut side)?;
        }
        for k in (0..rows).rev() {
            let last = (k + 2 * band).min(rows - 1);
            let known: f64 = (k + 1..=last).map(|j| self.entries[self.place(k, j)] * side[j]).sum();
            side[k] = (side[k] - known) / self.entries[self.place(k, k)];
        }
        side.iter().all(|value| value.is_finite()).then_some(side).ok_or(0)
    }

    fn eliminate(&mut self, k: usize, last: usize, side: &mut [f64]) -> Result<(), usize> {
        let end = (k + 2 * self.band).min(self.rows - 1);
        let size = |matrix: &Self, i: usize| matrix.entries[matrix.place(i, k)].abs();
        let pivot =
            (k..=last).fold(k, |best, i| if size(self, i) > size(self, best) { i } else { best });
        if !(size(self, pivot) > 0.0 && size(self, pivot).is_finite()) {
            return Err(k);
        }
        if pivot != k {
            for j in k..=end {
                let (one, other) = (self.place(k, j), self.place(pivot, j));
                self.entries.swap(one, other);
            }
            side.swap(k, pivot);
        }
        let width = end - k;
        let top = self.place(k, k);
        for i in k + 1..=last {
            let row = self.place(i, k);
            let factor = self.entries[row] / self.entries[top];
            if factor == 0.0 {
                continue;
            }
            let (upper, lower) = self.entries.split_at_mut(row);
            for (value, above) in lower[1..=width].iter_mut().zip(&upper[top + 1..=top + width]) {
                *value -= factor * above;
            }
            side[i] -= factor * side[k];
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use rstest::rstest;

    /// Compares the solution for an indefinite unsymmetric matrix, whose pivots are off the
    /// diagonal, with the LU factorisation of a library.
    #[rstest]
    fn solution_agrees_with_a_dense_factorisation(
        #[values((1, 0), (7, 1), (9, 8), (40, 3), (41, 5))] (rows, band): (usize, usize),
    ) {
        let mut system = BandedSystem::zeros(rows, band);
        let mut dense = DMatrix::zeros(rows, rows);
        for i in 0..rows {
            for j in i.saturating_sub(band)..=(i + band).min(rows - 1) {
                let scale = if i == j && rows > 1 { 1e-3 } else { 1.0 };
                let value = scale * libm::sin(1.0 + 3.7 * i as f64 + 1.9 * j as f64);
                system.add(i, j, value);
                dense[(i, j)] = value;
            }
        }
        let side: Vec<f64> = (0..rows).map(|i| libm::cos(i as f64)).collect();
        let expected = dense.lu().solve(&DVector::from_vec(side.clone())).unwrap();
        let solution = system.solve(side).unwrap();
        for (value, expected) in solution.iter().zip(&expected) {
            assert!((value - expected).abs() <= 1e-9 * expected.abs().max(1.0), "{value}");
        }
    }

    #[test]
    fn singular_matrix_is_reported_with_its_row() {
        let mut system = BandedSystem::zeros(3, 1);
        for (i, j) in [(0, 0), (1, 1), (1, 2), (2, 1), (2, 2)] {
            system.add(i, j, 1.0);
        }
        assert_eq!(system.clone().solve(vec![1.0; 3]), Err(2));
        system.add(0, 0, f64::NAN);
        assert_eq!(system.solve(vec![1.0; 3]), Err(0));
    }
}

//! Computes the spectral radius of a matrix and the corresponding eigenvalue.

use nalgebra::DMatrix;
use nalgebra::linalg::Schur;

/// Maximum number of QR iterations.
const PATIENCE: usize = 1_000;

/// An entry below the diagonal counts as zero if it is less than this fraction of its diagonal
/// neighbours. Rounding errors would prevent convergence with a much smaller threshold.
const SMALL: f64 = 1e-13;

/// Number of times that the matrix is squared: powers up to 2^30.
const SQUARINGS: i32 = 30;

/// Largest modulus of the eigenvalues of a matrix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Radius {
    /// Modulus of the largest eigenvalue; infinite if an entry of the matrix is not finite.
    pub radius: f64,
    /// Real part and magnitude of the imaginary part of the largest eigenvalue, if computed.
    pub eigenvalue: Option<(f64, f64)>,
}

/// Computes the spectral radius from the real Schur form of `A + s I` with s = |A|. Without this
/// shift the QR algorithm does not converge for many amplification matrices: filters (PIC, MUSL)
/// have multiple zero eigenvalues with too few eigenvectors. If it does not converge even with the
/// shift, the radius is computed from Gelfand's formula, `|A^k|^(1/k)` with k = 2^30.
pub fn spectral_radius(matrix: &DMatrix<f64>) -> Radius {
    if !matrix.iter().all(|entry| entry.is_finite()) {
        return Radius { radius: f64::INFINITY, eigenvalue: None };
    }
    if matrix.is_empty() {
        return Radius { radius: 0.0, eigenvalue: None };
    }
    let shift = matrix.norm();
    let mut shifted = matrix.clone();
    (0..matrix.nrows()).for_each(|i| shifted[(i, i)] += shift);
    let Some(schur) = Schur::try_new(shifted, SMALL, PATIENCE) else {
        return Radius { radius: by_powers(matrix), eigenvalue: None };
    };
    let mut largest = Radius { radius: 0.0, eigenvalue: None };
    for eigenvalue in schur.complex_eigenvalues().iter() {
        let (re, im) = (eigenvalue.re - shift, eigenvalue.im.abs());
        let radius = libm::hypot(re, im);
        if !(radius <= largest.radius) {
            largest = Radius { radius, eigenvalue: Some((re, im)) };
        }
    }
    largest
}

/// Computes the spectral radius by repeated squaring. If the largest eigenvalue is defective of
/// multiplicity m, the error is (m - 1) ln(k)/k.
fn by_powers(matrix: &DMatrix<f64>) -> f64 {
    let (mut power, mut logarithm) = (matrix.clone(), 0.0);
    for k in 0..=SQUARINGS {
        let norm = power.norm();
        if !(norm > 0.0) {
            return norm;
        }
        logarithm += libm::log(norm) / libm::pow(2.0, f64::from(k));
        power /= norm;
        power = square(&power);
    }
    libm::exp(logarithm)
}

/// Squares the matrix by sums in column order. In the library, the order depends on the processor.
fn square(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let mut square = DMatrix::zeros(matrix.nrows(), matrix.ncols());
    let rows = matrix.nrows();
    let (from, into) = (matrix.as_slice(), square.as_mut_slice());
    for (into, factors) in into.chunks_exact_mut(rows).zip(from.chunks_exact(rows)) {
        for (column, factor) in from.chunks_exact(rows).zip(factors) {
            for i in 0..rows {
                into[i] += factor * column[i];
            }
        }
    }
    square
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;
    use rstest::rstest;

    fn two(entries: [f64; 4]) -> DMatrix<f64> {
        DMatrix::from_row_slice(2, 2, &entries)
    }

    #[rstest]
    #[case::growing([2.0, 1.0, 0.0, 0.5], (2.0, 0.0))]
    #[case::turning([0.6, -0.8, 0.8, 0.6], (0.6, 0.8))]
    #[case::alternating([0.5, 0.0, 0.0, -3.0], (-3.0, 0.0))]
    #[case::defective([1.0, 1.0, 0.0, 1.0], (1.0, 0.0))]
    #[case::nilpotent([0.0, 1.0, 0.0, 0.0], (0.0, 0.0))]
    fn radii(#[case] entries: [f64; 4], #[case] eigenvalue: (f64, f64)) {
        for scale in [1e-6, 1.0, 1e6] {
            let matrix = scale * two(entries);
            let radius = scale * libm::hypot(eigenvalue.0, eigenvalue.1);
            let found = spectral_radius(&matrix);
            assert_relative_eq!(found.radius, radius, epsilon = 1e-7 * scale);
            assert_relative_eq!(by_powers(&matrix), radius, epsilon = 1e-7 * scale);
            let (re, im) = found.eigenvalue.unwrap_or_default();
            assert_relative_eq!(re, scale * eigenvalue.0, epsilon = 1e-7 * scale);
            assert_relative_eq!(im, scale * eigenvalue.1, epsilon = 1e-7 * scale);
        }
    }

    #[test]
    fn nan_matrix_has_an_infinite_radius() {
        assert!(spectral_radius(&two([f64::NAN, 0.0, 0.0, 1.0])).radius.is_infinite());
    }

    /// The matrix is a cyclic shift, for which QR without exceptional shifts does not converge.
    #[test]
    fn a_shift_has_radius_one() {
        let shift = DMatrix::from_fn(7, 7, |i, j| f64::from(u8::from(i == (j + 1) % 7)));
        assert_relative_eq!(spectral_radius(&shift).radius, 1.0, max_relative = 1e-7);
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn schur_form_and_powers_agree(entries in prop::collection::vec(-2.0..2.0_f64, 25)) {
            let matrix = DMatrix::from_row_slice(5, 5, &entries);
            let (schur, powers) = (spectral_radius(&matrix).radius, by_powers(&matrix));
            prop_assert!((schur - powers).abs() <= 1e-6 * powers, "{schur} against {powers}");
        }
    }
}

//! Eigenvalues and axes of a small symmetric matrix by Jacobi's rotations.
//!
//! Golub & Van Loan, *Matrix Computations* (4th ed., 2013), section 8.5. Nothing but products,
//! quotients and square roots, in a fixed order: the same bits everywhere. Eigenvalues that
//! coincide are no special case, and those of a positive definite matrix are accurate relative to
//! their own size (Demmel & Veselic 1992), which the logarithm of a small one needs.

mod batch;

pub(super) use batch::{MatrixBatch, VectorBatch, assembled_batch, half_log_batch, spectral_batch};

use crate::mpm::foundation::algebra::{Matrix, Vector};

/// A few suffice, as each sweep squares what is left; NaN ends here.
const MOST_SWEEPS: usize = 12;

/// Eigenvalues of the symmetric matrix `m`, and their axes as columns: `m = A diag(values) A^T`.
pub(super) fn spectral<const D: usize>(m: &Matrix<D>) -> (Vector<D>, Matrix<D>) {
    let (mut m, mut axes) = (*m, Matrix::identity());
    for _ in 0..MOST_SWEEPS {
        let mut turned = false;
        for p in 0..D {
            for q in p + 1..D {
                turned |= rotate(&mut m, &mut axes, p, q);
            }
        }
        if !turned {
            break;
        }
    }
    (m.diagonal(), axes)
}

/// The symmetric matrix with these eigenvalues and axes.
pub(super) fn assembled<const D: usize>(values: &Vector<D>, axes: &Matrix<D>) -> Matrix<D> {
    axes * Matrix::from_diagonal(values) * axes.transpose()
}

/// Half the logarithm, eigenvalue by eigenvalue: the logarithmic strain for those of F F^T.
pub(super) fn half_log<const D: usize>(values: &Vector<D>) -> Vector<D> {
    values.map(|value| 0.5 * libm::log(value))
}

/// Turns the axes p and q until they no longer couple; false if they do not.
fn rotate<const D: usize>(m: &mut Matrix<D>, axes: &mut Matrix<D>, p: usize, q: usize) -> bool {
    let (low, high, coupling) = (m[(p, p)], m[(q, q)], m[(p, q)]);
    if coupling * coupling <= f64::EPSILON * f64::EPSILON * (low * high).abs() {
        return false;
    }
    let cotangent = (high - low) / (2.0 * coupling);
    let tangent =
        libm::copysign(1.0, cotangent) / (cotangent.abs() + (1.0 + cotangent * cotangent).sqrt());
    let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
    let mut turn = Matrix::<D>::identity();
    turn[(p, p)] = cosine;
    turn[(q, q)] = cosine;
    turn[(p, q)] = tangent * cosine;
    turn[(q, p)] = -tangent * cosine;
    *m = turn.transpose() * *m * turn;
    *axes *= turn;
    // What the products give up to rounding, without the cancellation.
    m[(p, p)] = low - tangent * coupling;
    m[(q, q)] = high + tangent * coupling;
    m[(p, q)] = 0.0;
    m[(q, p)] = 0.0;
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;
    use proptest::prelude::*;

    fn symmetric<const D: usize>(entries: &[f64]) -> Matrix<D> {
        let m = Matrix::<D>::from_fn(|i, j| entries[3 * i + j]);
        m + m.transpose()
    }

    fn hold<const D: usize>(m: &Matrix<D>) {
        let (values, axes) = spectral(m);
        let size = m.norm();
        assert_abs_diff_eq!(assembled(&values, &axes), *m, epsilon = 1e-14 * size);
        assert_abs_diff_eq!(axes.transpose() * axes, Matrix::identity(), epsilon = 1e-14);
    }

    proptest! {
        #[test]
        fn eigenvalues_and_axes_give_the_matrix_back(
            entries in proptest::array::uniform9(-1.0..1.0),
        ) {
            hold(&symmetric::<1>(&entries));
            hold(&symmetric::<2>(&entries));
            hold(&symmetric::<3>(&entries));
        }
    }

    /// Two and three that coincide, up to rounding or exactly, seen along oblique axes.
    #[test]
    fn eigenvalues_may_coincide() {
        let (_, axes) = spectral(&symmetric::<3>(&[0.3, 0.5, -0.2, 0.1, 0.4, 0.7, 0.9, 0.2, -0.6]));
        for values in [[2.0, 2.0, 2.0], [2.0, 2.0, 1.0], [2.0, 2.0 + 1e-15, 2.0 - 1e-9]] {
            let m = assembled(&Vector::<3>::from(values), &axes);
            hold(&m);
            let mut found: Vec<f64> = spectral(&m).0.iter().copied().collect();
            let mut wanted = values;
            found.sort_by(f64::total_cmp);
            wanted.sort_by(f64::total_cmp);
            for (found, wanted) in found.iter().zip(wanted) {
                assert_abs_diff_eq!(*found, wanted, epsilon = 4e-15);
            }
        }
    }

    /// The smallest eigenvalue of `[[1, s], [s, 2 s^2]]` is about s^2, far below the rounding of
    /// the largest: `(1 + 2 s^2 - sqrt(1 + 4 s^4))/2`.
    #[test]
    fn a_small_eigenvalue_is_accurate_relative_to_itself() {
        let s = 1e-9;
        let (values, _) = spectral(&Matrix::<2>::new(1.0, s, s, 2.0 * s * s));
        assert_abs_diff_eq!(values.min() / (s * s), 1.0, epsilon = 1e-14);
    }

    #[test]
    fn no_number_ends_the_sweeps_too() {
        assert!(spectral(&Matrix::<3>::from_element(f64::NAN)).0.iter().all(|v| v.is_nan()));
    }
}

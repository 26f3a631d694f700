//! Eigenvalues and axes of a small symmetric matrix by Jacobi rotations.
//!
//! Golub & Van Loan, *Matrix Computations* (4th ed., 2013), section 8.5. The algorithm uses only
//! products, quotients and square roots in a fixed order, so results are bit-identical everywhere.
//! Equal eigenvalues need no special treatment. All eigenvalues of a positive definite matrix have
//! a small relative error (Demmel & Veselic 1992), as required for the logarithm of a small
//! eigenvalue.
//!
//! The batch version applies the operations of [`spectral`] to all particles of a batch at once,
//! without branches, so the compiler vectorises the loops. A test checks that both versions give
//! identical bits.

use crate::mpm::foundation::algebra::{Matrix, Vector, identity, product, zeros};
use crate::mpm::foundation::simd::{BATCH, F64Batch, ln};

/// Maximum number of sweeps. Each sweep squares the off-diagonal entries, so a few sweeps suffice.
/// For NaN, the loop ends only at this maximum.
const MOST_SWEEPS: usize = 12;

/// Computes the eigenvalues of the symmetric matrix `m` and its axes as columns:
/// `m = A diag(values) A^T`.
pub(super) fn spectral<const D: usize>(m: &Matrix<D>) -> (Vector<D>, Matrix<D>) {
    let (mut m, mut axes) = (*m, identity());
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

/// Returns the symmetric matrix with these eigenvalues and axes.
pub(super) fn assembled<const D: usize>(values: &Vector<D>, axes: &Matrix<D>) -> Matrix<D> {
    Matrix::from_fn(|i, j| {
        let along = |k: usize| axes[(i, k)] * values[k] * axes[(j, k)];
        (1..D).fold(along(0), |sum, k| sum + along(k))
    })
}

/// Returns half the logarithm of each eigenvalue. For eigenvalues of F F^T this is the logarithmic
/// strain.
pub(super) fn half_log<const D: usize>(values: &Vector<D>) -> Vector<D> {
    values.map(|value| 0.5 * libm::log(value))
}

/// Rotates the axes p and q such that the entry (p, q) vanishes. Returns false if the entry is
/// already negligible.
fn rotate<const D: usize>(m: &mut Matrix<D>, axes: &mut Matrix<D>, p: usize, q: usize) -> bool {
    let (low, high, coupling) = (m[(p, p)], m[(q, q)], m[(p, q)]);
    if coupling * coupling <= f64::EPSILON * f64::EPSILON * (low * high).abs() {
        return false;
    }
    let cotangent = (high - low) / (2.0 * coupling);
    let tangent =
        libm::copysign(1.0, cotangent) / (cotangent.abs() + (1.0 + cotangent * cotangent).sqrt());
    let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
    let mut turn = identity::<D>();
    turn[(p, p)] = cosine;
    turn[(q, q)] = cosine;
    turn[(p, q)] = tangent * cosine;
    turn[(q, p)] = -tangent * cosine;
    *m = product(&product(&turn.transpose(), m), &turn);
    *axes = product(axes, &turn);
    // The diagonal entries are computed again, because the product above suffers from cancellation.
    m[(p, p)] = low - tangent * coupling;
    m[(q, q)] = high + tangent * coupling;
    m[(p, q)] = 0.0;
    m[(q, p)] = 0.0;
    true
}

/// One matrix per particle of a batch.
#[derive(Debug, Clone, Copy)]
pub(in crate::mpm::material) struct MatrixBatch<const D: usize>(
    pub(in crate::mpm::material) [[F64Batch; D]; D],
);

impl<const D: usize> MatrixBatch<D> {
    pub(in crate::mpm::material) const ZERO: Self = Self([[F64Batch::ZERO; D]; D]);

    #[inline(always)]
    pub(in crate::mpm::material) fn identity() -> Self {
        let mut all = Self::ZERO;
        for i in 0..D {
            all.0[i][i] = F64Batch([1.0; BATCH]);
        }
        all
    }

    /// Sets the leading block of the matrix of a lane.
    #[inline(always)]
    pub(in crate::mpm::material) fn set<const C: usize>(&mut self, lane: usize, m: &Matrix<C>) {
        for j in 0..C {
            for i in 0..C {
                self.0[i][j].0[lane % BATCH] = m[(i, j)];
            }
        }
    }

    /// Returns the leading block of the matrix of a lane.
    #[inline(always)]
    pub(in crate::mpm::material) fn get<const C: usize>(&self, lane: usize) -> Matrix<C> {
        let mut m = zeros();
        for j in 0..C {
            for i in 0..C {
                m[(i, j)] = self.0[i][j].get(lane);
            }
        }
        m
    }

    #[inline(always)]
    pub(in crate::mpm::material) fn minus_identity(&self) -> Self {
        let mut all = *self;
        for i in 0..D {
            for lane in 0..BATCH {
                all.0[i][i].0[lane] -= 1.0;
            }
        }
        all
    }

    #[inline(always)]
    pub(in crate::mpm::material) fn transpose(&self) -> Self {
        let mut all = *self;
        for j in 0..D {
            for i in 0..D {
                all.0[i][j] = self.0[j][i];
            }
        }
        all
    }

    #[inline(always)]
    pub(in crate::mpm::material) fn plus(mut self, other: &Self) -> Self {
        for j in 0..D {
            for i in 0..D {
                for lane in 0..BATCH {
                    self.0[i][j].0[lane] += other.0[i][j].0[lane];
                }
            }
        }
        self
    }

    #[inline(always)]
    pub(in crate::mpm::material) fn times(&self, other: &Self) -> Self {
        let mut all = Self::ZERO;
        for lane in 0..BATCH {
            all.set(lane, &product(&self.get::<D>(lane), &other.get(lane)));
        }
        all
    }
}

/// One vector per particle of a batch.
#[derive(Debug, Clone, Copy)]
pub(in crate::mpm::material) struct VectorBatch<const D: usize>(
    pub(in crate::mpm::material) [F64Batch; D],
);

impl<const D: usize> VectorBatch<D> {
    #[inline(always)]
    pub(in crate::mpm::material) fn get(&self, lane: usize) -> Vector<D> {
        let mut vector = zeros();
        for i in 0..D {
            vector[i] = self.0[i].get(lane);
        }
        vector
    }

    #[inline(always)]
    pub(in crate::mpm::material) fn map(mut self, f: impl Fn(&F64Batch) -> F64Batch) -> Self {
        for i in 0..D {
            self.0[i] = f(&self.0[i]);
        }
        self
    }
}

#[inline(always)]
pub(in crate::mpm::material) fn spectral_batch<const D: usize>(
    mut m: MatrixBatch<D>,
) -> (VectorBatch<D>, MatrixBatch<D>) {
    let mut axes = MatrixBatch::identity();
    for _ in 0..MOST_SWEEPS {
        let mut turned = false;
        for p in 0..D {
            for q in p + 1..D {
                turned |= rotate_batch(&mut m, &mut axes, p, q);
            }
        }
        if !turned {
            break;
        }
    }
    let mut values = [F64Batch::ZERO; D];
    for i in 0..D {
        values[i] = m.0[i][i];
    }
    (VectorBatch(values), axes)
}

#[inline(always)]
pub(in crate::mpm::material) fn half_log_batch(values: &F64Batch) -> F64Batch {
    let mut strains = ln(values);
    for lane in 0..BATCH {
        strains.0[lane] *= 0.5;
    }
    strains
}

#[inline(always)]
pub(in crate::mpm::material) fn assembled_batch<const D: usize>(
    values: &VectorBatch<D>,
    axes: &MatrixBatch<D>,
) -> MatrixBatch<D> {
    let mut all = MatrixBatch::identity();
    for j in 0..D {
        for i in 0..D {
            for lane in 0..BATCH {
                let along =
                    |k: usize| axes.0[i][k].0[lane] * values.0[k].0[lane] * axes.0[j][k].0[lane];
                let mut sum = along(0);
                for k in 1..D {
                    sum += along(k);
                }
                all.0[i][j].0[lane] = sum;
            }
        }
    }
    all
}

/// Rotates the axes p and q of each matrix such that the entry (p, q) vanishes. Returns whether any
/// matrix was rotated.
#[inline(always)]
fn rotate_batch<const D: usize>(
    m: &mut MatrixBatch<D>,
    axes: &mut MatrixBatch<D>,
    p: usize,
    q: usize,
) -> bool {
    let (mut cosine, mut sine) = (F64Batch::ZERO, F64Batch::ZERO);
    let mut turned = 0;
    for lane in 0..BATCH {
        let (low, high) = (m.0[p][p].0[lane], m.0[q][q].0[lane]);
        let coupling = m.0[p][q].0[lane];
        let settled = coupling * coupling <= f64::EPSILON * f64::EPSILON * (low * high).abs();
        let cotangent = (high - low) / (2.0 * coupling);
        let tangent =
            1.0_f64.copysign(cotangent) / (cotangent.abs() + (1.0 + cotangent * cotangent).sqrt());
        // A rotation by zero leaves all numbers bit-identical.
        let tangent = if settled { 0.0 } else { tangent };
        cosine.0[lane] = 1.0 / (1.0 + tangent * tangent).sqrt();
        sine.0[lane] = tangent * cosine.0[lane];
        let step = if settled { 0.0 } else { tangent * coupling };
        m.0[p][p].0[lane] = low - step;
        m.0[q][q].0[lane] = high + step;
        let rest = if settled { coupling } else { 0.0 };
        m.0[p][q].0[lane] = rest;
        m.0[q][p].0[lane] = rest;
        turned |= u64::from(!settled);
    }
    let turn = |one: &mut F64Batch, other: &mut F64Batch| {
        for lane in 0..BATCH {
            let (a, b) = (one.0[lane], other.0[lane]);
            one.0[lane] = cosine.0[lane] * a - sine.0[lane] * b;
            other.0[lane] = sine.0[lane] * a + cosine.0[lane] * b;
        }
    };
    for i in 0..D {
        let [row_p, row_q] = pair(&mut axes.0[i], p, q);
        turn(row_p, row_q);
        if i != p && i != q {
            let [row_p, row_q] = pair(&mut m.0[i], p, q);
            turn(row_p, row_q);
            let (head, tail) = m.0.split_at_mut(q);
            turn(&mut head[p][i], &mut tail[0][i]);
        }
    }
    turned != 0
}

/// Returns columns p and q of a row, with p < q.
#[inline(always)]
fn pair<const D: usize>(row: &mut [F64Batch; D], p: usize, q: usize) -> [&mut F64Batch; 2] {
    let (head, tail) = row.split_at_mut(q);
    [&mut head[p], &mut tail[0]]
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
        fn eigenvalues_and_axes_reproduce_the_matrix(
            entries in proptest::array::uniform9(-1.0..1.0),
        ) {
            hold(&symmetric::<1>(&entries));
            hold(&symmetric::<2>(&entries));
            hold(&symmetric::<3>(&entries));
        }
    }

    /// Tests two and three equal eigenvalues, up to rounding or exactly, with oblique axes.
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

    /// The smallest eigenvalue of `[[1, s], [s, 2 s^2]]`, `(1 + 2 s^2 - sqrt(1 + 4 s^4))/2`, is
    /// about s^2, far below the rounding error of the largest one.
    #[test]
    fn small_eigenvalue_has_a_small_relative_error() {
        let s = 1e-9;
        let (values, _) = spectral(&Matrix::<2>::new(1.0, s, s, 2.0 * s * s));
        assert_abs_diff_eq!(values.min() / (s * s), 1.0, epsilon = 1e-14);
    }

    /// Asserts that the results of a batch are bit-identical to the results of single particles.
    fn hold_batch<const D: usize>(given: &[Matrix<D>; BATCH]) {
        let mut m = MatrixBatch::<D>::identity();
        for (lane, given) in given.iter().enumerate() {
            m.set(lane, given);
        }
        let (values, axes) = spectral_batch(m);
        let again = assembled_batch(&values, &axes);
        for (lane, given) in given.iter().enumerate() {
            let (of_one, axes_of_one) = spectral(given);
            let together = assembled(&of_one, &axes_of_one);
            let alone = [of_one.as_slice(), axes_of_one.as_slice(), together.as_slice()].concat();
            let (values, axes) = (values.get(lane), axes.get::<D>(lane));
            let again = again.get::<D>(lane);
            let found = [values.as_slice(), axes.as_slice(), again.as_slice()].concat();
            let same = |(a, b): (&f64, &f64)| a == b || a.is_nan() && b.is_nan();
            assert!(alone.iter().zip(&found).all(same), "{given}: {alone:?}, {found:?}");
        }
    }

    fn gradients() -> impl Strategy<Value = [[f64; 9]; BATCH]> {
        proptest::array::uniform16(proptest::array::uniform9(-1.5..1.5))
    }

    proptest! {
        #[test]
        fn batch_is_bit_identical_to_single_particles(f in gradients()) {
            fn of<const D: usize>(f: &[[f64; 9]; BATCH]) {
                hold_batch(&f.map(|f| {
                    let f = Matrix::<D>::from_fn(|i, j| f[3 * i + j]);
                    f * f.transpose()
                }));
            }
            of::<1>(&f);
            of::<2>(&f);
            of::<3>(&f);
        }
    }

    /// Tests matrices that need no rotation, matrices with equal eigenvalues, and one that is not
    /// finite.
    #[test]
    fn batch_of_extremes_is_bit_identical_to_single_particles() {
        let shear = |s: f64| Matrix::<3>::new(1.0, s, 0.0, s, 1.0 + s * s, 0.0, 0.0, 0.0, 1.0);
        let mut all = [Matrix::identity(); BATCH];
        all[1] = shear(0.5);
        all[2] = shear(1e-9);
        all[3] = shear(1e-200);
        all[5] = Matrix::from_element(1.0);
        all[6] = Matrix::from_element(f64::NAN);
        all[7] = Matrix::zeros();
        all[11] = Matrix::from_diagonal(&Vector::<3>::new(3.0, 1e-30, 2.0));
        hold_batch(&all);
    }
}

//! Functions of a small matrix E by their power series, without eigenvalues.
//!
//! By the Cayley-Hamilton theorem, `E^3 = i1 E^2 - i2 E + i3 I` with the principal invariants of E
//! (Horn & Johnson, *Matrix Analysis*, 2nd ed. 2013, section 2.4.3). A power series is therefore
//! `a I + b E + c E^2`, and multiplication by E maps `(a, b, c)` to `(i3 c, a - i2 c, b + i1 c)`.
//! Horner's scheme applies this map and adds one coefficient per term. In one and two dimensions,
//! the equation holds with `i3 = 0`.
//!
//! The truncation error and the rounding error of `ln(I + E)` are both small relative to E, even
//! for strains far below the rounding error of 1. Each lane performs operations on its own numbers
//! only, so the result of a particle does not depend on the other particles of its batch.

use super::spectral::{MatrixBatch, VectorBatch, assembled_batch, half_log_batch, spectral_batch};
use crate::mpm::foundation::algebra::{Matrix, det};
use crate::mpm::foundation::simd::{BATCH, F64Batch, vectorized};

/// Square of the largest Frobenius norm of a small matrix, 1/8.
const SMALL_SQUARE: f64 = 1.0 / 64.0;

/// Number of coefficients of a series. Relative to E, the first omitted term of `ln(I + E)` is at
/// most `8^-17/18 = 2.5e-17`. The terms of the inverse root are smaller relative to 1.
const TERMS: usize = 18;

/// Square of the largest Frobenius norm of a tiny matrix, `2^-10`.
const TINY_SQUARE: f64 = 1.0 / 1_048_576.0;

/// Number of coefficients for a tiny matrix. Relative to E, the first omitted term of `ln(I + E)`
/// is at most `2^-60/7`.
const TINY_TERMS: usize = 7;

/// Coefficients of a power series, from the constant on.
pub(super) type Coefficients = [f64; TERMS];

/// Series of `ln(1 + x)/2`: the coefficients are `(-1)^(k + 1)/(2 k)`.
pub(super) const HALF_LOG: Coefficients = {
    let mut series = [0.0; TERMS];
    let mut k = 1;
    while k < TERMS {
        series[k] = if k % 2 == 1 { 0.5 } else { -0.5 } / k as f64;
        k += 1;
    }
    series
};

/// Series of `1/sqrt(1 + x)`: the coefficients have the ratios `-(2 k - 1)/(2 k)`.
const INVERSE_ROOT: Coefficients = {
    let mut series = [1.0; TERMS];
    let mut k = 1;
    while k < TERMS {
        series[k] = series[k - 1] * (1.0 - 2.0 * k as f64) / (2.0 * k as f64);
        k += 1;
    }
    series
};

/// Series of `1 + x - sqrt(1 + x)`: the coefficients of the root have the ratios
/// `-(2 k - 3)/(2 k)`.
const MINUS_ROOT: Coefficients = {
    let mut series = [-1.0; TERMS];
    let mut k = 1;
    while k < TERMS {
        series[k] = series[k - 1] * (3.0 - 2.0 * k as f64) / (2.0 * k as f64);
        k += 1;
    }
    series[0] += 1.0;
    series[1] += 1.0;
    series
};

/// A matrix E per particle of a batch, with its square and its principal invariants.
pub(super) struct PowerSeries<const D: usize> {
    e: MatrixBatch<D>,
    square: MatrixBatch<D>,
    invariants: [F64Batch; 3],
    norm_squared: F64Batch,
}

impl<const D: usize> PowerSeries<D> {
    #[inline(always)]
    pub(super) fn new(e: MatrixBatch<D>) -> Self {
        let (mut invariants, mut norm_squared) = ([F64Batch::ZERO; 3], F64Batch::ZERO);
        let square = e.times(&e);
        for lane in 0..BATCH {
            let (e, square) = (e.get::<D>(lane), square.get::<D>(lane));
            let (mut trace, mut trace_of_square, mut norm) = (0.0, 0.0, 0.0);
            for j in 0..D {
                trace += e[(j, j)];
                trace_of_square += square[(j, j)];
                for i in 0..D {
                    norm += e[(i, j)] * e[(i, j)];
                }
            }
            invariants[0].0[lane] = trace;
            invariants[1].0[lane] = 0.5 * (trace * trace - trace_of_square);
            invariants[2].0[lane] = if D == 3 { det(&e) } else { 0.0 };
            norm_squared.0[lane] = norm;
        }
        Self { e, square, invariants, norm_squared }
    }

    /// Whether the matrix of a lane is so small that its series have full accuracy; false for NaN.
    #[inline(always)]
    pub(super) fn is_small(&self, lane: usize) -> bool {
        self.norm_squared.get(lane) <= SMALL_SQUARE
    }

    #[inline(always)]
    pub(super) fn all_small(&self) -> bool {
        (0..BATCH).fold(true, |all, lane| all & self.is_small(lane))
    }

    /// Returns the sum of a series, valid for small matrices. The number of terms of a lane depends
    /// on its own matrix only.
    #[inline(always)]
    pub(super) fn sum(&self, series: &Coefficients) -> MatrixBatch<D> {
        let [i1, i2, i3] = &self.invariants;
        let [mut a, mut b, mut c] = [F64Batch::ZERO; 3];
        let mut takes_all = [0.0; BATCH];
        let mut terms = TINY_TERMS;
        for lane in 0..BATCH {
            if !(self.norm_squared.get(lane) <= TINY_SQUARE) {
                (takes_all[lane], terms) = (1.0, TERMS);
            }
        }
        for (k, coefficient) in series[..terms].iter().enumerate().rev() {
            for lane in 0..BATCH {
                let own = if k < TINY_TERMS { 1.0 } else { takes_all[lane] };
                let last = c.0[lane];
                c.0[lane] = b.0[lane] + i1.0[lane] * last;
                b.0[lane] = a.0[lane] - i2.0[lane] * last;
                a.0[lane] = coefficient * own + i3.0[lane] * last;
            }
        }
        let mut sum = MatrixBatch::identity();
        for j in 0..D {
            for i in 0..D {
                for lane in 0..BATCH {
                    let (e, square) = (self.e.0[i][j].0[lane], self.square.0[i][j].0[lane]);
                    let constant = if i == j { a.0[lane] } else { 0.0 };
                    sum.0[i][j].0[lane] = constant + (b.0[lane] * e + c.0[lane] * square);
                }
            }
        }
        sum
    }
}

/// Returns `W + W^T + H W` of each particle, which must be symmetric. With `W = H^T` this is
/// `(I + H)(I + H)^T - I`, without cancellation for small H.
#[inline(always)]
pub(super) fn excess<const D: usize>(h: &MatrixBatch<D>, w: &MatrixBatch<D>) -> MatrixBatch<D> {
    let mut all = h.times(w);
    for j in 0..D {
        for i in 0..=j {
            for lane in 0..BATCH {
                let first = w.0[i][j].0[lane] + w.0[j][i].0[lane];
                let entry = first + all.0[i][j].0[lane];
                (all.0[i][j].0[lane], all.0[j][i].0[lane]) = (entry, entry);
            }
        }
    }
    all
}

/// The squared left stretch `F F^T` of each particle of a batch. Its functions are evaluated by
/// power series for small strains, and by eigenvalues otherwise.
pub(super) struct SquaredStretch<const D: usize> {
    small: PowerSeries<D>,
    /// Eigenvalues and axes, if a matrix of the batch is not small.
    large: Option<(VectorBatch<D>, MatrixBatch<D>)>,
}

impl<const D: usize> SquaredStretch<D> {
    /// Computes the squared stretch of F, with `h = F - I`.
    #[inline(always)]
    pub(super) fn new(f: &MatrixBatch<D>, h: &MatrixBatch<D>) -> Self {
        let small = PowerSeries::new(excess(h, &h.transpose()));
        let large = if small.all_small() { None } else { Some(decomposed(f)) };
        Self { small, large }
    }

    /// Returns a function of the squared stretch, from its series in `F F^T - I` and from its
    /// values at the eigenvalues.
    #[inline(always)]
    fn function(
        &self,
        series: &Coefficients,
        of_squares: fn(&F64Batch) -> F64Batch,
    ) -> MatrixBatch<D> {
        let mut values = self.small.sum(series);
        if let Some((squares, axes)) = &self.large {
            let of_large = at_eigenvalues(squares, axes, of_squares);
            for j in 0..D {
                for i in 0..D {
                    for lane in 0..BATCH {
                        if !self.small.is_small(lane) {
                            values.0[i][j].0[lane] = of_large.0[i][j].0[lane];
                        }
                    }
                }
            }
        }
        values
    }

    #[inline(always)]
    pub(super) fn half_log(&self) -> MatrixBatch<D> {
        self.function(&HALF_LOG, half_log_batch)
    }

    #[inline(always)]
    pub(super) fn inverse_root(&self) -> MatrixBatch<D> {
        self.function(&INVERSE_ROOT, |squares| {
            F64Batch(squares.0.map(|square| 1.0 / square.sqrt()))
        })
    }

    /// Returns the squared stretch minus the stretch.
    #[inline(always)]
    pub(super) fn minus_root(&self) -> MatrixBatch<D> {
        self.function(&MINUS_ROOT, |squares| {
            F64Batch(squares.0.map(|square| square - square.sqrt()))
        })
    }
}

/// Computes eigenvalues and axes of `F F^T`. This function and [`at_eigenvalues`] are compiled once
/// per dimension, not once per law.
#[cold]
#[inline(never)]
fn decomposed<const D: usize>(f: &MatrixBatch<D>) -> (VectorBatch<D>, MatrixBatch<D>) {
    vectorized(
        #[inline(always)]
        || spectral_batch(f.times(&f.transpose())),
    )
}

/// Returns the matrices with the eigenvalues `of_squares(squares)` along `axes`.
#[cold]
#[inline(never)]
fn at_eigenvalues<const D: usize>(
    squares: &VectorBatch<D>,
    axes: &MatrixBatch<D>,
    of_squares: fn(&F64Batch) -> F64Batch,
) -> MatrixBatch<D> {
    vectorized(
        #[inline(always)]
        || assembled_batch(&squares.map(of_squares), axes),
    )
}

/// Decomposes the steps `I + grad v dt = v R` of a batch of particles. Returns the stresses
/// `R tau R^T` and the strains `ln v`.
pub(super) fn turned_by_steps<const C: usize, const D: usize>(
    grad_v: &[Matrix<C>],
    dt: f64,
    tau: &MatrixBatch<D>,
) -> (MatrixBatch<D>, MatrixBatch<D>) {
    let mut h = MatrixBatch::ZERO;
    for (lane, grad_v) in grad_v.iter().enumerate() {
        for j in 0..C {
            for i in 0..C {
                h.0[i][j].0[lane % BATCH] = grad_v[(i, j)] * dt;
            }
        }
    }
    turned(&h, tau)
}

/// Computes [`turned_by_steps`] for `h = grad v dt`. Compiled once for all dimensions of the body.
#[inline(never)]
fn turned<const D: usize>(
    h: &MatrixBatch<D>,
    tau: &MatrixBatch<D>,
) -> (MatrixBatch<D>, MatrixBatch<D>) {
    vectorized(
        #[inline(always)]
        || {
            let step = MatrixBatch::identity().plus(h);
            let squares = SquaredStretch::new(&step, h);
            let turn = squares.inverse_root().times(&step);
            (turn.times(tau).times(&turn.transpose()), squares.half_log())
        },
    )
}

#[cfg(test)]
mod tests {
    use super::super::specimen::scattered;
    use super::super::spectral::{assembled, half_log, spectral};
    use super::*;
    use crate::mpm::foundation::algebra::Vector;
    use approx::assert_abs_diff_eq;

    /// Returns the functions `ln(b)/2`, `b^-1/2` and `b - b^1/2` of the squared stretch `b`.
    fn functions<const D: usize>(h: &MatrixBatch<D>) -> [MatrixBatch<D>; 3] {
        let squares = SquaredStretch::new(&MatrixBatch::identity().plus(h), h);
        [squares.half_log(), squares.inverse_root(), squares.minus_root()]
    }

    /// Whether the series of `(I + H)(I + H)^T` are used.
    fn is_small<const D: usize>(h: &Matrix<D>) -> bool {
        let mut batch = MatrixBatch::<D>::ZERO;
        batch.set(3, h);
        PowerSeries::new(excess(&batch, &batch.transpose())).is_small(3)
    }

    /// Compares the functions of symmetric stretches with these principal strains, along oblique
    /// axes, with their closed forms. The errors are relative to the strain for functions that
    /// vanish without strain.
    fn hold<const D: usize>(strains: &Vector<D>) {
        let oblique = scattered::<D>(1.0, 0.7);
        let (_, axes) = spectral(&(oblique + oblique.transpose()));
        let of = |values: Vector<D>| assembled(&values, &axes);
        let h = of(strains.map(libm::expm1));
        let mut batch = MatrixBatch::<D>::ZERO;
        batch.set(3, &h);
        let [log, inverse, minus_root] = functions(&batch).map(|batch| batch.get::<D>(3));
        let size = if is_small(&h) { strains.norm() } else { 1.0 };
        let epsilon = 8.0 * f64::EPSILON;
        assert_abs_diff_eq!(log, of(*strains), epsilon = epsilon * size);
        assert_abs_diff_eq!(inverse, of(strains.map(|e| libm::exp(-e))), epsilon = epsilon);
        let expected = of(strains.map(|e| libm::exp(e) * libm::expm1(e)));
        assert_abs_diff_eq!(minus_root, expected, epsilon = epsilon * size);
    }

    #[test]
    fn functions_of_strained_matrices_have_their_closed_forms() {
        for size in [0.0, 1e-12, 1e-6, 1e-3, 0.02, 0.0525, 0.0527, 0.2] {
            hold(&(Vector::<3>::new(1.0, -0.5, 0.25) * size));
            hold(&(Vector::<3>::new(1.0, 1.0, -1.0) * size));
            hold(&(Vector::<2>::new(1.0, -0.5) * size));
            hold(&(Vector::<1>::new(-1.0) * size));
        }
    }

    /// The sizes meet the limit from both sides, so that the closed forms above cover it.
    #[test]
    fn limit_of_small_matrices_is_an_eighth() {
        let stretch = |size: f64| (Vector::<3>::new(1.0, -0.5, 0.25) * size).map(libm::expm1);
        assert!(is_small(&Matrix::from_diagonal(&stretch(0.0525))));
        assert!(!is_small(&Matrix::from_diagonal(&stretch(0.0527))));
        assert!(!is_small(&Matrix::<2>::from_element(f64::NAN)));
    }

    /// The logarithm of a matrix that is not symmetric, `ln(exp A) = A`, with a Taylor series of
    /// `exp A`.
    #[test]
    fn series_apply_to_matrices_without_symmetry() {
        let a = scattered::<3>(0.02, 1.9);
        let (mut power, mut excess) = (Matrix::identity(), Matrix::zeros());
        for k in 1..20 {
            power = power * a / f64::from(k);
            excess += power;
        }
        let mut batch = MatrixBatch::<3>::ZERO;
        batch.set(5, &excess);
        let small = PowerSeries::new(batch);
        assert!(small.is_small(5));
        let log = small.sum(&HALF_LOG).get::<3>(5) * 2.0;
        assert_abs_diff_eq!(log, a, epsilon = 4.0 * f64::EPSILON * a.norm());
    }

    #[test]
    fn large_strain_in_a_batch_changes_no_bit_of_other_particles() {
        fn of<const D: usize>() {
            let mut small = MatrixBatch::<D>::ZERO;
            for lane in 0..BATCH {
                small.set(lane, &scattered::<D>(0.02, lane as f64));
            }
            let mut mixed = small;
            mixed.set(6, &scattered::<D>(0.3, 0.1));
            mixed.set(9, &Matrix::<D>::from_element(f64::NAN));
            for (alone, mixed) in functions(&small).iter().zip(functions(&mixed)) {
                for lane in (0..BATCH).filter(|lane| ![6, 9].contains(lane)) {
                    assert_eq!(alone.get::<D>(lane), mixed.get::<D>(lane));
                }
                assert!(mixed.get::<D>(9).iter().all(|entry| entry.is_nan()));
            }
            let f = Matrix::identity() + scattered::<D>(0.3, 0.1);
            let (squares, axes) = spectral(&(f * f.transpose()));
            let expected = assembled(&half_log(&squares), &axes);
            let found = functions(&mixed)[0].get::<D>(6);
            assert_abs_diff_eq!(found, expected, epsilon = 4.0 * f64::EPSILON);
        }
        of::<1>();
        of::<2>();
        of::<3>();
    }
}

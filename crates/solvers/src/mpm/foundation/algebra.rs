//! Vectors and matrices in D dimensions.
//!
//! Unlike the functions of `nalgebra`, the determinant functions here need no trait bounds for
//! generic sizes.

use mpm_subject::with_dimension;

/// A vector in D dimensions.
pub type Vector<const D: usize> = nalgebra::SVector<f64, D>;

/// A D x D matrix.
pub type Matrix<const D: usize> = nalgebra::SMatrix<f64, D, D>;

/// Returns a matrix or a vector of zeros. The function of this name in `nalgebra` fills a matrix by
/// an iterator, which is not always inlined.
#[inline(always)]
pub(in crate::mpm) fn zeros<const R: usize, const C: usize>() -> nalgebra::SMatrix<f64, R, C> {
    [[0.0; R]; C].into()
}

/// Returns the identity matrix; inlined for the same reason as [`zeros`].
#[inline(always)]
pub(in crate::mpm) fn identity<const D: usize>() -> Matrix<D> {
    let mut identity = zeros();
    for axis in 0..D {
        identity[(axis, axis)] = 1.0;
    }
    identity
}

/// Computes the determinant by expansion; D = 1, 2 or 3.
///
/// # Panics
/// For any other D.
#[inline(always)]
pub fn det<const D: usize>(m: &Matrix<D>) -> f64 {
    let minor = |i: usize, j: usize| m[(1, i)] * m[(2, j)] - m[(1, j)] * m[(2, i)];
    match D {
        1 => m[(0, 0)],
        2 => m[(0, 0)] * m[(1, 1)] - m[(0, 1)] * m[(1, 0)],
        3 => m[(0, 0)] * minor(1, 2) - m[(0, 1)] * minor(0, 2) + m[(0, 2)] * minor(0, 1),
        _ => unreachable!("1, 2 or 3 dimensions"),
    }
}

/// Computes the determinant of a tensor in `d` dimensions, given row by row; d = 1, 2 or 3.
pub fn det_of_rows(d: usize, rows: &[f64]) -> f64 {
    with_dimension!(d, D => det(&Matrix::<D>::from_row_slice(rows)))
}

/// Computes the matrix of cofactors, `det(m) m^-T`; D = 1, 2 or 3.
///
/// # Panics
/// For any other D.
#[inline]
pub fn cofactor<const D: usize>(m: &Matrix<D>) -> Matrix<D> {
    Matrix::from_fn(|i, j| match D {
        1 => 1.0,
        2 if i == j => m[(1 - i, 1 - j)],
        2 => -m[(1 - i, 1 - j)],
        3 => {
            // The next two indices in the cycle 0, 1, 2, so that no sign factor is needed.
            let ((i1, j1), (i2, j2)) = (((i + 1) % 3, (j + 1) % 3), ((i + 2) % 3, (j + 2) % 3));
            m[(i1, j1)] * m[(i2, j2)] - m[(i1, j2)] * m[(i2, j1)]
        }
        _ => unreachable!("1, 2 or 3 dimensions"),
    })
}

/// Computes the inverse; `None` if the determinant is zero. The numbers equal those of
/// `try_inverse` of `nalgebra`, which takes longer to compile, because each instance contains the
/// algorithms for larger matrices.
///
/// # Panics
/// For D other than 1, 2 or 3.
#[inline]
pub fn inverse<const D: usize>(m: &Matrix<D>) -> Option<Matrix<D>> {
    let determinant = det(m);
    if determinant == 0.0 {
        return None;
    }
    let cofactor = cofactor(m);
    Some(Matrix::from_fn(|i, j| cofactor[(j, i)] / determinant))
}

/// Computes `a b`. Always inlined, because the particle loops that call this function are compiled
/// for wider registers, and because `nalgebra` calls a function for each column.
#[inline(always)]
pub(in crate::mpm) fn product<const D: usize>(a: &Matrix<D>, b: &Matrix<D>) -> Matrix<D> {
    let mut product = zeros();
    for j in 0..D {
        for i in 0..D {
            let mut sum = a[(i, 0)] * b[(0, j)];
            for k in 1..D {
                sum += a[(i, k)] * b[(k, j)];
            }
            product[(i, j)] = sum;
        }
    }
    product
}

/// Computes `a v`; inlined for the same reason as [`product`].
#[inline(always)]
pub(in crate::mpm) fn times<const D: usize>(a: &Matrix<D>, v: &Vector<D>) -> Vector<D> {
    let mut times = zeros();
    for i in 0..D {
        let mut sum = a[(i, 0)] * v[0];
        for k in 1..D {
            sum += a[(i, k)] * v[k];
        }
        times[i] = sum;
    }
    times
}

/// Computes the dyad a b^T.
#[inline]
pub fn dyad<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> Matrix<D> {
    Matrix::from_fn(|i, j| a[i] * b[j])
}

/// Extends a tensor to three dimensions, with the component `beyond` along each missing axis.
#[inline]
pub(in crate::mpm) fn in_space<const D: usize>(m: &Matrix<D>, beyond: f64) -> Matrix<3> {
    Matrix::from_fn(|i, k| match (i < D && k < D, i == k) {
        (true, _) => m[(i, k)],
        (false, true) => beyond,
        (false, false) => 0.0,
    })
}

/// Returns the components of a 3-D tensor along the axes of a body in `D` dimensions.
#[inline]
pub(in crate::mpm) fn in_body<const D: usize>(m: &Matrix<3>) -> Matrix<D> {
    Matrix::from_fn(|i, k| m[(i, k)])
}

/// Returns `[f(0), f(1), ...]`; `nothing` is the initial value of each entry. The hot loop needs
/// this function, because `std::array::from_fn` is not always inlined.
#[inline(always)]
pub(in crate::mpm) fn array<const N: usize, T: Copy>(
    nothing: T,
    mut f: impl FnMut(usize) -> T,
) -> [T; N] {
    let mut array = [nothing; N];
    let mut k = 0;
    // This loop compiles faster than one over a range, and the function has 1,700 instances.
    while k < N {
        array[k] = f(k);
        k += 1;
    }
    array
}

/// Calls `f` for the entries of `a` and `b` in pairs, up to the end of the shorter slice. The loops
/// over particles and nodes need this function, because `Iterator::zip` is not always inlined.
#[inline(always)]
pub(in crate::mpm) fn pairs<A, B>(a: &mut [A], b: &[B], mut f: impl FnMut(&mut A, &B)) {
    let count = a.len().min(b.len());
    let (a, b) = (&mut a[..count], &b[..count]);
    for k in 0..count {
        f(&mut a[k], &b[k]);
    }
}

/// 2^52. All `f64` x from 2^52 to 2^53 are integers, and their last bits hold the integer x - 2^52.
pub(in crate::mpm) const WHOLE: f64 = 4_503_599_627_370_496.0;

/// Rounds down; equals `libm::floor` from -2^51 to 2^51. In the hot loop, a call of `libm::floor`
/// would cost more than all other operations, and a conversion to integers and back as much as the
/// evaluation of the weights.
#[inline(always)]
pub(in crate::mpm) fn floor(x: f64) -> f64 {
    const SHIFT: f64 = 1.5 * WHOLE;
    let nearest = (x + SHIFT) - SHIFT;
    nearest - if nearest > x { 1.0 } else { 0.0 }
}

/// Converts the integral number `x`, from 0 to 2^32, to an integer.
#[inline(always)]
pub(in crate::mpm) fn whole(x: f64) -> usize {
    ((x + WHOLE).to_bits() & 0xffff_ffff) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn determinant_and_inverse_equal_those_of_the_library(
            entries in proptest::array::uniform9(-1.0..1.0_f64),
            is_singular in any::<bool>(),
        ) {
            fn holds<const D: usize>(entries: &[f64], is_singular: bool) {
                let mut m = Matrix::<D>::from_column_slice(&entries[..D * D]);
                if is_singular {
                    m.set_column(0, &Vector::zeros());
                }
                let dense = nalgebra::DMatrix::from_column_slice(D, D, m.as_slice());
                assert_relative_eq!(det(&m), dense.determinant(), epsilon = 1e-14);
                assert_eq!(inverse(&m), m.try_inverse());
                assert_eq!(inverse(&m).is_none(), is_singular);
            }
            holds::<1>(&entries, is_singular);
            holds::<2>(&entries, is_singular);
            holds::<3>(&entries, is_singular);
        }

        #[test]
        fn products_equal_those_of_the_library(
            a in proptest::array::uniform9(-1.0..1.0_f64),
            b in proptest::array::uniform9(-1.0..1.0_f64),
        ) {
            fn holds<const D: usize>(a: &[f64], b: &[f64]) {
                let square = |of: &[f64]| Matrix::<D>::from_column_slice(&of[..D * D]);
                let vector = |of: &[f64]| Vector::<D>::from_column_slice(&of[..D]);
                assert_eq!(product(&square(a), &square(b)), square(a) * square(b));
                assert_eq!(times(&square(a), &vector(b)), square(a) * vector(b));
                assert_eq!(dyad(&vector(a), &vector(b)), vector(a) * vector(b).transpose());
            }
            holds::<1>(&a, &b);
            holds::<2>(&a, &b);
            holds::<3>(&a, &b);
        }

        #[test]
        fn inline_floor_equals_the_library_function(x in -1e9..1e9_f64) {
            for x in [x, libm::floor(x), libm::round(x) + 0.5, 1e-9 * x] {
                prop_assert_eq!(floor(x), libm::floor(x));
            }
            prop_assert_eq!(whole(libm::fabs(libm::floor(x))) as f64, libm::fabs(libm::floor(x)));
        }
    }
}

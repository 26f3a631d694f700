//! Matrices of particles as columns in registers.

use super::batch::Batch;
use crate::mpm::basis::{Basis, PatchBatch};
use crate::mpm::foundation::algebra::{Matrix, array};
use crate::mpm::foundation::moments::InertiaTensor;
use crate::mpm::foundation::simd::{LANES, Simd};

/// Columns of a matrix, each in a register from lane `from` on.
#[inline(always)]
pub(super) fn columns<S: Simd, const D: usize>(
    simd: S,
    matrix: &Matrix<D>,
    from: usize,
) -> [S::F64x4; D] {
    array(simd.load([0.0; 4]), |axis| {
        let mut lanes = [0.0; 4];
        for row in 0..D {
            lanes[(from + row) % LANES] = matrix[(row, axis)];
        }
        simd.load(lanes)
    })
}

/// Writes a matrix by its columns from lane `from` on, number by number: store-to-load forwarding
/// fails for a matrix that is stored as a whole.
#[inline(always)]
pub(super) fn put_columns<const D: usize, F: Into<[f64; 4]> + Copy>(
    matrix: &mut Matrix<D>,
    columns: &[F; D],
    from: usize,
) {
    for axis in 0..D {
        let lanes = columns[axis].into();
        for row in 0..D {
            matrix[(row, axis)] = lanes[(from + row) % LANES];
        }
    }
}

/// Columns of `matrix D_p^-1`, each in a register from lane `from` on, with the inertia tensor of
/// all patches of the particle, or without it that of its only patch.
#[inline(always)]
pub(super) fn divide<B: Basis, S: Simd, const D: usize>(
    (simd, patches, lane): (S, &Batch<B, D>, usize),
    of_all: Option<&InertiaTensor<D>>,
    (matrix, from): (&[S::F64x4; D], usize),
    h: f64,
) -> [S::F64x4; D] {
    let Some(of_all) = of_all else { return patches.divide::<S>(lane, matrix) };
    let mut whole = Matrix::zeros();
    put_columns(&mut whole, matrix, from);
    columns(simd, &of_all.divide(&whole, h), from)
}

//! Sums of G2P over the nodes of a patch, factorised by axes: a node costs a product and a sum for
//! each function, not for each axis.

use super::product_batch::ProductBatch;
use super::weights_1d_batch::of;
use crate::mpm::foundation::algebra::array;
use crate::mpm::foundation::packed_grid::{FieldView, Node4};
use crate::mpm::foundation::simd::{Register, Simd};

/// `sum_k row_k factors_k`.
#[inline(always)]
fn dot<S: Simd, const K: usize>(simd: S, row: &[Node4], factors: &[f64; K]) -> S::F64x4 {
    let mut sum = simd.load(row[0].0) * factors[0];
    for k in 1..K {
        sum = sum.plus_product(simd.load(row[k].0), factors[k]);
    }
    sum
}

/// Adds term `k` of a sum, which begins with term 0.
#[inline(always)]
fn put<F: Register>(sum: &mut F, k: usize, a: F, b: f64) {
    *sum = if k == 0 { a * b } else { sum.plus_product(a, b) };
}

impl<const D: usize, const K: usize, const OUTWARD: usize> ProductBatch<D, K, OUTWARD> {
    /// `sum_i field_i N_i`, and for each axis the same with its functions replaced by `others`.
    #[inline(always)]
    pub(super) fn sums<S: Simd>(
        &self,
        simd: S,
        lane: usize,
        field: &FieldView<'_>,
        others: &[[f64; K]; D],
    ) -> (S::F64x4, [S::F64x4; D]) {
        let (start, weights) = (self.start(lane), of(&self.axes[0].weight, lane));
        let zero = simd.splat(0.0);
        let (mut sum, mut other) = (zero, [zero; D]);
        for k in 0..Self::PLANES {
            let (mut plane, mut across, mut along) = (zero, zero, zero);
            for j in 0..Self::ROWS {
                let row = field.row::<K>(start + field.layout.row(j, k));
                let (terms, others_of_row) = (dot(simd, row, &weights), dot(simd, row, &others[0]));
                if D == 1 {
                    return (terms, [others_of_row; D]);
                }
                let weight = self.weight(lane, 1, j);
                put(&mut plane, j, terms, weight);
                put(&mut across, j, others_of_row, weight);
                put(&mut along, j, terms, others[1][j]);
            }
            if D == 2 {
                return (plane, array(zero, |axis| if axis == 0 { across } else { along }));
            }
            let weight = self.weight(lane, 2, k);
            put(&mut sum, k, plane, weight);
            put(&mut other[0], k, across, weight);
            if D > 2 {
                put(&mut other[1], k, along, weight);
                put(&mut other[2], k, plane, others[2][k]);
            }
        }
        (sum, other)
    }
}

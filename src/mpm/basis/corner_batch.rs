//! Several corners of domains: hats whose gradients are in proportion to their weights.

use super::{node_accumulator::NodeAccumulator, patch::PatchBatch, product_batch::ProductBatch};
use crate::mpm::{
    algebra::{Vector, array},
    packed_grid::{FieldView, FieldViewMut},
    simd::{BATCH, Simd},
};
use std::ops::Range;

/// Several corners of [CPDI](super::Cpdi)'s domains.
#[derive(Debug)]
pub struct Corners<const D: usize> {
    pub(in crate::mpm) hats: ProductBatch<D, 2>,
    /// What makes a gradient of a weight (1/m).
    pub(in crate::mpm) outward: [Vector<D>; BATCH],
}

impl<const D: usize> PatchBatch<D> for Corners<D> {
    type NodeAccumulator<'a, S: Simd> = NodeAccumulator<'a, S, 2>;

    fn none() -> Self {
        Self { hats: ProductBatch::none(), outward: [Vector::zeros(); BATCH] }
    }

    #[inline(always)]
    fn compute_row_weights<S: Simd>(&mut self, simd: S, lanes: &Range<usize>) {
        self.hats.compute_row_weights(simd, lanes);
    }

    #[inline(always)]
    fn compute_offsets<S: Simd>(
        &mut self,
        simd: S,
        lanes: &Range<usize>,
        h: f64,
        mean: Option<&Vector<D>>,
    ) {
        self.hats.compute_offsets(simd, lanes, h, mean);
    }

    #[inline(always)]
    fn divide<S: Simd>(&self, lane: usize, columns: &[S::F64x4; D]) -> [S::F64x4; D] {
        self.hats.divide::<S>(lane, columns)
    }

    #[inline(always)]
    fn accumulator<S: Simd>(simd: S, field: FieldViewMut<'_>) -> Self::NodeAccumulator<'_, S> {
        ProductBatch::<D, 2>::accumulator(simd, field)
    }

    #[inline(always)]
    fn flush<S: Simd>(accumulator: Self::NodeAccumulator<'_, S>) {
        ProductBatch::<D, 2>::flush(accumulator);
    }

    #[inline(always)]
    fn scatter<S: Simd>(
        &self,
        lane: usize,
        value: S::F64x4,
        accumulator: &mut Self::NodeAccumulator<'_, S>,
    ) {
        self.hats.scatter(lane, value, accumulator);
    }

    #[inline(always)]
    fn scatter_affine<S: Simd>(
        &self,
        lane: usize,
        value_and_slope: (S::F64x4, &[S::F64x4; D]),
        accumulator: &mut Self::NodeAccumulator<'_, S>,
    ) {
        self.hats.scatter_affine(lane, value_and_slope, accumulator);
    }

    #[inline(always)]
    fn scatter_flux<S: Simd>(
        &self,
        lane: usize,
        flux: &[S::F64x4; D],
        accumulator: &mut Self::NodeAccumulator<'_, S>,
    ) {
        let outward = &self.outward[lane % BATCH];
        let mut value = flux[0] * outward[0];
        for axis in 1..D {
            value += flux[axis] * outward[axis];
        }
        self.hats.scatter(lane, value, accumulator);
    }

    #[inline(always)]
    fn scatter_all<S: Simd>(
        &self,
        lane: usize,
        (value, slope): (S::F64x4, Option<S::F64x4>),
        flux: S::F64x4,
        accumulator: &mut Self::NodeAccumulator<'_, S>,
    ) {
        let value = value + flux * self.outward[lane % BATCH][0];
        match slope {
            None => self.hats.scatter(lane, value, accumulator),
            Some(slope) => self.hats.scatter_affine(lane, (value, &[slope; D]), accumulator),
        }
    }

    #[inline(always)]
    fn gather<S: Simd>(&self, simd: S, lane: usize, field: &FieldView<'_>) -> S::F64x4 {
        self.hats.gather(simd, lane, field)
    }

    #[inline(always)]
    fn gather_moment<S: Simd>(
        &self,
        simd: S,
        lane: usize,
        field: &FieldView<'_>,
    ) -> (S::F64x4, [S::F64x4; D]) {
        self.hats.gather_moment(simd, lane, field)
    }

    #[inline(always)]
    fn gather_gradient<S: Simd>(
        &self,
        simd: S,
        lane: usize,
        field: &FieldView<'_>,
    ) -> (S::F64x4, [S::F64x4; D]) {
        let (sum, outward) = (self.hats.gather(simd, lane, field), &self.outward[lane % BATCH]);
        (sum, array(sum, |axis| sum * outward[axis]))
    }
}

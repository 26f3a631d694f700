//! Several products of functions along the axes, and the loops over their nodes.
//!
//! The weights along each axis are computed once for a particle. Sums over the K^D nodes are sums
//! axis by axis, so that a node costs a product and a sum for each function, not one for each axis.

use super::{
    node_accumulator::NodeAccumulator, patch::PatchBatch, weights_1d_batch::Weights1dBatch,
};
use crate::mpm::{
    algebra::{Vector, array},
    packed_grid::{FieldView, FieldViewMut},
    simd::{BATCH, F64Batch, LANES, Simd, registers_of},
};
use std::ops::Range;

/// Several [`Product`](super::Product)s.
#[derive(Debug)]
pub struct ProductBatch<const D: usize, const K: usize> {
    /// Where the first node of each is in a packed field.
    pub(in crate::mpm) start: [u32; BATCH],
    /// The functions along each axis.
    pub(in crate::mpm) axes: [Weights1dBatch<K>; D],
    /// Weights of the rows of a plane times those of the planes.
    row_weights: [[F64Batch; K]; K],
}

/// Functions `k` of patch `lane`.
#[inline(always)]
pub(in crate::mpm) fn of<const K: usize>(functions: &[F64Batch; K], lane: usize) -> [f64; K] {
    array(0.0, |k| functions[k].get(lane))
}

impl<const D: usize, const K: usize> ProductBatch<D, K> {
    /// Rows of a plane, and planes: one where there is no such axis.
    pub(in crate::mpm) const ROWS: usize = if D > 1 { K } else { 1 };
    pub(in crate::mpm) const PLANES: usize = if D > 2 { K } else { 1 };

    /// Puts the starts of four.
    #[inline(always)]
    pub(in crate::mpm) fn put_starts(&mut self, lane: usize, starts: [u32; LANES]) {
        self.start[lane % BATCH / LANES * LANES..][..LANES].copy_from_slice(&starts);
    }

    #[inline(always)]
    pub(in crate::mpm) fn start(&self, lane: usize) -> usize {
        self.start[lane % BATCH] as usize
    }

    /// Weight of function `k` along `axis`, one where there is no such axis.
    #[inline(always)]
    pub(in crate::mpm) fn weight(&self, lane: usize, axis: usize, k: usize) -> f64 {
        if axis < D { self.axes[axis].weight[k].get(lane) } else { 1.0 }
    }

    /// Weight of row `j` in plane `k`.
    #[inline(always)]
    fn row_weight(&self, lane: usize, j: usize, k: usize) -> f64 {
        if D > 2 { self.row_weights[k][j].get(lane) } else { self.weight(lane, 1, j) }
    }
}

impl<const D: usize, const K: usize> PatchBatch<D> for ProductBatch<D, K> {
    type NodeAccumulator<'a, S: Simd> = NodeAccumulator<'a, S, K>;

    fn none() -> Self {
        Self {
            start: [0; BATCH],
            axes: [Weights1dBatch::NONE; D],
            row_weights: [[F64Batch::ZERO; K]; K],
        }
    }

    #[inline(always)]
    fn compute_row_weights<S: Simd>(&mut self, simd: S, lanes: &Range<usize>) {
        if D > 2 {
            for register in registers_of(lanes) {
                for k in 0..K {
                    let plane = self.axes[2].weight[k].load(simd, register);
                    for j in 0..K {
                        let row = self.axes[1].weight[j].load(simd, register);
                        self.row_weights[k][j].store(register, row * plane);
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn compute_offsets<S: Simd>(
        &mut self,
        simd: S,
        lanes: &Range<usize>,
        h: f64,
        mean: Option<&Vector<D>>,
    ) {
        for register in registers_of(lanes) {
            for axis in 0..D {
                self.axes[axis].center_offsets(simd, register, h, mean.map(|mean| mean[axis]));
            }
        }
    }

    #[inline(always)]
    fn divide<S: Simd>(&self, lane: usize, columns: &[S::F64x4; D]) -> [S::F64x4; D] {
        array(columns[0], |axis| columns[axis] * self.axes[axis].inverse.get(lane))
    }

    #[inline(always)]
    fn accumulator<S: Simd>(simd: S, field: FieldViewMut<'_>) -> Self::NodeAccumulator<'_, S> {
        NodeAccumulator::new(simd, field)
    }

    #[inline(always)]
    fn flush<S: Simd>(mut accumulator: Self::NodeAccumulator<'_, S>) {
        accumulator.flush();
    }

    #[inline(always)]
    fn scatter<S: Simd>(
        &self,
        lane: usize,
        value: S::F64x4,
        accumulator: &mut Self::NodeAccumulator<'_, S>,
    ) {
        let (start, weights) = (self.start(lane), of(&self.axes[0].weight, lane));
        if D == 1 {
            return accumulator.add_in_registers(start, array(value, |i| value * weights[i]));
        }
        for k in 0..Self::PLANES {
            for j in 0..Self::ROWS {
                let term = value * self.row_weight(lane, j, k);
                accumulator.add(
                    start,
                    (j, k),
                    #[inline(always)]
                    |i| term * weights[i],
                );
            }
        }
    }

    #[inline(always)]
    fn scatter_affine<S: Simd>(
        &self,
        lane: usize,
        (value, slope): (S::F64x4, &[S::F64x4; D]),
        accumulator: &mut Self::NodeAccumulator<'_, S>,
    ) {
        let (start, x) = (self.start(lane), &self.axes[0]);
        let (weights, lever) = (of(&x.weight, lane), |axis: usize, k: usize| {
            slope[axis] * self.axes[axis].offset_from_mean[k].get(lane)
        });
        let growth: [_; K] = array(slope[0], |i| slope[0] * x.weighted_offset[i].get(lane));
        if D == 1 {
            return accumulator
                .add_in_registers(start, array(value, |i| value * weights[i] + growth[i]));
        }
        let rise: [_; K] = array(slope[0], |j| lever(1, j));
        for k in 0..Self::PLANES {
            let value = if D > 2 { value + lever(2, k) } else { value };
            for j in 0..Self::ROWS {
                let value = value + rise[j];
                let weight = self.row_weight(lane, j, k);
                let term = value * weight;
                accumulator.add(
                    start,
                    (j, k),
                    #[inline(always)]
                    |i| term * weights[i] + growth[i] * weight,
                );
            }
        }
    }

    #[inline(always)]
    fn scatter_flux<S: Simd>(
        &self,
        lane: usize,
        flux: &[S::F64x4; D],
        accumulator: &mut Self::NodeAccumulator<'_, S>,
    ) {
        let (start, x) = (self.start(lane), &self.axes[0]);
        let (weights, slopes) = (of(&x.weight, lane), of(&x.slope, lane));
        let along: [_; K] = array(flux[0], |i| flux[0] * slopes[i]);
        if D == 1 {
            return accumulator.add_in_registers(start, along);
        }
        for k in 0..Self::PLANES {
            for j in 0..Self::ROWS {
                let weight = self.row_weight(lane, j, k);
                let slope = self.axes[1].slope[j].get(lane);
                let mut across = flux[1] * (slope * self.weight(lane, 2, k));
                if D > 2 {
                    let slope = self.axes[2].slope[k].get(lane);
                    across += flux[2] * (slope * self.weight(lane, 1, j));
                }
                accumulator.add(
                    start,
                    (j, k),
                    #[inline(always)]
                    |i| along[i] * weight + across * weights[i],
                );
            }
        }
    }

    #[inline(always)]
    fn scatter_all<S: Simd>(
        &self,
        lane: usize,
        (value, slope): (S::F64x4, Option<S::F64x4>),
        flux: S::F64x4,
        accumulator: &mut Self::NodeAccumulator<'_, S>,
    ) {
        let x = &self.axes[0];
        let terms = array(value, |i| {
            let term = value * x.weight[i].get(lane);
            let term = slope.map_or(term, |slope| term + slope * x.weighted_offset[i].get(lane));
            term + flux * x.slope[i].get(lane)
        });
        accumulator.add_in_registers(self.start(lane), terms);
    }

    #[inline(always)]
    fn gather<S: Simd>(&self, simd: S, lane: usize, field: &FieldView<'_>) -> S::F64x4 {
        self.sum(simd, lane, field)
    }

    #[inline(always)]
    fn gather_moment<S: Simd>(
        &self,
        simd: S,
        lane: usize,
        field: &FieldView<'_>,
    ) -> (S::F64x4, [S::F64x4; D]) {
        self.sums(
            simd,
            lane,
            field,
            &array([0.0; K], |axis| of(&self.axes[axis].weighted_offset, lane)),
        )
    }

    #[inline(always)]
    fn gather_gradient<S: Simd>(
        &self,
        simd: S,
        lane: usize,
        field: &FieldView<'_>,
    ) -> (S::F64x4, [S::F64x4; D]) {
        self.sums(simd, lane, field, &array([0.0; K], |axis| of(&self.axes[axis].slope, lane)))
    }
}

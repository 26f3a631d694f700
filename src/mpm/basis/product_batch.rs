//! Batch of tensor-product patches, and the loop of P2G over their nodes.

use super::node_accumulator::NodeAccumulator;
use super::patch::{NodeTerm, PatchBatch};
use super::weights_1d_batch::{Weights1dBatch, of};
use crate::mpm::algebra::{Vector, array};
use crate::mpm::packed_grid::{FieldView, FieldViewMut};
use crate::mpm::simd::{BATCH, F64Batch, F64x4, LANES, Simd, registers_of};
use std::ops::Range;

/// Batch of [`Product`](super::Product)s. With `OUTWARD = 1` the gradient of a function is its
/// weight times a vector of the patch, as for the corners of [CPDI](super::Cpdi); with 0 it is the
/// derivative.
#[derive(Debug)]
pub struct ProductBatch<const D: usize, const K: usize, const OUTWARD: usize = 0> {
    /// Index of the first node of each patch in a packed field.
    pub(in crate::mpm) start: [u32; BATCH],
    /// Functions along each axis.
    pub(in crate::mpm) axes: [Weights1dBatch<K>; D],
    /// Vectors that turn weights into gradients (1/m).
    pub(in crate::mpm) outward: [[Vector<D>; BATCH]; OUTWARD],
    /// Weights of the rows of a plane times those of the planes.
    row_weights: [[F64Batch; K]; K],
}

impl<const D: usize, const K: usize, const OUTWARD: usize> ProductBatch<D, K, OUTWARD> {
    /// Rows of a plane, and planes: one where there is no such axis.
    pub(in crate::mpm) const ROWS: usize = if D > 1 { K } else { 1 };
    pub(in crate::mpm) const PLANES: usize = if D > 2 { K } else { 1 };

    /// Stores the starts of four patches.
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

    /// `flux . grad` of row `j` in plane `k` without the factor of the first axis.
    #[inline(always)]
    fn flux_across<F: F64x4>(&self, lane: usize, flux: &[F; D], j: usize, k: usize) -> F {
        let slope = self.axes[1].slope[j].get(lane);
        let mut across = flux[1] * (slope * self.weight(lane, 2, k));
        if D > 2 {
            let slope = self.axes[2].slope[k].get(lane);
            across = across.plus_product(flux[2], slope * self.weight(lane, 1, j));
        }
        across
    }

    /// The flux as a part of the value, where gradients are weights times a vector.
    #[inline(always)]
    fn fold_flux<F: F64x4>(&self, lane: usize, term: NodeTerm<F, D>) -> NodeTerm<F, D> {
        let (Some(outward), Some(flux)) = (self.outward.first(), term.flux) else { return term };
        let outward = &outward[lane % BATCH];
        let mut value = flux[0] * outward[0];
        for axis in 1..D {
            value += flux[axis] * outward[axis];
        }
        if let Some(own) = term.value {
            value = own + value;
        }
        NodeTerm { value: Some(value), flux: None, ..term }
    }

    /// Adds the term of particle `lane` to its nodes: row after row, each part factorised by axes,
    /// so that a node costs a product and a sum for each part, not for each axis.
    #[inline(always)]
    fn add<S: Simd>(
        &self,
        lane: usize,
        term: NodeTerm<S::F64x4, D>,
        accumulator: &mut NodeAccumulator<'_, S, K>,
    ) {
        let NodeTerm { value, slope, flux } = self.fold_flux(lane, term);
        let (start, x, zero) = (self.start(lane), &self.axes[0], accumulator.simd.splat(0.0));
        let weights = of(&x.weight, lane);
        // The parts along the first axis are the same for all rows.
        let (mut growth, mut rise, mut along) = (None, None, None);
        if let Some(slope) = &slope {
            growth = Some(array::<K, _>(zero, |i| slope[0] * x.weighted_offset[i].get(lane)));
            if D > 1 {
                let y = &self.axes[1];
                rise = Some(array::<K, _>(zero, |j| slope[1] * y.offset_from_mean[j].get(lane)));
            }
        }
        if let Some(flux) = &flux {
            along = Some(array::<K, _>(zero, |i| flux[0] * x.slope[i].get(lane)));
        }
        for k in 0..Self::PLANES {
            let mut of_plane = value;
            if D > 2
                && let (Some(value), Some(slope)) = (value, &slope)
            {
                let offset = self.axes[2].offset_from_mean[k].get(lane);
                of_plane = Some(value.plus_product(slope[2], offset));
            }
            for j in 0..Self::ROWS {
                let weight = self.row_weight(lane, j, k);
                let (mut of_row, mut across) = (of_plane, None);
                if let (Some(value), Some(rise)) = (of_plane, &rise) {
                    of_row = Some(value + rise[j]);
                }
                if let (true, Some(value)) = (D > 1, of_row) {
                    of_row = Some(value * weight);
                }
                if let (true, Some(flux)) = (D > 1, &flux) {
                    across = Some(self.flux_across(lane, flux, j, k));
                }
                accumulator.add::<D>(
                    start,
                    (j, k),
                    #[inline(always)]
                    |i, node| {
                        // Along one axis a sum waits for that of the particle before: it takes
                        // one addition, and the terms are made beside it.
                        let mut sum = if D > 1 { node } else { zero };
                        if let Some(value) = of_row {
                            sum = sum.plus_product(value, weights[i]);
                        }
                        if let Some(growth) = &growth {
                            sum = sum.plus_product(growth[i], weight);
                        }
                        if let Some(along) = &along {
                            sum = sum.plus_product(along[i], weight);
                        }
                        if let Some(across) = across {
                            sum = sum.plus_product(across, weights[i]);
                        }
                        if D > 1 { sum } else { node + sum }
                    },
                );
            }
        }
    }
}

impl<const D: usize, const K: usize, const OUTWARD: usize> PatchBatch<D>
    for ProductBatch<D, K, OUTWARD>
{
    fn none() -> Self {
        Self {
            start: [0; BATCH],
            axes: [Weights1dBatch::NONE; D],
            outward: [[Vector::zeros(); BATCH]; OUTWARD],
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
    fn scatter<S: Simd, T>(
        &self,
        simd: S,
        field: FieldViewMut<'_>,
        particles: impl Iterator<Item = (usize, T)>,
        term: impl Fn(usize, T) -> NodeTerm<S::F64x4, D>,
    ) {
        let mut accumulator = NodeAccumulator::new(simd, field);
        for (lane, particle) in particles {
            self.add(lane, term(lane, particle), &mut accumulator);
        }
        accumulator.flush();
    }

    #[inline(always)]
    fn gather<S: Simd>(&self, simd: S, lane: usize, field: &FieldView<'_>) -> S::F64x4 {
        self.sums(simd, lane, field, &[[0.0; K]; D]).0
    }

    #[inline(always)]
    fn gather_moment<S: Simd>(
        &self,
        simd: S,
        lane: usize,
        field: &FieldView<'_>,
    ) -> (S::F64x4, [S::F64x4; D]) {
        let axis = |axis: usize| of(&self.axes[axis].weighted_offset, lane);
        self.sums(simd, lane, field, &array([0.0; K], axis))
    }

    #[inline(always)]
    fn gather_gradient<S: Simd>(
        &self,
        simd: S,
        lane: usize,
        field: &FieldView<'_>,
    ) -> (S::F64x4, [S::F64x4; D]) {
        if let Some(outward) = self.outward.first() {
            let (sum, outward) = (self.gather(simd, lane, field), &outward[lane % BATCH]);
            return (sum, array(sum, |axis| sum * outward[axis]));
        }
        let axis = |axis: usize| of(&self.axes[axis].slope, lane);
        self.sums(simd, lane, field, &array([0.0; K], axis))
    }
}

//! Patches of a batch of particles, with the P2G and G2P loops over their nodes.
//!
//! G2P sums are computed axis by axis, so the work per node does not depend on the number of axes.

use super::shape::PatchShape;
use super::weights_1d::{MOST, Weights1dBatch, lane_functions};
use crate::mpm::foundation::algebra::{Vector, array, zeros};
use crate::mpm::foundation::packed_grid::{FieldView, FieldViewMut, Node4, PackedNode};
use crate::mpm::foundation::simd::{BATCH, F64Batch, LANES, Register, Simd, registers_of};
use std::ops::Range;

/// Contribution of a particle to each of its nodes, for all components of a node at once:
/// `(value + sum_a slope_a (x_i - x_p - mean)_a) N_i + sum_a flux_a dN_i/dx_a`. Absent terms have
/// no cost.
#[derive(Debug, Clone, Copy)]
pub struct NodeTerm<F, const D: usize> {
    /// Constant part.
    pub value: Option<F>,
    /// Affine part. Requires a value, which may be zero.
    pub slope: Option<[F; D]>,
    /// Part along the gradient.
    pub flux: Option<[F; D]>,
}

impl<F: Register, const D: usize> NodeTerm<F, D> {
    pub(in crate::mpm) const NONE: Self = Self { value: None, slope: None, flux: None };
}

/// Patches of a batch of particles, as [products](super::Product). Weights are computed for four
/// particles at once. The loops over nodes process one patch after another, with four components of
/// a node at once.
#[derive(Debug)]
pub struct ProductBatch<const D: usize, W> {
    shape: W,
    /// Index of the first node of each patch in a packed field.
    pub(in crate::mpm) start: [u32; BATCH],
    pub(in crate::mpm) axes: [Weights1dBatch; D],
    /// Vectors that convert weights to gradients (1/m), if the shape is outward.
    pub(in crate::mpm) outward: [Vector<D>; BATCH],
    /// Product of row weight and plane weight, for each row.
    row_weights: [[F64Batch; MOST]; MOST],
}

#[inline(always)]
fn plus_product<F: Register>(sum: Option<F>, a: F, b: f64) -> F {
    match sum {
        Some(sum) => sum.plus_product(a, b),
        None => a * b,
    }
}

impl<const D: usize, W: PatchShape> ProductBatch<D, W> {
    /// Returns the number of rows in a plane; one in 1-D.
    #[inline(always)]
    fn rows(&self) -> usize {
        if D > 1 { self.shape.functions() } else { 1 }
    }

    #[inline(always)]
    fn planes(&self) -> usize {
        if D > 2 { self.shape.functions() } else { 1 }
    }

    #[inline(always)]
    pub(in crate::mpm) fn put_starts(&mut self, lane: usize, starts: [u32; LANES]) {
        if let Some(four) = self.start[lane % BATCH / LANES * LANES..].first_chunk_mut() {
            *four = starts;
        }
    }

    #[inline(always)]
    pub(in crate::mpm) fn start(&self, lane: usize) -> usize {
        self.start[lane % BATCH] as usize
    }

    /// Returns the weight of function `k` along `axis`; one if `axis` is not less than D.
    #[inline(always)]
    pub(in crate::mpm) fn weight(&self, lane: usize, axis: usize, k: usize) -> f64 {
        if axis < D { self.axes[axis].weight[k].get(lane) } else { 1.0 }
    }

    #[inline(always)]
    fn row_weight(&self, lane: usize, j: usize, k: usize) -> f64 {
        if D > 2 { self.row_weights[k][j].get(lane) } else { self.weight(lane, 1, j) }
    }

    #[inline(always)]
    fn flux_across<F: Register>(
        &self,
        lane: usize,
        sum: Option<F>,
        flux: &[F; D],
        j: usize,
        k: usize,
    ) -> F {
        let along = self.axes[1].slope[j].get(lane) * self.weight(lane, 2, k);
        let sum = plus_product(sum, flux[1], along);
        if D == 2 {
            return sum;
        }
        sum.plus_product(flux[2], self.axes[2].slope[k].get(lane) * self.weight(lane, 1, j))
    }

    /// For patches whose gradients are weights times a vector, converts the flux to a part of the
    /// value.
    #[inline(always)]
    fn fold_flux<F: Register>(&self, lane: usize, term: NodeTerm<F, D>) -> NodeTerm<F, D> {
        let (true, Some(flux)) = (self.shape.is_outward(), term.flux) else { return term };
        let outward = &self.outward[lane % BATCH];
        let mut value = flux[0] * outward[0];
        for axis in 1..D {
            value += flux[axis] * outward[axis];
        }
        if let Some(own) = term.value {
            value = own + value;
        }
        NodeTerm { value: Some(value), flux: None, ..term }
    }

    /// Adds the term of particle `lane` to its nodes. Node (i, j, k) receives
    /// `first_i weight_jk + row_jk weight_i`. This requires two products and two sums for any
    /// number of axes.
    #[inline(always)]
    fn add<S: Simd, N: PackedNode>(
        &self,
        lane: usize,
        term: NodeTerm<N::Lanes<S>, D>,
        accumulator: &mut NodeAccumulator<'_, S, N, W>,
    ) {
        let NodeTerm { value, slope, flux } = self.fold_flux(lane, term);
        let (start, x, weights) =
            (self.start(lane), &self.axes[0], lane_functions(&self.axes[0].weight, lane));
        // Loops are used, because closures are not always inlined.
        let (mut first, mut rise) = ([None; MOST], [None; MOST]);
        for i in 0..self.shape.functions() {
            if let Some(slope) = &slope {
                first[i] = Some(slope[0] * x.weighted_offset[i].get(lane));
                if D > 1 {
                    rise[i] = Some(slope[1] * self.axes[1].offset_from_mean[i].get(lane));
                }
            }
            if let Some(flux) = &flux {
                first[i] = Some(plus_product(first[i], flux[0], x.slope[i].get(lane)));
            }
        }
        for k in 0..self.planes() {
            let mut of_plane = value;
            if D > 2
                && let (Some(value), Some(slope)) = (value, &slope)
            {
                let offset = self.axes[2].offset_from_mean[k].get(lane);
                of_plane = Some(value.plus_product(slope[2], offset));
            }
            for j in 0..self.rows() {
                let (weight, mut of_row) = (self.row_weight(lane, j, k), of_plane);
                if let (Some(value), Some(rise)) = (of_plane, rise[j]) {
                    of_row = Some(value + rise);
                }
                if let (true, Some(value)) = (D > 1, of_row) {
                    of_row = Some(value * weight);
                }
                if let (true, Some(flux)) = (D > 1, &flux) {
                    of_row = Some(self.flux_across(lane, of_row, flux, j, k));
                }
                accumulator.add::<D>(
                    start,
                    j,
                    k,
                    #[inline(always)]
                    |i, node| {
                        let Some(first) = first[i] else {
                            return match of_row {
                                // In 1-D each sum depends on the sum of the previous particle. A
                                // separate product shortens this chain.
                                Some(row) if D == 1 => node + row * weights[i],
                                Some(row) => node.plus_product(row, weights[i]),
                                None => node,
                            };
                        };
                        match of_row {
                            Some(row) if D == 1 => node + (row * weights[i] + first),
                            Some(row) => {
                                node.plus_product(first, weight).plus_product(row, weights[i])
                            }
                            None => node + first * weight,
                        }
                    },
                );
            }
        }
    }
}

impl<const D: usize, W: PatchShape> ProductBatch<D, W> {
    /// Creates an empty batch.
    #[inline]
    pub(in crate::mpm) fn new(shape: W) -> Self {
        Self {
            shape,
            start: [0; BATCH],
            axes: [Weights1dBatch::NONE; D],
            outward: [zeros(); BATCH],
            row_weights: [[F64Batch::ZERO; MOST]; MOST],
        }
    }

    /// Computes the products of weights that [`scatter`](Self::scatter) needs.
    #[inline(always)]
    pub(in crate::mpm) fn compute_row_weights<S: Simd>(&mut self, simd: S, lanes: &Range<usize>) {
        if D > 2 {
            for register in registers_of(lanes) {
                for k in 0..self.shape.functions() {
                    let plane = self.axes[2].weight[k].load(simd, register);
                    for j in 0..self.shape.functions() {
                        let row = self.axes[1].weight[j].load(simd, register);
                        self.row_weights[k][j].store(register, row * plane);
                    }
                }
            }
        }
    }

    /// Computes offsets `x_i - x_p - mean` (m) and the inverse of the inertia tensor (1/m^2), for
    /// cells of size `h` (m). Without `mean`, the mean over the nodes of each patch is used. This
    /// is valid only for particles with a single patch.
    #[inline(always)]
    pub(in crate::mpm) fn compute_offsets<S: Simd>(
        &mut self,
        simd: S,
        lanes: &Range<usize>,
        h: f64,
        mean: Option<&Vector<D>>,
    ) {
        for register in registers_of(lanes) {
            for axis in 0..D {
                let (functions, mean) = (self.shape.functions(), mean.map(|mean| mean[axis]));
                self.axes[axis].center_offsets(simd, register, functions, h, mean);
            }
        }
    }

    /// Multiplies the matrix with these columns by the inverse inertia tensor of patch `lane`.
    #[inline(always)]
    pub(in crate::mpm) fn divide<S: Simd>(
        &self,
        lane: usize,
        columns: &[S::F64x4; D],
    ) -> [S::F64x4; D] {
        array(columns[0], |axis| columns[axis] * self.axes[axis].inverse.get(lane))
    }

    /// Adds the term of the particle in each of the `lanes` to its nodes in `field`.
    #[inline(always)]
    pub(in crate::mpm) fn scatter<S: Simd, N: PackedNode>(
        &self,
        simd: S,
        field: FieldViewMut<'_, N>,
        lanes: Range<usize>,
        term: impl Fn(usize) -> NodeTerm<N::Lanes<S>, D>,
    ) {
        let mut accumulator = NodeAccumulator::new(simd, self.shape, field);
        for lane in lanes {
            self.add(lane, term(lane), &mut accumulator);
        }
        accumulator.flush();
    }

    /// Returns `sum_i field_i N_i`.
    #[inline(always)]
    pub(in crate::mpm) fn gather<S: Simd>(
        &self,
        simd: S,
        lane: usize,
        field: &FieldView<'_>,
    ) -> S::F64x4 {
        self.sums(simd, lane, field, &[[0.0; MOST]; D]).0
    }

    /// Returns `sum_i field_i N_i`, and the moments `sum_i field_i (x_i - x_p - mean)_a N_i` for
    /// each axis.
    #[inline(always)]
    pub(in crate::mpm) fn gather_moment<S: Simd>(
        &self,
        simd: S,
        lane: usize,
        field: &FieldView<'_>,
    ) -> (S::F64x4, [S::F64x4; D]) {
        let axis = |axis: usize| lane_functions(&self.axes[axis].weighted_offset, lane);
        self.sums(simd, lane, field, &array([0.0; MOST], axis))
    }

    /// Returns `sum_i field_i N_i`, and the gradient `sum_i field_i dN_i/dx_a` for each axis.
    #[inline(always)]
    pub(in crate::mpm) fn gather_gradient<S: Simd>(
        &self,
        simd: S,
        lane: usize,
        field: &FieldView<'_>,
    ) -> (S::F64x4, [S::F64x4; D]) {
        if self.shape.is_outward() {
            let (sum, outward) = (self.gather(simd, lane, field), &self.outward[lane % BATCH]);
            return (sum, array(sum, |axis| sum * outward[axis]));
        }
        let axis = |axis: usize| lane_functions(&self.axes[axis].slope, lane);
        self.sums(simd, lane, field, &array([0.0; MOST], axis))
    }
}

#[inline(always)]
fn dot<S: Simd>(simd: S, row: &[Node4], factors: &[f64; MOST]) -> S::F64x4 {
    let mut sum = simd.load(row[0].0) * factors[0];
    for k in 1..row.len() {
        sum = sum.plus_product(simd.load(row[k].0), factors[k]);
    }
    sum
}

#[inline(always)]
fn put<F: Register>(sum: &mut F, k: usize, a: F, b: f64) {
    *sum = if k == 0 { a * b } else { sum.plus_product(a, b) };
}

impl<const D: usize, W: PatchShape> ProductBatch<D, W> {
    /// Returns `sum_i field_i N_i`, and for each axis the same sum with the functions of `others`
    /// along this axis.
    #[inline(always)]
    pub(super) fn sums<S: Simd>(
        &self,
        simd: S,
        lane: usize,
        field: &FieldView<'_>,
        others: &[[f64; MOST]; D],
    ) -> (S::F64x4, [S::F64x4; D]) {
        let (start, weights) = (self.start(lane), lane_functions(&self.axes[0].weight, lane));
        let zero = simd.splat(0.0);
        let (mut sum, mut other) = (zero, [zero; D]);
        for k in 0..self.planes() {
            let (mut plane, mut across, mut along) = (zero, zero, zero);
            for j in 0..self.rows() {
                let row = field.row(start + field.layout.row(j, k), self.shape.functions());
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

/// Field that receives the sums of P2G. In 1-D, the sums of a patch of nodes stay in registers.
#[derive(Debug)]
pub(super) struct NodeAccumulator<'a, S: Simd, N: PackedNode, W> {
    pub(in crate::mpm) simd: S,
    shape: W,
    pub(in crate::mpm) field: FieldViewMut<'a, N>,
    /// First node whose sums are in registers; [`NONE`] if there are no such sums.
    start: usize,
    sums: [N::Lanes<S>; MOST],
}

const NONE: usize = usize::MAX;

impl<'a, S: Simd, N: PackedNode, W: PatchShape> NodeAccumulator<'a, S, N, W> {
    #[inline(always)]
    pub(in crate::mpm) fn new(simd: S, shape: W, field: FieldViewMut<'a, N>) -> Self {
        Self { simd, shape, field, start: NONE, sums: [N::zero(simd); MOST] }
    }

    /// Adds a term to every node of row `j` in plane `k` of the box of nodes that starts at
    /// `start`: node i of the row becomes `with_term(i, node)`. Call [`flush`](Self::flush) after
    /// the last addition.
    #[inline(always)]
    pub(in crate::mpm) fn add<const D: usize>(
        &mut self,
        start: usize,
        j: usize,
        k: usize,
        with_term: impl Fn(usize, N::Lanes<S>) -> N::Lanes<S>,
    ) {
        if D == 1 {
            return self.add_in_registers(start, with_term);
        }
        let row = self.field.row(start + self.field.layout.row(j, k), self.shape.functions());
        for (i, node) in row.iter_mut().enumerate() {
            node.store::<S>(with_term(i, node.load(self.simd)));
        }
    }

    #[inline(always)]
    fn add_in_registers(
        &mut self,
        start: usize,
        with_term: impl Fn(usize, N::Lanes<S>) -> N::Lanes<S>,
    ) {
        if start != self.start {
            self.flush();
            let row = self.field.row(start, self.shape.functions());
            for i in 0..self.shape.functions() {
                self.sums[i] = row[i].load(self.simd);
            }
            self.start = start;
        }
        for i in 0..self.shape.functions() {
            self.sums[i] = with_term(i, self.sums[i]);
        }
    }

    #[inline(always)]
    pub(in crate::mpm) fn flush(&mut self) {
        if self.start != NONE {
            let row = self.field.row(self.start, self.shape.functions());
            for i in 0..self.shape.functions() {
                row[i].store::<S>(self.sums[i]);
            }
            self.start = NONE;
        }
    }
}

//! Several products of functions along the axes, and the loops over their nodes.
//!
//! The weights along each axis are computed once for a particle. Sums over the K^D nodes are taken
//! axis by axis, so that a node costs a product and a sum for each function, not one for each axis.

use super::{
    node_accumulator::NodeAccumulator, patch::PatchBatch, weights_1d_batch::Weights1dBatch,
};
use crate::mpm::{
    algebra::{Vector, array},
    packed_grid::{View, ViewMut},
    simd::{FOUR, LANES, Lanes, Width, parts},
};
use std::ops::Range;

/// Several [`Product`](super::Product)s.
#[derive(Debug)]
pub struct Products<const D: usize, const K: usize> {
    /// Where the first node of each is in a packed field.
    pub(in crate::mpm) start: [u32; LANES],
    /// The functions along each axis.
    pub(in crate::mpm) axes: [Weights1dBatch<K>; D],
    /// Weights of the rows of a plane times those of the planes.
    across: [[Lanes; K]; K],
}

/// Functions `k` of patch `lane`.
#[inline(always)]
pub(in crate::mpm) fn of<const K: usize>(functions: &[Lanes; K], lane: usize) -> [f64; K] {
    array(0.0, |k| functions[k].get(lane))
}

impl<const D: usize, const K: usize> Products<D, K> {
    /// Rows of a plane, and planes: one where there is no such axis.
    pub(in crate::mpm) const ROWS: usize = if D > 1 { K } else { 1 };
    pub(in crate::mpm) const PLANES: usize = if D > 2 { K } else { 1 };

    /// Puts the starts of four.
    #[inline(always)]
    pub(in crate::mpm) fn put_starts(&mut self, lane: usize, starts: [u32; FOUR]) {
        self.start[lane % LANES / FOUR * FOUR..][..FOUR].copy_from_slice(&starts);
    }

    #[inline(always)]
    pub(in crate::mpm) fn start(&self, lane: usize) -> usize {
        self.start[lane % LANES] as usize
    }

    /// Weight of function `k` along `axis`, one where there is no such axis.
    #[inline(always)]
    pub(in crate::mpm) fn weight(&self, lane: usize, axis: usize, k: usize) -> f64 {
        if axis < D { self.axes[axis].weight[k].get(lane) } else { 1.0 }
    }

    /// Weight of row `j` in plane `k`.
    #[inline(always)]
    fn row_weight(&self, lane: usize, j: usize, k: usize) -> f64 {
        if D > 2 { self.across[k][j].get(lane) } else { self.weight(lane, 1, j) }
    }
}

impl<const D: usize, const K: usize> PatchBatch<D> for Products<D, K> {
    type NodeAccumulator<'a, W: Width> = NodeAccumulator<'a, W, K>;

    fn none() -> Self {
        Self { start: [0; LANES], axes: [Weights1dBatch::NONE; D], across: [[Lanes::ZERO; K]; K] }
    }

    #[inline(always)]
    fn cross<W: Width>(&mut self, width: W, lanes: &Range<usize>) {
        if D > 2 {
            for part in parts(lanes) {
                for k in 0..K {
                    let plane = self.axes[2].weight[k].four(width, part);
                    for j in 0..K {
                        let row = self.axes[1].weight[j].four(width, part);
                        self.across[k][j].put(part, row * plane);
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn lever<W: Width>(
        &mut self,
        width: W,
        lanes: &Range<usize>,
        h: f64,
        mean: Option<&Vector<D>>,
    ) {
        for part in parts(lanes) {
            for axis in 0..D {
                self.axes[axis].about(width, part, h, mean.map(|mean| mean[axis]));
            }
        }
    }

    #[inline(always)]
    fn divide<W: Width>(&self, lane: usize, columns: &[W::Four; D]) -> [W::Four; D] {
        array(columns[0], |axis| columns[axis] * self.axes[axis].inverse.get(lane))
    }

    #[inline(always)]
    fn sink<W: Width>(width: W, field: ViewMut<'_>) -> Self::NodeAccumulator<'_, W> {
        NodeAccumulator::new(width, field)
    }

    #[inline(always)]
    fn put<W: Width>(mut sink: Self::NodeAccumulator<'_, W>) {
        sink.put();
    }

    #[inline(always)]
    fn scatter<W: Width>(
        &self,
        lane: usize,
        value: W::Four,
        sink: &mut Self::NodeAccumulator<'_, W>,
    ) {
        let (start, weights) = (self.start(lane), of(&self.axes[0].weight, lane));
        if D == 1 {
            return sink.hold(start, array(value, |i| value * weights[i]));
        }
        for k in 0..Self::PLANES {
            for j in 0..Self::ROWS {
                let term = value * self.row_weight(lane, j, k);
                sink.add(
                    start,
                    (j, k),
                    #[inline(always)]
                    |i| term * weights[i],
                );
            }
        }
    }

    #[inline(always)]
    fn scatter_affine<W: Width>(
        &self,
        lane: usize,
        (value, slope): (W::Four, &[W::Four; D]),
        sink: &mut Self::NodeAccumulator<'_, W>,
    ) {
        let (start, x) = (self.start(lane), &self.axes[0]);
        let (weights, lever) = (of(&x.weight, lane), |axis: usize, k: usize| {
            slope[axis] * self.axes[axis].lever[k].get(lane)
        });
        let growth: [_; K] = array(slope[0], |i| slope[0] * x.arm[i].get(lane));
        if D == 1 {
            return sink.hold(start, array(value, |i| value * weights[i] + growth[i]));
        }
        let rise: [_; K] = array(slope[0], |j| lever(1, j));
        for k in 0..Self::PLANES {
            let value = if D > 2 { value + lever(2, k) } else { value };
            for j in 0..Self::ROWS {
                let value = value + rise[j];
                let weight = self.row_weight(lane, j, k);
                let term = value * weight;
                sink.add(
                    start,
                    (j, k),
                    #[inline(always)]
                    |i| term * weights[i] + growth[i] * weight,
                );
            }
        }
    }

    #[inline(always)]
    fn scatter_flux<W: Width>(
        &self,
        lane: usize,
        flux: &[W::Four; D],
        sink: &mut Self::NodeAccumulator<'_, W>,
    ) {
        let (start, x) = (self.start(lane), &self.axes[0]);
        let (weights, slopes) = (of(&x.weight, lane), of(&x.slope, lane));
        let along: [_; K] = array(flux[0], |i| flux[0] * slopes[i]);
        if D == 1 {
            return sink.hold(start, along);
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
                sink.add(
                    start,
                    (j, k),
                    #[inline(always)]
                    |i| along[i] * weight + across * weights[i],
                );
            }
        }
    }

    #[inline(always)]
    fn scatter_all<W: Width>(
        &self,
        lane: usize,
        (value, slope): (W::Four, Option<W::Four>),
        flux: W::Four,
        sink: &mut Self::NodeAccumulator<'_, W>,
    ) {
        let x = &self.axes[0];
        let terms = array(value, |i| {
            let term = value * x.weight[i].get(lane);
            let term = slope.map_or(term, |slope| term + slope * x.arm[i].get(lane));
            term + flux * x.slope[i].get(lane)
        });
        sink.hold(self.start(lane), terms);
    }

    #[inline(always)]
    fn gather<W: Width>(&self, width: W, lane: usize, field: &View<'_>) -> W::Four {
        self.sum(width, lane, field)
    }

    #[inline(always)]
    fn gather_moment<W: Width>(
        &self,
        width: W,
        lane: usize,
        field: &View<'_>,
    ) -> (W::Four, [W::Four; D]) {
        self.sums(width, lane, field, &array([0.0; K], |axis| of(&self.axes[axis].arm, lane)))
    }

    #[inline(always)]
    fn gather_gradient<W: Width>(
        &self,
        width: W,
        lane: usize,
        field: &View<'_>,
    ) -> (W::Four, [W::Four; D]) {
        self.sums(width, lane, field, &array([0.0; K], |axis| of(&self.axes[axis].slope, lane)))
    }
}

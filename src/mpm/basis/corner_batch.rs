//! Several corners of domains: hats whose gradients are in proportion to their weights.

use super::{node_accumulator::NodeAccumulator, patch::PatchBatch, product_batch::Products};
use crate::mpm::{
    algebra::{Vector, array},
    packed_grid::{View, ViewMut},
    simd::{LANES, Width},
};
use std::ops::Range;

/// Several corners of [CPDI](super::Cpdi)'s domains.
#[derive(Debug)]
pub struct Corners<const D: usize> {
    pub(in crate::mpm) hats: Products<D, 2>,
    /// What makes a gradient of a weight (1/m).
    pub(in crate::mpm) outward: [Vector<D>; LANES],
}

impl<const D: usize> PatchBatch<D> for Corners<D> {
    type NodeAccumulator<'a, W: Width> = NodeAccumulator<'a, W, 2>;

    fn none() -> Self {
        Self { hats: Products::none(), outward: [Vector::zeros(); LANES] }
    }

    #[inline(always)]
    fn cross<W: Width>(&mut self, width: W, lanes: &Range<usize>) {
        self.hats.cross(width, lanes);
    }

    #[inline(always)]
    fn lever<W: Width>(
        &mut self,
        width: W,
        lanes: &Range<usize>,
        h: f64,
        mean: Option<&Vector<D>>,
    ) {
        self.hats.lever(width, lanes, h, mean);
    }

    #[inline(always)]
    fn divide<W: Width>(&self, lane: usize, columns: &[W::Four; D]) -> [W::Four; D] {
        self.hats.divide::<W>(lane, columns)
    }

    #[inline(always)]
    fn sink<W: Width>(width: W, field: ViewMut<'_>) -> Self::NodeAccumulator<'_, W> {
        Products::<D, 2>::sink(width, field)
    }

    #[inline(always)]
    fn put<W: Width>(sink: Self::NodeAccumulator<'_, W>) {
        Products::<D, 2>::put(sink);
    }

    #[inline(always)]
    fn scatter<W: Width>(
        &self,
        lane: usize,
        value: W::Four,
        sink: &mut Self::NodeAccumulator<'_, W>,
    ) {
        self.hats.scatter(lane, value, sink);
    }

    #[inline(always)]
    fn scatter_affine<W: Width>(
        &self,
        lane: usize,
        value_and_slope: (W::Four, &[W::Four; D]),
        sink: &mut Self::NodeAccumulator<'_, W>,
    ) {
        self.hats.scatter_affine(lane, value_and_slope, sink);
    }

    #[inline(always)]
    fn scatter_flux<W: Width>(
        &self,
        lane: usize,
        flux: &[W::Four; D],
        sink: &mut Self::NodeAccumulator<'_, W>,
    ) {
        let outward = &self.outward[lane % LANES];
        let mut value = flux[0] * outward[0];
        for axis in 1..D {
            value += flux[axis] * outward[axis];
        }
        self.hats.scatter(lane, value, sink);
    }

    #[inline(always)]
    fn scatter_all<W: Width>(
        &self,
        lane: usize,
        (value, slope): (W::Four, Option<W::Four>),
        flux: W::Four,
        sink: &mut Self::NodeAccumulator<'_, W>,
    ) {
        let value = value + flux * self.outward[lane % LANES][0];
        match slope {
            None => self.hats.scatter(lane, value, sink),
            Some(slope) => self.hats.scatter_affine(lane, (value, &[slope; D]), sink),
        }
    }

    #[inline(always)]
    fn gather<W: Width>(&self, width: W, lane: usize, field: &View<'_>) -> W::Four {
        self.hats.gather(width, lane, field)
    }

    #[inline(always)]
    fn gather_moment<W: Width>(
        &self,
        width: W,
        lane: usize,
        field: &View<'_>,
    ) -> (W::Four, [W::Four; D]) {
        self.hats.gather_moment(width, lane, field)
    }

    #[inline(always)]
    fn gather_gradient<W: Width>(
        &self,
        width: W,
        lane: usize,
        field: &View<'_>,
    ) -> (W::Four, [W::Four; D]) {
        let (sum, outward) = (self.hats.gather(width, lane, field), &self.outward[lane % LANES]);
        (sum, array(sum, |axis| sum * outward[axis]))
    }
}

//! Several corners of domains: hats whose gradients are in proportion to their weights.

use super::{patch::Patches, products::Products};
use crate::mpm::{
    algebra::{Vector, array},
    four::{LANES, Width},
    packed::{View, ViewMut},
};
use std::ops::Range;

/// Several corners of [CPDI](super::Cpdi)'s domains.
#[derive(Debug)]
pub struct Corners<const D: usize> {
    pub(super) hats: Products<D, 2>,
    /// What makes a gradient of a weight (1/m).
    pub(super) outward: [Vector<D>; LANES],
}

impl<const D: usize> Patches<D> for Corners<D> {
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
    fn scatter<W: Width>(&self, width: W, lane: usize, value: W::Four, field: &mut ViewMut<'_>) {
        self.hats.scatter(width, lane, value, field);
    }

    #[inline(always)]
    fn scatter_affine<W: Width>(
        &self,
        width: W,
        lane: usize,
        value_and_slope: (W::Four, &[W::Four; D]),
        field: &mut ViewMut<'_>,
    ) {
        self.hats.scatter_affine(width, lane, value_and_slope, field);
    }

    #[inline(always)]
    fn scatter_flux<W: Width>(
        &self,
        width: W,
        lane: usize,
        flux: &[W::Four; D],
        field: &mut ViewMut<'_>,
    ) {
        let outward = &self.outward[lane % LANES];
        let mut value = flux[0] * outward[0];
        for axis in 1..D {
            value += flux[axis] * outward[axis];
        }
        self.hats.scatter(width, lane, value, field);
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

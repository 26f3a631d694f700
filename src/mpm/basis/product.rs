//! Products of one-dimensional functions: the patch of most bases.

use super::patch::{NodeWeight, Patch, WeightMoments};
use super::product_batch::ProductBatch;
use super::weights_1d::{Weights1d, product};
use crate::mpm::algebra::{Matrix, Vector, array};
use crate::mpm::grid::Grid;
use crate::mpm::packed_grid::Layout;

/// All products of K functions along each axis, K at most 4.
#[derive(Debug, Clone, Copy)]
pub struct Product<const D: usize, const K: usize>(pub [Weights1d<K>; D]);

impl<const D: usize, const K: usize> Product<D, K> {
    /// Stores the functions as patch `lane` of a batch.
    #[inline(always)]
    pub(super) fn put_into<const OUTWARD: usize>(
        &self,
        lane: usize,
        layout: &Layout,
        patches: &mut ProductBatch<D, K, OUTWARD>,
    ) {
        let first = array::<D, _>(0, |axis| self.0[axis].first);
        patches.start[lane] = layout.number(&first) as u32;
        for (along, axis) in self.0.iter().zip(&mut patches.axes) {
            axis.put(lane, along);
        }
    }
}

impl<const D: usize, const K: usize> Patch<D> for Product<D, K> {
    type Batch = ProductBatch<D, K>;

    #[inline(always)]
    fn put(&self, lane: usize, layout: &Layout, patches: &mut ProductBatch<D, K>) {
        self.put_into(lane, layout, patches);
    }

    #[inline(always)]
    fn weight_moments(&self) -> WeightMoments<D> {
        let moments: [[f64; 3]; D] = array([0.0; 3], |axis| self.0[axis].moments());
        let mut weight_moments = WeightMoments { first: Vector::zeros(), second: Matrix::zeros() };
        for i in 0..D {
            weight_moments.first[i] = product(&moments, |axis| usize::from(axis == i));
            for j in 0..D {
                let order = |axis| usize::from(axis == i) + usize::from(axis == j);
                weight_moments.second[(i, j)] = product(&moments, order);
            }
        }
        weight_moments
    }

    #[inline(always)]
    fn variance(&self) -> ([f64; D], [f64; D]) {
        let moments: [[f64; 3]; D] = array([0.0; 3], |axis| self.0[axis].moments());
        (array(0.0, |axis| moments[axis][1]), array(0.0, |axis| self.0[axis].variance))
    }

    #[inline(always)]
    fn visit(&self, grid: &Grid<D>, mut visit: impl FnMut(NodeWeight<'_, D>)) {
        for n in 0..K.pow(D as u32) {
            let mut rest = n;
            let at: [usize; D] = std::array::from_fn(|_| {
                let k = rest % K;
                rest /= K;
                k
            });
            let index: [usize; D] =
                std::array::from_fn(|axis| grid.wrap(self.0[axis].first + at[axis], axis));
            if (0..D).any(|axis| index[axis] >= grid.counts[axis]) {
                continue;
            }
            let weight = (0..D).map(|axis| self.0[axis].weight[at[axis]]).product();
            let gradient = Vector::from_fn(|along, _| {
                let factor = |axis: usize| {
                    let functions = &self.0[axis];
                    let of = if axis == along { &functions.slope } else { &functions.weight };
                    of[at[axis]]
                };
                (0..D).map(factor).product()
            });
            let offset = Vector::from_fn(|axis, _| self.0[axis].offset[at[axis]]);
            visit(NodeWeight { node: grid.node(&index), weight, gradient: &gradient, offset });
        }
    }
}

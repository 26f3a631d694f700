//! Products of one-dimensional functions: the patch of most bases.

use super::patch::{NodeWeight, Patch};
use super::product_batch::ProductBatch;
use super::weights_1d::{Weights1d, product};
use crate::mpm::foundation::algebra::{Matrix, Vector, array};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::moments::WeightMoments;
use crate::mpm::foundation::packed_grid::Layout;

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
        // Wrapped once for an axis, not once for a node.
        let nodes: [[usize; K]; D] =
            array([0; K], |axis| array(0, |k| grid.wrap(self.0[axis].first + k, axis)));
        for n in 0..K.pow(D as u32) {
            let at: [usize; D] = array(0, |axis| n / K.pow(axis as u32) % K);
            let index: [usize; D] = array(0, |axis| nodes[axis][at[axis]]);
            if (0..D).any(|axis| index[axis] >= grid.counts[axis]) {
                continue;
            }
            let factor = |axis: usize, of: &[f64; K]| of[at[axis]];
            let mut weight = factor(0, &self.0[0].weight);
            for axis in 1..D {
                weight *= factor(axis, &self.0[axis].weight);
            }
            let (mut gradient, mut offset) = (Vector::zeros(), Vector::zeros());
            for along in 0..D {
                let functions = |axis: usize| {
                    let functions = &self.0[axis];
                    if axis == along { &functions.slope } else { &functions.weight }
                };
                let mut product = factor(0, functions(0));
                for axis in 1..D {
                    product *= factor(axis, functions(axis));
                }
                gradient[along] = product;
                offset[along] = self.0[along].offset[at[along]];
            }
            visit(NodeWeight { node: grid.node(&index), weight, gradient: &gradient, offset });
        }
    }
}

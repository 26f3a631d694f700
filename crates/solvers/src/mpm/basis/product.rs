//! Products of one-dimensional functions, the patch type of most bases, for one particle.

use super::contract::{NodeWeight, Patch};
use super::product_batch::ProductBatch;
use super::shape::{FixedShape, PatchShape};
use super::weights_1d::{Weights1d, product};
use crate::mpm::foundation::algebra::{array, zeros};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::moments::WeightMoments;
use crate::mpm::foundation::packed_grid::Layout;

/// Products of one-dimensional functions, with K functions along each axis; K is at most 4.
#[derive(Debug, Clone, Copy)]
pub struct Product<const D: usize, const K: usize>(pub [Weights1d<K>; D]);

impl<const D: usize, const K: usize> Patch<D> for Product<D, K> {
    type ShapeOfPatch = FixedShape<K>;

    #[inline(always)]
    fn put<W: PatchShape>(&self, lane: usize, layout: &Layout, patches: &mut ProductBatch<D, W>) {
        let first = array::<D, _>(0, |axis| self.0[axis].first);
        patches.start[lane] = layout.number(&first) as u32;
        for axis in 0..D {
            patches.axes[axis].put(lane, &self.0[axis]);
        }
    }

    #[inline(always)]
    fn weight_moments(&self) -> WeightMoments<D> {
        let moments: [[f64; 3]; D] = array([0.0; 3], |axis| self.0[axis].moments());
        let mut weight_moments = WeightMoments::zero();
        for i in 0..D {
            weight_moments.mean[i] = product(&moments, |axis| usize::from(axis == i));
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
        // Indices are wrapped once per axis instead of once per node.
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
            let (mut gradient, mut offset) = (zeros(), zeros());
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

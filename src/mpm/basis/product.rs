//! Products of functions along the axes: the patch of nodes that most bases show to a particle.
//!
//! The weights along each axis are computed once for a particle. Sums over the K^D nodes are taken
//! axis by axis, so that a node costs a product and a sum for each function, not one for each axis.

use super::{
    along::{Along, product},
    patch::{Patch, Seen, Spread},
};
use crate::mpm::{
    algebra::{Matrix, Vector, array},
    four::Width,
    grid::Grid,
    packed::{Node, View, ViewMut, number},
};

/// All products of functions along the axes; at most four along each.
#[derive(Debug, Clone, Copy)]
pub struct Product<const D: usize, const K: usize>(pub [Along<K>; D]);

/// `sum_k row_k factors_k`.
#[inline(always)]
fn dot<W: Width, const K: usize>(width: W, row: &[Node], factors: &[f64; K]) -> W::Four {
    let mut sum = width.four(row[0].0) * factors[0];
    for k in 1..K {
        sum += width.four(row[k].0) * factors[k];
    }
    sum
}

#[inline(always)]
fn add<W: Width>(width: W, node: &mut Node, value: W::Four) {
    node.0 = (width.four(node.0) + value).into();
}

impl<const D: usize, const K: usize> Product<D, K> {
    /// Rows of a plane, and planes: one where there is no such axis.
    const ROWS: usize = if D > 1 { K } else { 1 };
    const PLANES: usize = if D > 2 { K } else { 1 };

    /// Weight of function `k` along `axis`, one where there is no such axis.
    #[inline(always)]
    fn weight(&self, axis: usize, k: usize) -> f64 {
        if axis < D { self.0[axis].weight[k] } else { 1.0 }
    }

    #[inline(always)]
    fn start(&self, strides: &[usize; 3]) -> usize {
        number(&array::<D, _>(0, |axis| self.0[axis].first), strides)
    }

    /// `sum_i field_i N_i`, and the same with the functions along one axis replaced by `others`,
    /// for each axis.
    #[inline(always)]
    fn sums<W: Width>(
        &self,
        width: W,
        field: &View<'_>,
        others: &[[f64; K]; D],
    ) -> (W::Four, [W::Four; D]) {
        let (start, zero) = (self.start(&field.strides), width.four([0.0; 4]));
        let (mut sum, mut other) = (zero, [zero; D]);
        for k in 0..Self::PLANES {
            let (mut plane, mut across, mut along) = (zero, zero, zero);
            for j in 0..Self::ROWS {
                let row = field.row::<K>(start + j * field.strides[1] + k * field.strides[2]);
                let weight = self.weight(1, j);
                let terms = dot(width, row, &self.0[0].weight);
                across += dot(width, row, &others[0]) * weight;
                plane += terms * weight;
                if D > 1 {
                    along += terms * others[1][j];
                }
            }
            let weight = self.weight(2, k);
            sum += plane * weight;
            other[0] += across * weight;
            if D > 1 {
                other[1] += along * weight;
            }
            if D > 2 {
                other[2] += plane * others[2][k];
            }
        }
        (sum, other)
    }
}

impl<const D: usize, const K: usize> Patch<D> for Product<D, K> {
    #[inline(always)]
    fn scatter<W: Width>(&self, width: W, value: W::Four, field: &mut ViewMut<'_>) {
        let start = self.start(&field.strides);
        for k in 0..Self::PLANES {
            for j in 0..Self::ROWS {
                let term = value * (self.weight(1, j) * self.weight(2, k));
                let at = start + j * field.strides[1] + k * field.strides[2];
                let row = field.row::<K>(at);
                for i in 0..K {
                    add(width, &mut row[i], term * self.0[0].weight[i]);
                }
            }
        }
    }

    #[inline(always)]
    fn scatter_affine<W: Width>(
        &self,
        width: W,
        (value, mean): (W::Four, &Vector<D>),
        slope: &[W::Four; D],
        field: &mut ViewMut<'_>,
    ) {
        let (start, x) = (self.start(&field.strides), &self.0[0]);
        let arms = x.arms(mean[0]);
        let growth: [_; K] = array(slope[0], |i| slope[0] * arms[i]);
        for k in 0..Self::PLANES {
            let value =
                if D > 2 { value + slope[2] * (self.0[2].offset[k] - mean[2]) } else { value };
            for j in 0..Self::ROWS {
                let value =
                    if D > 1 { value + slope[1] * (self.0[1].offset[j] - mean[1]) } else { value };
                let weight = self.weight(1, j) * self.weight(2, k);
                let term = value * weight;
                let row = field.row::<K>(start + j * field.strides[1] + k * field.strides[2]);
                for i in 0..K {
                    add(width, &mut row[i], term * x.weight[i] + growth[i] * weight);
                }
            }
        }
    }

    #[inline(always)]
    fn scatter_flux<W: Width>(&self, width: W, flux: &[W::Four; D], field: &mut ViewMut<'_>) {
        let (start, x) = (self.start(&field.strides), &self.0[0]);
        let along: [_; K] = array(flux[0], |i| flux[0] * x.slope[i]);
        for k in 0..Self::PLANES {
            for j in 0..Self::ROWS {
                let weight = self.weight(1, j) * self.weight(2, k);
                let mut across = width.four([0.0; 4]);
                if D > 1 {
                    across = flux[1] * (self.0[1].slope[j] * self.weight(2, k));
                }
                if D > 2 {
                    across += flux[2] * (self.0[2].slope[k] * self.weight(1, j));
                }
                let row = field.row::<K>(start + j * field.strides[1] + k * field.strides[2]);
                for i in 0..K {
                    let term = along[i] * weight;
                    let term = if D > 1 { term + across * x.weight[i] } else { term };
                    add(width, &mut row[i], term);
                }
            }
        }
    }

    #[inline(always)]
    fn gather<W: Width>(&self, width: W, field: &View<'_>) -> W::Four {
        let (start, mut sum) = (self.start(&field.strides), width.four([0.0; 4]));
        for k in 0..Self::PLANES {
            let mut plane = width.four([0.0; 4]);
            for j in 0..Self::ROWS {
                let row = field.row::<K>(start + j * field.strides[1] + k * field.strides[2]);
                plane += dot(width, row, &self.0[0].weight) * self.weight(1, j);
            }
            sum += plane * self.weight(2, k);
        }
        sum
    }

    #[inline(always)]
    fn gather_moment<W: Width>(
        &self,
        width: W,
        mean: &Vector<D>,
        field: &View<'_>,
    ) -> (W::Four, [W::Four; D]) {
        let arms = array([0.0; K], |axis| self.0[axis].arms(mean[axis]));
        self.sums(width, field, &arms)
    }

    #[inline(always)]
    fn gather_gradient<W: Width>(&self, width: W, field: &View<'_>) -> (W::Four, [W::Four; D]) {
        let slopes = array([0.0; K], |axis| self.0[axis].slope);
        self.sums(width, field, &slopes)
    }

    #[inline(always)]
    fn spread(&self) -> Spread<D> {
        let moments: [[f64; 3]; D] = array([0.0; 3], |axis| self.0[axis].moments());
        let mut spread = Spread { first: Vector::zeros(), second: Matrix::zeros() };
        for i in 0..D {
            spread.first[i] = product(&moments, |axis| usize::from(axis == i));
            for j in 0..D {
                let order = |axis| usize::from(axis == i) + usize::from(axis == j);
                spread.second[(i, j)] = product(&moments, order);
            }
        }
        spread
    }

    #[inline(always)]
    fn variance(&self) -> ([f64; D], [f64; D]) {
        let moments: [[f64; 3]; D] = array([0.0; 3], |axis| self.0[axis].moments());
        (array(0.0, |axis| moments[axis][1]), array(0.0, |axis| moments[axis][2]))
    }

    #[inline(always)]
    fn visit(&self, grid: &Grid<D>, mut visit: impl FnMut(Seen<'_, D>)) {
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
            visit(Seen { node: grid.node(&index), weight, gradient: &gradient, offset });
        }
    }
}

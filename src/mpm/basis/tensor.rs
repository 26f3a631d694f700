//! Tensor products of functions along the axes.

use super::contract::Seen;
use crate::mpm::{algebra::Vector, grid::Grid};

/// The functions along one axis that a point sees: `count` of at most K.
#[derive(Debug, Clone, Copy)]
pub(super) struct Along<const K: usize> {
    /// How many.
    pub(super) count: usize,
    /// Their index along the axis.
    pub(super) index: [usize; K],
    /// Their values.
    pub(super) weight: [f64; K],
    /// Their derivatives (1/m).
    pub(super) slope: [f64; K],
}

impl<const K: usize> Along<K> {
    pub(super) const EMPTY: Self =
        Self { count: 0, index: [0; K], weight: [0.0; K], slope: [0.0; K] };
}

/// Visits all products, the first axis running fastest. `offset` tells where function k along an axis
/// sits, from the particle (m); it costs nothing where nobody looks at it.
#[inline]
pub(super) fn visit<const D: usize, const K: usize>(
    grid: &Grid<D>,
    axes: &[Along<K>; D],
    offset: impl Fn(usize, usize) -> f64,
    mut visit: impl FnMut(Seen<'_, D>),
) {
    let total: usize = axes.iter().map(|along| along.count).product();
    for k in 0..total {
        let (mut rest, mut index, mut at, mut weight) = (k, [0; D], [0; D], 1.0);
        for axis in 0..D {
            at[axis] = rest % axes[axis].count;
            rest /= axes[axis].count;
            index[axis] = axes[axis].index[at[axis]];
            weight *= axes[axis].weight[at[axis]];
        }
        let gradient = Vector::from_fn(|axis, _| gradient(axes, axis, &at));
        let offset = Vector::from_fn(|axis, _| offset(axis, at[axis]));
        visit(Seen { node: grid.node(&index), weight, gradient: &gradient, offset });
    }
}

#[inline]
fn gradient<const D: usize, const K: usize>(
    axes: &[Along<K>; D],
    along: usize,
    at: &[usize; D],
) -> f64 {
    let mut product = axes[along].slope[at[along]];
    for axis in (0..D).filter(|&axis| axis != along) {
        product *= axes[axis].weight[at[axis]];
    }
    product
}

//! The faces of the grid.

use crate::mpm::foundation::grid::Grid;

/// The low or the high end of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Where the coordinate is smallest.
    Low,
    /// Where the coordinate is largest.
    High,
}

/// The nodes of `grid` on one face, in their order.
pub(in crate::mpm) fn nodes<const D: usize>(grid: &Grid<D>, axis: usize, side: Side) -> Vec<usize> {
    let index = match side {
        Side::Low => 0,
        Side::High => grid.counts[axis] - 1,
    };
    (0..grid.nodes()).filter(|&i| grid.index_on_axis(i, axis) == index).collect()
}

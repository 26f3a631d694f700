//! From packed fields back to the columns of the grid.

use crate::mpm::{
    algebra::Vector,
    grid::Grid,
    packed::{Node, Packed},
};

/// The first D of four numbers.
pub(super) fn vector<const D: usize>(lanes: &[f64; 4]) -> Vector<D> {
    Vector::from_fn(|i, _| lanes[i])
}

/// Unpacks a field into a column of the grid.
pub(super) fn fill<const D: usize, T>(
    field: &Packed,
    grid: &Grid<D>,
    column: &mut [T],
    value: impl Fn(&[f64; 4]) -> T,
) {
    for (row, nodes) in column.chunks_exact_mut(grid.counts[0]).zip(field.rows(grid)) {
        for (there, Node(lanes)) in row.iter_mut().zip(nodes) {
            *there = value(lanes);
        }
    }
}

//! Boundary conditions on the grid.

use super::{algebra::Vector, grid::Grid};

/// The low or the high end of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Where the coordinate is smallest.
    Low,
    /// Where the coordinate is largest.
    High,
}

/// A face of the grid whose nodes do not move.
#[derive(Debug, Clone)]
pub struct Fixed {
    nodes: Vec<usize>,
}

impl Fixed {
    /// The nodes of `grid` on one face.
    pub fn face<const D: usize>(grid: &Grid<D>, axis: usize, side: Side) -> Self {
        let index = match side {
            Side::Low => 0,
            Side::High => grid.counts[axis] - 1,
        };
        let nodes = (0..grid.nodes()).filter(|&i| grid.index_on_axis(i, axis) == index).collect();
        Self { nodes }
    }

    /// The nodes of the face.
    pub fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    /// Sets a nodal field to zero on the face.
    pub fn hold<const D: usize>(&self, field: &mut [Vector<D>]) {
        for &i in &self.nodes {
            field[i] = Vector::zeros();
        }
    }
}

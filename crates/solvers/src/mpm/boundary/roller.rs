//! A frictionless wall, or a plane of symmetry: v . n = 0, and no force along the wall.

use super::contract::{Advance, Boundary, Side, nodes};
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use mpm_subject::Column;

/// A face of the grid along which the body slides.
#[derive(Debug, Clone)]
pub struct Roller {
    nodes: Vec<usize>,
    axis: usize,
    side: Side,
}

impl Roller {
    /// Restrains the nodes of `grid` on one face along its normal, `axis`.
    pub fn face<const D: usize>(grid: &Grid<D>, axis: usize, side: Side) -> Self {
        Self { nodes: nodes(grid, axis, side), axis, side }
    }

    fn hold<const D: usize>(&self, field: &mut [Vector<D>]) {
        for &i in &self.nodes {
            field[i][self.axis] = 0.0;
        }
    }
}

impl<const D: usize> Boundary<D> for Roller {
    fn columns(&self) -> Vec<Column<'_>> {
        vec![Column::of_nodes("roller", &self.nodes)]
    }

    fn hold_velocity(&self, velocity: &mut [Vector<D>], _: f64) {
        self.hold(velocity);
    }

    fn hold_acceleration(&self, acceleration: &mut [Vector<D>], _: &Advance) {
        self.hold(acceleration);
    }

    fn standing_face(&self) -> Option<(usize, Side)> {
        Some((self.axis, self.side))
    }

    fn clear(&self, field: &mut [Vector<D>]) {
        self.hold(field);
    }
}

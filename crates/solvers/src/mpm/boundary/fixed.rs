//! A no-slip wall, to which the body sticks: v = 0.

use super::contract::{Advance, Boundary, Side, nodes};
use crate::mpm::foundation::algebra::{Vector, zeros};
use crate::mpm::foundation::grid::Grid;
use mpm_subject::Column;

/// A face of the grid with fixed nodes.
#[derive(Debug, Clone)]
pub struct Fixed {
    nodes: Vec<usize>,
    face: (usize, Side),
}

impl Fixed {
    /// Fixes the nodes of `grid` on one face.
    pub fn face<const D: usize>(grid: &Grid<D>, axis: usize, side: Side) -> Self {
        Self { nodes: nodes(grid, axis, side), face: (axis, side) }
    }

    fn hold<const D: usize>(&self, field: &mut [Vector<D>]) {
        for &i in &self.nodes {
            field[i] = zeros();
        }
    }
}

impl<const D: usize> Boundary<D> for Fixed {
    fn columns(&self) -> Vec<Column<'_>> {
        vec![Column::of_nodes("fixed", &self.nodes)]
    }

    fn hold_velocity(&self, velocity: &mut [Vector<D>], _: f64) {
        self.hold(velocity);
    }

    fn hold_acceleration(&self, acceleration: &mut [Vector<D>], _: &Advance) {
        self.hold(acceleration);
    }

    fn standing_face(&self) -> Option<(usize, Side)> {
        Some(self.face)
    }

    fn clear(&self, field: &mut [Vector<D>]) {
        self.hold(field);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_components_are_held() {
        let grid = Grid::<2>::new(Vector::zeros(), 1.0, [2, 1], [false; 2], [3, 2]);
        let wall = Fixed::face(&grid, 1, Side::Low);
        let mut cleared = vec![Vector::<2>::from_element(7.0); grid.nodes()];
        let mut held = cleared.clone();
        Boundary::clear(&wall, &mut cleared);
        wall.hold_velocity(&mut held, 0.0);
        assert_eq!(cleared, held);
        assert_eq!(cleared.iter().filter(|v| v.norm() == 0.0).count(), 3);
    }
}

//! A wall with a prescribed velocity, to which the body sticks: v = v(x, t).
//!
//! Each node has the wall velocity at the position of the node. The wall stays at the face of the
//! grid, which does not move. A wall may therefore slide any distance along itself, but may move
//! along its normal only by a small fraction of a cell.

use super::contract::{Advance, Boundary, Side, nodes};
use crate::mpm::basis::BasisName;
use crate::mpm::foundation::algebra::{Vector, zeros};
use crate::mpm::foundation::grid::Grid;
use mpm_subject::Column;

/// A velocity (m/s) as a function of position and time.
pub type VelocityField<const D: usize> = Box<dyn Fn(&Vector<D>, f64) -> Vector<D> + Send>;

/// A face of the grid with a prescribed velocity.
pub struct Prescribed<const D: usize> {
    nodes: Vec<(usize, Vector<D>)>,
    value: VelocityField<D>,
}

impl<const D: usize> Prescribed<D> {
    /// Prescribes the velocity of the nodes on one face of `grid`. `basis` determines the node
    /// positions.
    pub fn face(
        grid: &Grid<D>,
        basis: BasisName,
        axis: usize,
        side: Side,
        value: VelocityField<D>,
    ) -> Self {
        let place = |i| (i, basis.place(grid, i));
        Self { nodes: nodes(grid, axis, side).into_iter().map(place).collect(), value }
    }
}

/// Returns `value` at `x` and `t` (s). Before the start, t < 0, the formula may be undefined and is
/// not evaluated. Instead the velocity is extrapolated by `v(-t) = 2 v(0) - v(t)`, which is exact
/// for a constant acceleration.
pub(in crate::mpm) fn continued<const D: usize>(
    value: &VelocityField<D>,
    x: &Vector<D>,
    t: f64,
) -> Vector<D> {
    if t < 0.0 { value(x, 0.0) * 2.0 - value(x, -t) } else { value(x, t) }
}

impl<const D: usize> Boundary<D> for Prescribed<D> {
    fn columns(&self) -> Vec<Column<'_>> {
        vec![Column::of_nodes("prescribed", &self.nodes)]
    }

    fn hold_velocity(&self, velocity: &mut [Vector<D>], t: f64) {
        for (i, x) in &self.nodes {
            velocity[*i] = continued(&self.value, x, t);
        }
    }

    fn hold_acceleration(&self, acceleration: &mut [Vector<D>], advance: &Advance) {
        let at = |x, t| continued(&self.value, x, t);
        for (i, x) in &self.nodes {
            acceleration[*i] = (at(x, advance.to) - at(x, advance.from)) / advance.dt;
        }
    }

    fn clear(&self, field: &mut [Vector<D>]) {
        for (i, _) in &self.nodes {
            field[*i] = zeros();
        }
    }
}

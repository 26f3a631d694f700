//! Contract of a boundary condition with the rest of the solver, and the faces of the grid.

use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::subject::{Checkpoint, Column};

/// An advance of the grid's velocities: `v += dt a`.
///
/// Euler-Cromer is a leapfrog: the velocities that move positions from t to t + dt are those of the
/// middle of that time. So a step advances velocities from t - dt/2 to t + dt/2, and a prescribed
/// velocity is imposed with second order under any scheme. If the run starts from the velocities at
/// t = 0, the first advance is shorter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Advance {
    /// Time of the velocities before the advance (s).
    pub from: f64,
    /// Time of the velocities after it (s).
    pub to: f64,
    /// Factor of the accelerations (s).
    pub dt: f64,
}

/// A condition on some nodes.
///
/// Schemes use both hooks. USF and USL prescribe the mapped velocities and then add the
/// accelerations; MUSL transfers the accelerations to the particles and prescribes the velocities
/// that are mapped back. Both must be consistent: a prescribed velocity plus the prescribed
/// acceleration is the prescribed velocity at the later time.
pub trait Boundary<const D: usize>: Send {
    /// Columns for nodes.
    fn columns(&self) -> Vec<Column<'_>>;

    /// Visits the state between two steps.
    fn checkpoint(&mut self, _: &mut Checkpoint<'_>) {}

    /// Whether [`Boundary::hold_advance`] reads velocities: they are then mapped before forces.
    fn reads_velocity(&self) -> bool {
        false
    }

    /// Imposes the condition on nodal velocities (m/s) of time `t` (s).
    fn hold_velocity(&self, velocity: &mut [Vector<D>], t: f64);

    /// Imposes the condition on nodal accelerations (m/s2) of `advance`.
    fn hold_acceleration(&self, acceleration: &mut [Vector<D>], advance: &Advance);

    /// Imposes a condition on velocities (m/s) and accelerations (m/s2) together; the former
    /// satisfy it before the advance. Velocities are mapped by then only if a condition reads them.
    fn hold_advance(
        &mut self,
        _velocity: &mut [Vector<D>],
        acceleration: &mut [Vector<D>],
        advance: &Advance,
    ) {
        self.hold_acceleration(acceleration, advance);
    }

    /// Axis and end of a face with fixed normal velocity, whose wall carries the whole force of its
    /// nodes; `None` for a wall that moves, or releases nodes.
    fn standing_face(&self) -> Option<(usize, Side)> {
        None
    }

    /// Sets the constrained components of a nodal field to zero.
    fn clear(&self, field: &mut [Vector<D>]);
}

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

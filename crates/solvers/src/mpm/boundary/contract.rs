//! Interface between a boundary condition and the rest of the solver, and the faces of the grid.

use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use mpm_subject::Column;

/// An advance of the grid velocities: `v += dt a`.
///
/// Euler-Cromer is a leapfrog method: the velocities that move positions from t to t + dt are those
/// at the middle of this interval. A step therefore advances velocities from t - dt/2 to t + dt/2,
/// and a prescribed velocity is accurate to second order in any scheme. If the run starts from the
/// velocities at t = 0, the first advance is shorter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Advance {
    /// Time of the velocities before the advance (s).
    pub from: f64,
    /// Time of the velocities after the advance (s).
    pub to: f64,
    /// Length dt of the time step in `v += dt a` (s).
    pub dt: f64,
}

/// A boundary condition on some nodes.
///
/// Schemes use both [`hold_velocity`](Self::hold_velocity) and
/// [`hold_acceleration`](Self::hold_acceleration). USF and USL prescribe the mapped velocities and
/// then add the accelerations. MUSL transfers the accelerations to the particles and prescribes the
/// velocities that are mapped back. The functions must be consistent: a prescribed velocity plus
/// the change by the prescribed acceleration must equal the prescribed velocity at the later time.
pub trait Boundary<const D: usize>: Send {
    /// Returns the columns that the condition stores per node.
    fn columns(&self) -> Vec<Column<'_>>;

    /// Whether [`Boundary::hold_advance`] reads velocities. If so, velocities are mapped to the
    /// grid before forces are computed.
    fn reads_velocity(&self) -> bool {
        false
    }

    /// Imposes the condition on nodal velocities (m/s) at time `t` (s).
    fn hold_velocity(&self, velocity: &mut [Vector<D>], t: f64);

    /// Imposes the condition on nodal accelerations (m/s2) during `advance`.
    fn hold_acceleration(&self, acceleration: &mut [Vector<D>], advance: &Advance);

    /// Imposes a condition on velocities (m/s) and accelerations (m/s2) together. The velocities
    /// before the advance already satisfy the condition. They are available only if
    /// [`Boundary::reads_velocity`] of some condition returns true.
    fn hold_advance(
        &mut self,
        _velocity: &mut [Vector<D>],
        acceleration: &mut [Vector<D>],
        advance: &Advance,
    ) {
        self.hold_acceleration(acceleration, advance);
    }

    /// Returns the axis of a face with fixed normal velocity, and the end of this axis, if the wall
    /// carries the complete force of its nodes. `None` for a wall that moves or releases nodes.
    fn standing_face(&self) -> Option<(usize, Side)> {
        None
    }

    /// Sets the constrained components of a nodal field to zero.
    fn clear(&self, field: &mut [Vector<D>]);
}

/// The low or the high end of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The end with the smallest coordinate.
    Low,
    /// The end with the largest coordinate.
    High,
}

impl Side {
    /// Returns the sign of the outward normal along the axis.
    pub(in crate::mpm) fn sign(self) -> f64 {
        match self {
            Self::Low => -1.0,
            Self::High => 1.0,
        }
    }
}

/// Returns the nodes of `grid` on one face, in ascending order.
pub(in crate::mpm) fn nodes<const D: usize>(grid: &Grid<D>, axis: usize, side: Side) -> Vec<usize> {
    let index = match side {
        Side::Low => 0,
        Side::High => grid.counts[axis] - 1,
    };
    (0..grid.nodes()).filter(|&i| grid.index_on_axis(i, axis) == index).collect()
}

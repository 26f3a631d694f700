//! What a boundary condition is to the rest of the solver.

use crate::{
    mpm::algebra::Vector,
    subject::{Checkpoint, Column},
};

/// An advance of the grid's velocities: `v += dt a`.
///
/// Euler-Cromer is a leapfrog: the velocities that carry positions from t to t + dt stand for the
/// middle of that time. So a step takes velocities from t - dt/2 to t + dt/2, and a velocity that is
/// prescribed in between is followed to second order, whatever the scheme. Only the first step is
/// shorter, if it starts from the velocities at t = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Advance {
    /// Time that the velocities stand for before (s).
    pub from: f64,
    /// Time that they stand for after (s).
    pub to: f64,
    /// What accelerations are multiplied by (s).
    pub dt: f64,
}

/// A condition on some nodes.
///
/// Schemes ask for both. USF and USL hold the mapped velocities and then add the accelerations;
/// MUSL gives the accelerations to the particles and holds the velocities that come back. The two
/// must agree: a held velocity that takes the held acceleration is the held velocity of the time
/// after.
pub trait Boundary<const D: usize>: Send {
    /// What the condition keeps for its nodes.
    fn columns(&self) -> Vec<Column>;

    /// Shows what it remembers from step to step.
    fn checkpoint(&mut self, _: &mut Checkpoint<'_>) {}

    /// Whether [`Boundary::hold_advance`] reads velocities: they are then mapped before forces.
    fn reads_velocity(&self) -> bool {
        false
    }

    /// Gives the nodal velocities (m/s), which stand for time `t` (s), what is held of them.
    fn hold_velocity(&self, velocity: &mut [Vector<D>], t: f64);

    /// Gives the nodal accelerations (m/s2) of `advance` what is held of them.
    fn hold_acceleration(&self, acceleration: &mut [Vector<D>], advance: &Advance);

    /// Gives an advance what is held of it, where that depends on both: the nodal velocities (m/s)
    /// before it, which have been held, and the accelerations (m/s2). Velocities are those of the
    /// grid only if some condition reads them.
    fn hold_advance(
        &mut self,
        _velocity: &mut [Vector<D>],
        acceleration: &mut [Vector<D>],
        advance: &Advance,
    ) {
        self.hold_acceleration(acceleration, advance);
    }

    /// Sets to zero what is held of a nodal field, whatever it is held at.
    fn clear(&self, field: &mut [Vector<D>]);
}

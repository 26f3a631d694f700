//! Visits to the nodes, each for all that stages want of it.

use super::{
    setup::Setup,
    solver::Solver,
    stage::Gathered,
    transfer::{Also, Wanted, g2p, rest},
};

impl<const D: usize> Solver<D> {
    /// P2G: what is wanted of the particles as they are.
    pub(super) fn map(&mut self, wanted: Wanted) {
        let Setup { grid, particles, kernel, transfer, .. } = &mut self.setup;
        let passes = transfer.p2g(kernel.as_ref(), particles, grid, wanted);
        self.count(passes);
    }

    /// G2P: what is wanted of the grid's velocities in a step of `dt` (s), and `with_velocities` those
    /// that particles have after it.
    pub(super) fn take(&mut self, dt: f64, with_velocities: bool, wanted: Gathered) {
        let Setup { grid, particles, kernel, transfer, boundary, .. } = &mut self.setup;
        let carried = wanted.carried.then_some(&mut *self.carried);
        let (kernel, also) = (kernel.as_ref(), Also { gradient: wanted.gradient, carried });
        let passes = if with_velocities {
            g2p(transfer.as_mut(), kernel, (grid, boundary), dt, particles, also)
        } else {
            rest(transfer.as_mut(), kernel, grid, dt, particles, also)
        };
        self.count(passes);
    }
}

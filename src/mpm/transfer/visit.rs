//! G2P in one visit to the nodes, for transfers that can.

use super::contract::Transfer;
use crate::mpm::{
    algebra::Vector,
    boundary::Boundary,
    grid::Grid,
    kernel::{contract::Kernel, request::G2pRequest},
    particles::Particles,
};

/// What else is taken from the nodes whose velocities particles take.
#[derive(Debug, Default)]
pub struct Also<'a, const D: usize> {
    /// Velocity gradients, into `particles.grad_v`.
    pub gradient: bool,
    /// Where the grid carries each particle (m).
    pub carried: Option<&'a mut [Vector<D>]>,
}

/// New particle velocities after a step of `dt` (s), and what else is taken from the same nodes. Each
/// has the bits that it would have alone. Returns the passes that it stands for, without that of
/// `carried`.
pub fn g2p<const D: usize>(
    transfer: &mut dyn Transfer<D>,
    kernel: &dyn Kernel<D>,
    (grid, boundary): (&Grid<D>, &[Box<dyn Boundary<D>>]),
    dt: f64,
    particles: &mut Particles<D>,
    also: Also<'_, D>,
) -> u64 {
    let Some(recipe) = transfer.recipe() else {
        let passes = transfer.g2p_velocity(kernel, grid, boundary, dt, particles);
        return passes + rest(transfer, kernel, grid, dt, particles, also);
    };
    let (mut v, mut grad_v) =
        (std::mem::take(&mut particles.v), std::mem::take(&mut particles.grad_v));
    let moment = transfer.moment_column();
    let passes = recipe.passes(moment.is_some()) + u64::from(also.gradient);
    let takes = G2pRequest {
        change: recipe.change.then_some(dt),
        mix: recipe.mix,
        value: Some(&mut v),
        moment,
        gradient: also.gradient.then_some(&mut grad_v),
        advected: also.carried.map(|carried| (dt, carried)),
    };
    kernel.g2p_all(grid, particles, takes);
    (particles.v, particles.grad_v) = (v, grad_v);
    passes
}

/// The same without new velocities.
pub(in crate::mpm) fn rest<const D: usize>(
    transfer: &mut dyn Transfer<D>,
    kernel: &dyn Kernel<D>,
    grid: &Grid<D>,
    dt: f64,
    particles: &mut Particles<D>,
    also: Also<'_, D>,
) -> u64 {
    let fits = also.gradient && !transfer.takes_gradient_of_basis();
    let passes = if fits { transfer.g2p_gradient(kernel, grid, particles) } else { 0 };
    let gradient = also.gradient && !fits;
    if gradient || also.carried.is_some() {
        let mut grad_v = std::mem::take(&mut particles.grad_v);
        let gradient = gradient.then_some(&mut *grad_v);
        let advected = also.carried.map(|carried| (dt, carried));
        let takes = G2pRequest { gradient, advected, ..G2pRequest::default() };
        kernel.g2p_all(grid, particles, takes);
        particles.grad_v = grad_v;
    }
    passes + u64::from(gradient)
}

//! Passes of G2P for the request of a transfer.

use super::contract::Transfer;
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::Kernel;
use crate::mpm::kernel::request::{Divergence, G2pRequest};
use crate::mpm::stage::Stage;

/// G2P over `dt` (s) for `stages`: new velocities, velocity gradients into `particles.grad_v`, and
/// positions after the step into `advected` (m), in one pass. Returns how many passes its parts
/// count as, without that of positions, which counts once these have moved.
pub fn g2p<const D: usize>(
    transfer: &mut dyn Transfer<D>,
    kernel: &dyn Kernel<D>,
    (grid, dt): (&Grid<D>, f64),
    particles: &mut Particles<D>,
    stages: &[Stage],
    advected: &mut [Vector<D>],
) -> u64 {
    let is_fit = transfer.p2g_request(particles).force == Some(Divergence::Fit);
    let (mut request, mut passes) = (G2pRequest::default(), 0);
    if stages.contains(&Stage::ParticleVelocity) {
        passes += transfer.filter_velocities(kernel, grid, particles);
        request = transfer.g2p_request(dt);
    }
    let (mut v, mut grad_v) =
        (std::mem::take(&mut particles.v), std::mem::take(&mut particles.grad_v));
    request.value = stages.contains(&Stage::ParticleVelocity).then_some(&mut v);
    let wants_gradient = stages.contains(&Stage::Stress);
    // The transfer's own gradient is that of the same velocities.
    let is_copied = wants_gradient && !is_fit && request.gradient.is_some();
    if wants_gradient && is_fit {
        request.fit = Some(&mut grad_v);
    } else if wants_gradient && !is_copied {
        request.gradient = Some(&mut grad_v);
    }
    if stages.contains(&Stage::Position) {
        request.advected = Some((dt, advected));
    }
    let parts = request.parts().count();
    passes += parts as u64 - u64::from(request.advected.is_some());
    if parts > 0 {
        kernel.g2p_all(grid, particles, request);
    }
    if is_copied && let Some(gradient) = transfer.g2p_request(dt).gradient {
        grad_v.copy_from_slice(gradient);
    }
    (particles.v, particles.grad_v) = (v, grad_v);
    passes
}

/// G2P: adds the grid's accelerations over `dt` (s) to velocities and affine states of particles,
/// with no other change, as at the start of a run half a step back.
pub(in crate::mpm) fn kick<const D: usize>(
    transfer: &mut dyn Transfer<D>,
    kernel: &dyn Kernel<D>,
    grid: &Grid<D>,
    dt: f64,
    particles: &mut Particles<D>,
) -> u64 {
    let mut v = std::mem::take(&mut particles.v);
    kernel.g2p(grid, &grid.acceleration, particles, (1.0, dt), &mut v);
    particles.v = v;
    // Free until the stage of stresses.
    let mut change = std::mem::take(&mut particles.grad_v);
    let G2pRequest { moment, gradient, .. } = transfer.g2p_request(dt);
    if moment.is_some() {
        kernel.g2p_moment(grid, &grid.acceleration, particles, &mut change);
    } else if gradient.is_some() {
        kernel.g2p_gradient(grid, &grid.acceleration, particles, &mut change);
    }
    let state = moment.or(gradient);
    let passes = 1 + u64::from(state.is_some());
    for (state, change) in state.into_iter().flatten().zip(&change) {
        *state += change * dt;
    }
    particles.grad_v = change;
    passes
}

//! Interface between a transfer and the rest of the solver, and the G2P passes for its request.

use crate::mpm::boundary::Boundary;
use crate::mpm::foundation::algebra::{Matrix, Vector};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::{Divergence, G2pRequest, Kernel, P2gRequest, ParticleField};
use crate::mpm::scheme::Stage;
use mpm_subject::Column;

/// Kind of a transfer. The kind determines with which bases, mass matrices and frames the transfer
/// can be combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TransferKind {
    /// Particles have only a velocity.
    Velocity,
    /// Particles have an affine velocity field.
    Field,
    /// Particles have an affine velocity field, and gradients come from the fit of this field
    /// instead of the basis.
    Fit,
    /// Grid velocities result from a series in the lumped mass matrix.
    Series,
    /// Fields are reconstructed in cells.
    Cells,
}

/// Integer parameter of a transfer, with its range and its text in messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TransferParameter {
    /// Range of the parameter: minimum and maximum value.
    pub range: (u32, u32),
    /// Text before and after the value in messages, as in `a series of 8 terms`.
    pub words: (&'static str, &'static str),
}

impl TransferParameter {
    /// Parameter of a series: its number of terms. Each term needs two passes over the particles.
    pub(super) const TERMS: Self = Self { range: (1, 64), words: ("a series of", "terms") };
}

/// Exchange of velocities between particles and grid, by passes of a [`Kernel`]. A method that
/// loops over particles returns a number of passes for the work counter. Each quantity of a request
/// counts as one pass.
pub trait Transfer<const D: usize>: Send + Sync {
    /// Returns the kind of the transfer.
    fn kind(&self) -> TransferKind {
        TransferKind::Velocity
    }

    /// Initialises the transfer for these particles, whose `grad_v` is the gradient of their
    /// initial velocity.
    fn start(&mut self, _: &dyn Kernel<D>, _: &Grid<D>, _: &Particles<D>) {}

    /// Returns the columns that the transfer stores per particle or node.
    fn columns(&self) -> Vec<Column<'_>> {
        Vec::new()
    }

    /// Returns the request for all P2G quantities. With [`Divergence::Fit`], velocity gradients are
    /// also computed by fit.
    fn p2g_request<'a>(&'a self, particles: &'a Particles<D>) -> P2gRequest<'a, D> {
        let momentum = Some(ParticleField { v: &particles.v, affine: None });
        P2gRequest { mass: true, momentum, force: Some(Divergence::Gradient) }
    }

    /// Performs P2G for `stages`, in one pass if the transfer supports this. In the first pass
    /// after particles have moved, `stages` includes mass.
    fn p2g(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &mut Grid<D>,
        stages: &[Stage],
    ) -> u64 {
        p2g(self.p2g_request(particles), kernel, particles, grid, stages)
    }

    /// Improves a nodal field computed with the lumped mass matrix.
    fn refine(
        &mut self,
        _: &dyn Kernel<D>,
        _: &Particles<D>,
        _: &Grid<D>,
        _: &[Box<dyn Boundary<D>>],
        _: &mut [Vector<D>],
    ) -> u64 {
        0
    }

    /// Filters the particle velocities before G2P.
    fn filter_velocities(&mut self, _: &dyn Kernel<D>, _: &Grid<D>, _: &mut Particles<D>) -> u64 {
        0
    }

    /// Returns the G2P request for the new particle velocities after `dt` (s). The moment or
    /// gradient of the request is the affine state that the transfer stores between steps.
    fn g2p_request(&mut self, dt: f64) -> G2pRequest<'_, D>;

    /// Returns the first moment of the velocity field around particle `p`, `C_p D_p` (m^2/s). The
    /// antisymmetric part of this moment is the internal angular momentum of the particle per unit
    /// mass. `None` if the particle has only a velocity.
    fn moment(&self, _p: usize) -> Option<Matrix<D>> {
        None
    }
}

/// Runs one P2G pass for the quantities of `request` that `stages` need.
pub(super) fn p2g<const D: usize>(
    request: P2gRequest<'_, D>,
    kernel: &dyn Kernel<D>,
    particles: &Particles<D>,
    grid: &mut Grid<D>,
    stages: &[Stage],
) -> u64 {
    let request = P2gRequest {
        mass: stages.contains(&Stage::Mass),
        momentum: request.momentum.filter(|_| stages.contains(&Stage::Momentum)),
        force: request.force.filter(|_| stages.contains(&Stage::Force)),
    };
    kernel.p2g(particles, &request, grid);
    request.parts().count() as u64
}

/// Performs G2P over `dt` (s) for `stages` in one pass. The pass computes new velocities, velocity
/// gradients in `particles.grad_v`, and positions after the step in `advected` (m).
///
/// Returns the number of passes. The pass for positions is counted later, when the particles move.
pub fn g2p<const D: usize>(
    transfer: &mut dyn Transfer<D>,
    kernel: &dyn Kernel<D>,
    grid: &Grid<D>,
    dt: f64,
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
    // The gradient of the transfer comes from the same velocities, so it is copied instead of
    // computed again.
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

/// Adds the grid accelerations over `dt` (s) to the velocities and affine states of the particles.
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
    // The column of velocity gradients is not used until the stress stage.
    let mut change = std::mem::take(&mut particles.grad_v);
    let mut passes = 1;
    let G2pRequest { moment, gradient, .. } = transfer.g2p_request(dt);
    let mut request = G2pRequest::default();
    let column = if moment.is_some() { &mut request.moment } else { &mut request.gradient };
    *column = Some(&mut change);
    if let Some(state) = moment.or(gradient) {
        kernel.g2p_field(grid, &grid.acceleration, particles, request);
        passes += 1;
        for (state, change) in state.iter_mut().zip(&change) {
            *state += change * dt;
        }
    }
    particles.grad_v = change;
    passes
}

//! Contract of a transfer with the rest of the solver.

use crate::mpm::boundary::Boundary;
use crate::mpm::foundation::algebra::{Matrix, Vector};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::Kernel;
use crate::mpm::kernel::request::{Divergence, G2pRequest, P2gRequest, ParticleField};
use crate::mpm::stage::Stage;
use crate::subject::Column;

/// Kind of a transfer, which decides the methods that it combines with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TransferKind {
    /// Particles carry a velocity.
    Velocity,
    /// Particles carry an affine velocity field.
    Field,
    /// As [`Field`](Self::Field), with gradients of its fit in place of those of the basis.
    Fit,
    /// A series in the lumped mass matrix.
    Series,
    /// Fields that are reconstructed in cells.
    Cells,
}

/// Parameter of a transfer, a whole number: its range and the words of messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TransferParameter {
    /// Least and greatest value.
    pub range: (u32, u32),
    /// Words before and after the value, as in `a series of 8 terms`.
    pub words: (&'static str, &'static str),
}

impl TransferParameter {
    /// Terms of a series, each of which takes two passes over the particles.
    pub(super) const TERMS: Self = Self { range: (1, 64), words: ("a series of", "terms") };
}

/// Exchange of velocities between particles and grid, by passes of a [`Kernel`]. Methods that pass
/// over the particles return how many passes the work counter counts: one for each part of a
/// request, not one for each visit to the nodes.
///
/// A transfer keeps the columns that only it needs.
pub trait Transfer<const D: usize>: Send + Sync {
    /// Kind of the transfer.
    fn kind(&self) -> TransferKind {
        TransferKind::Velocity
    }

    /// Prepares for these particles, whose `grad_v` holds the gradient of their initial velocity.
    fn start(&mut self, _: &dyn Kernel<D>, _: &Grid<D>, _: &Particles<D>) {}

    /// Columns for particles or nodes.
    fn columns(&self) -> Vec<Column<'_>> {
        Vec::new()
    }

    /// All parts of P2G. A divergence by fit goes with velocity gradients by fit.
    fn p2g_request<'a>(&'a self, particles: &'a Particles<D>) -> P2gRequest<'a, D> {
        let momentum = Some(ParticleField { v: &particles.v, affine: None });
        P2gRequest { mass: true, momentum, force: Some(Divergence::Gradient) }
    }

    /// P2G for `stages`, in one pass if the transfer can. Mass is among them in the first pass
    /// after particles have moved.
    fn p2g(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &mut Grid<D>,
        stages: &[Stage],
    ) -> u64 {
        p2g(self.p2g_request(particles), kernel, particles, grid, stages)
    }

    /// Improves a nodal field that the lumped mass matrix has solved for.
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

    /// Filters the velocities of particles before G2P.
    fn filter_velocities(&mut self, _: &dyn Kernel<D>, _: &Grid<D>, _: &mut Particles<D>) -> u64 {
        0
    }

    /// Parts of G2P that give particles their new velocities after `dt` (s). Its moment or gradient
    /// is the affine state that the transfer remembers from step to step.
    fn g2p_request(&mut self, dt: f64) -> G2pRequest<'_, D>;

    /// First moment of the velocity field around particle `p`, `C_p D_p` (m^2/s): per unit mass,
    /// its antisymmetric part is the particle's own share of the angular momentum. None where the
    /// particle carries its velocity only.
    fn moment(&self, _p: usize) -> Option<Matrix<D>> {
        None
    }
}

/// One pass of P2G: the parts of `request` that `stages` need.
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

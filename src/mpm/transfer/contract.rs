//! What a transfer is to the rest of the solver.

use super::wanted::{Recipe, Wanted};
use crate::{
    mpm::{
        algebra::{Matrix, Vector},
        boundary::Boundary,
        grid::Grid,
        kernel::{
            contract::Kernel,
            request::{Divergence, P2gRequest, ParticleField},
        },
        particles::Particles,
    },
    subject::{Checkpoint, Column},
};

/// What a transfer is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Particles carry a velocity.
    Velocity,
    /// They carry an affine velocity field.
    Field,
    /// They do, and gradients come from its fit rather than from the basis.
    Fit,
    /// A series in the lumped mass matrix.
    Series,
    /// Fields that are reconstructed in cells.
    Cells,
}

/// How particles give their velocity to nodes and take it back: stages made of the passes of a
/// [`Kernel`]. Each method returns how many passes over the particles it took, for the work
/// counter. A method that is not overridden does what the original MPM does.
///
/// A transfer keeps the columns that only it needs.
pub trait Transfer<const D: usize>: Send + Sync {
    /// What the transfer is made of, which decides what it goes with.
    fn kind(&self) -> Kind {
        Kind::Velocity
    }

    /// Prepares for these particles, whose `grad_v` holds the gradient of their initial velocity.
    fn start(&mut self, _: &dyn Kernel<D>, _: &Grid<D>, _: &Particles<D>) {}

    /// What the transfer keeps for particles or nodes.
    fn columns(&self) -> Vec<Column> {
        Vec::new()
    }

    /// Whether [`Transfer::g2p_velocity`] reads the grid's velocities, not its accelerations only.
    fn reads_grid_velocity(&self) -> bool;

    /// The velocity field that particles show to the nodes.
    fn shown<'a>(&'a self, particles: &'a Particles<D>) -> ParticleField<'a, D> {
        ParticleField { v: &particles.v, affine: None }
    }

    /// What makes a force of their stresses.
    fn divergence(&self) -> Divergence {
        Divergence::Gradient
    }

    /// Whether the field that particles show needs the moments of their weights. These count as a
    /// pass, once for each place that particles have: the work counter counts what a method asks
    /// for, not the visits to nodes in which that is done.
    fn needs_moments(&self) -> bool {
        false
    }

    /// P2G: what is `wanted`, in one visit to the nodes if the transfer can. Mass is wanted by the
    /// first pass after particles have moved.
    fn p2g(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &mut Grid<D>,
        wanted: Wanted,
    ) -> u64 {
        map(self, kernel, particles, grid, wanted)
    }

    /// P2G: the nodal masses alone.
    fn p2g_mass(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &mut Grid<D>,
    ) -> u64 {
        self.p2g(kernel, particles, grid, Wanted { mass: true, ..Wanted::default() })
    }

    /// P2G: the internal force (N) into `grid.force`, alone.
    fn p2g_internal_force(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &mut Grid<D>,
    ) -> u64 {
        self.p2g(kernel, particles, grid, Wanted { force: true, ..Wanted::default() })
    }

    /// P2G: the momentum (kg m/s) of each node into `momentum`.
    fn p2g_momentum(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &Grid<D>,
        momentum: &mut [Vector<D>],
    ) -> u64 {
        kernel.p2g_momentum(particles, self.shown(particles), grid, momentum);
        1
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

    /// G2P: new particle velocities after a step of `dt` (s).
    fn g2p_velocity(
        &mut self,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
        boundary: &[Box<dyn Boundary<D>>],
        dt: f64,
        particles: &mut Particles<D>,
    ) -> u64;

    /// How [`Transfer::g2p_velocity`] is done in the same visit as other things; None where it takes
    /// more than a visit.
    fn recipe(&self) -> Option<Recipe> {
        None
    }

    /// The first moments of velocity that a transfer with a recipe takes.
    fn moment_column(&mut self) -> Option<&mut [Matrix<D>]> {
        None
    }

    /// G2P: adds the grid's accelerations over `dt` (s) to the particles, with no other change of
    /// their velocities: how a run starts half a step back.
    fn kick(
        &mut self,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
        dt: f64,
        particles: &mut Particles<D>,
    ) -> u64 {
        add_acceleration(kernel, grid, dt, particles);
        1
    }

    /// Whether [`Transfer::g2p_gradient`] is that of the basis.
    fn takes_gradient_of_basis(&self) -> bool {
        true
    }

    /// G2P: `grad v_p` (1/s) into `particles.grad_v`.
    fn g2p_gradient(
        &mut self,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
        particles: &mut Particles<D>,
    ) -> u64 {
        let mut column = std::mem::take(&mut particles.grad_v);
        kernel.g2p_gradient(grid, &grid.velocity, particles, &mut column);
        particles.grad_v = column;
        1
    }

    /// What particles carry for this transfer from one step to the next, besides their velocity; empty
    /// if nothing.
    fn carried(&self) -> &[Matrix<D>] {
        &[]
    }

    /// The same, to be changed.
    fn carried_mut(&mut self) -> &mut [Matrix<D>] {
        &mut []
    }

    /// Shows what it remembers from step to step.
    fn checkpoint(&mut self, checkpoint: &mut Checkpoint<'_>) {
        checkpoint.visit(self.carried_mut());
    }

    /// A natural size of what is carried, where velocities are of the size `speed` (m/s) and cells of
    /// the size `h` (m).
    fn carried_size(&self, speed: f64, h: f64) -> f64 {
        speed * h
    }

    /// First moment of the velocity field around particle `p`, `C_p D_p` (m^2/s): per unit mass,
    /// its antisymmetric part is the particle's own share of the angular momentum. None where the
    /// particle carries its velocity only.
    fn moment(&self, _: usize) -> Option<Matrix<D>> {
        None
    }
}

/// Maps what is `wanted` in one pass.
pub(super) fn map<const D: usize>(
    transfer: &(impl Transfer<D> + ?Sized),
    kernel: &dyn Kernel<D>,
    particles: &Particles<D>,
    grid: &mut Grid<D>,
    wanted: Wanted,
) -> u64 {
    let maps = P2gRequest {
        mass: wanted.mass,
        momentum: wanted.momentum.then(|| transfer.shown(particles)),
        force: wanted.force.then(|| transfer.divergence()),
    };
    kernel.p2g(particles, &maps, grid);
    let moments = wanted.mass && wanted.momentum && transfer.needs_moments();
    [wanted.mass, wanted.momentum, wanted.force, moments].map(u64::from).iter().sum()
}

/// `v_p += dt sum_i a_i N_i(x_p)`.
pub(super) fn add_acceleration<const D: usize>(
    kernel: &dyn Kernel<D>,
    grid: &Grid<D>,
    dt: f64,
    particles: &mut Particles<D>,
) {
    let mut column = std::mem::take(&mut particles.v);
    kernel.g2p(grid, &grid.acceleration, particles, (1.0, dt), &mut column);
    particles.v = column;
}

/// `v_p <- keep v_p + factor sum_i v_i N_i(x_p)`.
pub(super) fn mix_velocity<const D: usize>(
    kernel: &dyn Kernel<D>,
    grid: &Grid<D>,
    factors: (f64, f64),
    particles: &mut Particles<D>,
) {
    let mut column = std::mem::take(&mut particles.v);
    kernel.g2p(grid, &grid.velocity, particles, factors, &mut column);
    particles.v = column;
}

//! Passes over particles and nodes, the building blocks of transfers, mass matrices and effects.
//!
//! [`Kernel`] is object-safe: one virtual call per pass, none per particle.

use super::request::{Divergence, G2pRequest, P2gRequest, ParticleField};
use super::scalar_contract::Scalars;
use super::tally::Tally;
use crate::mpm::basis::Domain;
use crate::mpm::foundation::algebra::{Matrix, Vector};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::moments::Moments;
use crate::mpm::foundation::particles::Particles;

/// Passes of P2G and G2P for one basis.
pub trait Kernel<const D: usize>: Scalars<D> + Send + Sync {
    /// All parts of `request`, from particles to nodes, in one pass.
    fn p2g(&self, particles: &Particles<D>, request: &P2gRequest<'_, D>, grid: &mut Grid<D>);

    /// All parts of `request`, from nodes to particles, in one pass.
    fn g2p_all(&self, grid: &Grid<D>, particles: &Particles<D>, request: G2pRequest<'_, D>);

    /// `m_i` alone, see [`P2gRequest::mass`].
    fn p2g_mass(&self, particles: &Particles<D>, grid: &mut Grid<D>) {
        self.p2g(particles, &P2gRequest { mass: true, ..P2gRequest::default() }, grid);
    }

    /// Momentum alone, see [`P2gRequest::momentum`], into `momentum`.
    fn p2g_momentum(
        &self,
        particles: &Particles<D>,
        shown: ParticleField<'_, D>,
        grid: &Grid<D>,
        momentum: &mut [Vector<D>],
    );

    /// The force of the gradients of the basis alone, see [`P2gRequest::force`].
    fn p2g_internal_force(&self, particles: &Particles<D>, grid: &mut Grid<D>) {
        let force = Some(Divergence::Gradient);
        self.p2g(particles, &P2gRequest { force, ..P2gRequest::default() }, grid);
    }

    /// Adds a force per unit mass (m/s2) of each particle, `sum_p m_p b_p N_i`, to `grid.force`.
    fn p2g_body_force(&self, particles: &Particles<D>, b: &[Vector<D>], grid: &mut Grid<D>);

    /// Adds `force` (N), which acts on particle `p`, to the forces of its nodes.
    fn p2g_point_force(
        &self,
        particles: &Particles<D>,
        p: usize,
        force: &Vector<D>,
        grid: &mut Grid<D>,
    );

    /// `value_p <- keep value_p + factor sum_i field_i N_i(x_p)`.
    fn g2p(
        &self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        particles: &Particles<D>,
        keep_and_factor: (f64, f64),
        value: &mut [Vector<D>],
    );

    /// `gradient_p = sum_i field_i (x) grad N_i(x_p)`.
    fn g2p_gradient(
        &self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        particles: &Particles<D>,
        gradient: &mut [Matrix<D>],
    );

    /// `moment_p = sum_i field_i (x) (x_i - mean_p) N_i(x_p)`.
    fn g2p_moment(
        &self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        particles: &Particles<D>,
        moment: &mut [Matrix<D>],
    );

    /// Moments of the weights of each particle.
    fn moments(&self, grid: &Grid<D>, particles: &Particles<D>, moments: &mut Moments<D>);

    /// Calls `entry` with i, j and `m_p N_i(x_p) N_j(x_p)` (kg) for every particle and every pair
    /// of its nodes: the consistent mass matrix.
    fn mass_entries(
        &self,
        grid: &Grid<D>,
        particles: &Particles<D>,
        entry: &mut dyn FnMut(usize, usize, f64),
    );

    /// Adds the forces of a moment, `moment grad N_i(x_p)`, to the nodes of particle `p`. Their sum
    /// is zero: `moment = f (x) d` (N m) moves the force f from the particle by d (m).
    fn p2g_point_moment(
        &self,
        particles: &Particles<D>,
        p: usize,
        moment: &Matrix<D>,
        grid: &mut Grid<D>,
    );

    /// `sum_p m_p grad N_i(x_p)` (kg/m) into `gradient`: points out of the body where its mass
    /// ends.
    fn p2g_mass_gradient(
        &self,
        particles: &Particles<D>,
        grid: &Grid<D>,
        gradient: &mut [Vector<D>],
    );

    /// Visits of particles by the passes.
    fn tally(&self) -> &Tally;

    /// Largest number of nodes of a particle.
    fn support(&self) -> u64;

    /// Kind of particle domain that the basis needs.
    fn domain(&self) -> Domain;

    /// An empty grid with the functions of this basis.
    fn grid(&self, origin: Vector<D>, h: f64, cells: [usize; D], periodic: [bool; D]) -> Grid<D>;
}

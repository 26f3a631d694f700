//! The passes over particles and nodes of which transfers, mass matrices and effects are made.
//!
//! [`Kernel`] is object-safe: one virtual call per pass, none per particle. A pass computes the weights
//! of a particle anew, so what is wanted of the same particles and nodes is best asked for in one:
//! [`P2gRequest`] and [`G2pRequest`] say what, and each part has the bits that it would have alone.

use super::{moments::Moments, scalar_contract::Scalars};
use crate::mpm::{
    algebra::{Matrix, Vector},
    basis::Domain,
    grid::Grid,
    particles::Particles,
};

/// The slope of the velocity field around each particle. `mean_p`, the weighted mean of the nodes, is
/// where the particle is, but for domains that a wall cuts off; taken from there, the affine part
/// carries no momentum.
#[derive(Debug, Clone, Copy)]
pub enum Affine<'a, const D: usize> {
    /// `C_p` (1/s).
    Slope(&'a [Matrix<D>]),
    /// `C_p = B_p D_p^-1` by the first moment B_p (m^2/s); D_p is that of the weights where the
    /// particle is.
    Moment(&'a [Matrix<D>]),
}

/// A velocity field around each particle, `v_p + C_p (x - mean_p)`, as the particle shows it to
/// the nodes it sees.
#[derive(Debug, Clone, Copy)]
pub struct ParticleField<'a, const D: usize> {
    /// v_p (m/s).
    pub v: &'a [Vector<D>],
    /// C_p, if the field is not constant.
    pub affine: Option<Affine<'a, D>>,
}

/// What makes a force of a stress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Divergence {
    /// `f_int_i = - sum_p V_p sigma_p grad N_i(x_p)` (N).
    Gradient,
    /// `f_int_i = - sum_p V_p sigma_p D_p^-1 (x_i - mean_p) N_i(x_p)` (N): the gradient of a
    /// least-squares fit in place of that of the basis (Hu et al. 2018, eq. 18).
    Fit,
}

/// What is mapped to the nodes in one pass.
#[derive(Debug, Clone, Copy, Default)]
pub struct P2gRequest<'a, const D: usize> {
    /// `m_i = sum_p m_p N_i(x_p)` (kg) into `grid.mass`.
    pub mass: bool,
    /// Momentum `sum_p m_p (v_p + C_p (x_i - mean_p)) N_i(x_p)` (kg m/s) into `grid.velocity`.
    pub momentum: Option<ParticleField<'a, D>>,
    /// Internal force (N) into `grid.force`.
    pub force: Option<Divergence>,
}

/// What is taken from the nodes in one pass, from their velocities where nothing else is said.
#[derive(Debug, Default)]
pub struct G2pRequest<'a, const D: usize> {
    /// `value_p += dt sum_i a_i N_i(x_p)` with `dt`, of the nodes' accelerations.
    pub change: Option<f64>,
    /// Then `value_p <- keep value_p + factor sum_i v_i N_i(x_p)` with `keep` and `factor`.
    pub mix: Option<(f64, f64)>,
    /// The value that `change` and `mix` are about (m/s).
    pub value: Option<&'a mut [Vector<D>]>,
    /// `moment_p = sum_i v_i (x) (x_i - mean_p) N_i(x_p)` (m^2/s).
    pub moment: Option<&'a mut [Matrix<D>]>,
    /// `gradient_p = sum_i v_i (x) grad N_i(x_p)` (1/s).
    pub gradient: Option<&'a mut [Matrix<D>]>,
    /// `carried_p = x_p + dt sum_i v_i N_i(x_p)` with `dt`: where the grid carries the particle (m).
    pub carried: Option<(f64, &'a mut [Vector<D>])>,
}

/// Passes of P2G and G2P for one basis.
pub trait Kernel<const D: usize>: Scalars<D> + Send + Sync {
    /// Maps what `maps` says to the nodes.
    fn p2g(&self, particles: &Particles<D>, maps: &P2gRequest<'_, D>, grid: &mut Grid<D>);

    /// Takes what `takes` says from the nodes.
    fn g2p_all(&self, grid: &Grid<D>, particles: &Particles<D>, takes: G2pRequest<'_, D>);

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

    /// Adds `force` (N), which acts on particle `p`, to the nodes that the particle sees.
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

    /// Where the nodes lie that each particle sees.
    fn moments(&self, grid: &Grid<D>, particles: &Particles<D>, moments: &mut Moments<D>);

    /// `matrix_p <- matrix_p D_p^-1`.
    fn divide_by_inertia(
        &self,
        grid: &Grid<D>,
        particles: &Particles<D>,
        matrices: &mut [Matrix<D>],
    );

    /// Calls `entry` with i, j and `m_p N_i(x_p) N_j(x_p)` (kg) for every particle and every pair
    /// of nodes that it sees: the consistent mass matrix.
    fn mass_entries(
        &self,
        grid: &Grid<D>,
        particles: &Particles<D>,
        entry: &mut dyn FnMut(usize, usize, f64),
    );

    /// Adds to the nodes that particle `p` sees the forces of a moment, `moment grad N_i(x_p)`, whose
    /// sum is zero: `moment = f (x) d` (N m) takes the force f from the particle to the place d (m) away.
    fn p2g_point_moment(
        &self,
        particles: &Particles<D>,
        p: usize,
        moment: &Matrix<D>,
        grid: &mut Grid<D>,
    );

    /// `sum_p m_p grad N_i(x_p)` (kg/m) into `gradient`: points out of the body where its mass ends.
    fn p2g_mass_gradient(
        &self,
        particles: &Particles<D>,
        grid: &Grid<D>,
        gradient: &mut [Vector<D>],
    );

    /// Nodes that one particle sees, at most.
    fn support(&self) -> u64;

    /// What the basis must know of a particle.
    fn domain(&self) -> Domain;

    /// An empty grid with the functions of this basis.
    fn grid(&self, origin: Vector<D>, h: f64, cells: [usize; D], periodic: [bool; D]) -> Grid<D>;
}

//! The passes over particles and nodes of which transfers, mass matrices and effects are made.
//!
//! [`Kernel`] is object-safe: one virtual call per pass, none per particle.

use super::{
    algebra::{Matrix, Vector},
    basis::Domain,
    grid::Grid,
    moments::Moments,
    particles::Particles,
    scalars::Scalars,
};

/// A velocity field around each particle, `v_p + C_p (x - mean_p)`, as the particle shows it to
/// the nodes it sees. `mean_p`, the weighted mean of the nodes, is where the particle is, but for
/// domains that a wall cuts off; taken from there, the affine part carries no momentum.
#[derive(Debug, Clone, Copy)]
pub struct Shown<'a, const D: usize> {
    /// v_p (m/s).
    pub v: &'a [Vector<D>],
    /// C_p (1/s) with the moments of the nodes, if the field is not constant.
    pub affine: Option<(&'a [Matrix<D>], &'a Moments<D>)>,
}

/// Passes of P2G and G2P for one basis.
pub trait Kernel<const D: usize>: Scalars<D> + Send + Sync {
    /// `m_i = sum_p m_p N_i(x_p)` (kg) into `grid.mass`.
    fn p2g_mass(&self, particles: &Particles<D>, grid: &mut Grid<D>);

    /// Momentum `sum_p m_p (v_p + C_p (x_i - mean_p)) N_i(x_p)` (kg m/s) into `momentum`.
    fn p2g_momentum(
        &self,
        particles: &Particles<D>,
        shown: Shown<'_, D>,
        grid: &Grid<D>,
        momentum: &mut [Vector<D>],
    );

    /// `f_int_i = - sum_p V_p sigma_p grad N_i(x_p)` (N) into `grid.force`.
    fn p2g_internal_force(&self, particles: &Particles<D>, grid: &mut Grid<D>);

    /// `f_int_i = - sum_p V_p sigma_p D_p^-1 (x_i - mean_p) N_i(x_p)` (N) into `grid.force`: the
    /// gradient of a least-squares fit in place of that of the basis (Hu et al. 2018, eq. 18).
    fn p2g_affine_force(&self, particles: &Particles<D>, moments: &Moments<D>, grid: &mut Grid<D>);

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

    /// `moment_p <- keep moment_p + factor sum_i field_i (x) (x_i - mean_p) N_i(x_p)`.
    fn g2p_moment(
        &self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        seen: (&Particles<D>, &Moments<D>),
        keep_and_factor: (f64, f64),
        moment: &mut [Matrix<D>],
    );

    /// Where the nodes lie that each particle sees.
    fn moments(&self, grid: &Grid<D>, particles: &Particles<D>, moments: &mut Moments<D>);

    /// Calls `entry` with i, j and `m_p N_i(x_p) N_j(x_p)` (kg) for every particle and every pair
    /// of nodes that it sees: the consistent mass matrix.
    fn mass_entries(
        &self,
        grid: &Grid<D>,
        particles: &Particles<D>,
        entry: &mut dyn FnMut(usize, usize, f64),
    );

    /// `x_p += dt sum_i v_i N_i(x_p)`.
    fn g2p_position(&self, grid: &Grid<D>, dt: f64, particles: &mut Particles<D>);

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

//! The particle-node loops, one per stage: the only place where basis and transfer meet.
//!
//! [`Kernel`] is object-safe: one virtual call per stage, none per particle. Sums run over
//! particles in their order and over nodes in theirs, so results are the same bits everywhere.

use super::{
    algebra::{Vector, dyad},
    basis::Basis,
    grid::Grid,
    particles::Particles,
    transfer::Transfer,
};
use std::marker::PhantomData;

/// P2G and G2P for one basis and one transfer.
pub trait Kernel<const D: usize>: Send + Sync {
    /// `m_i = sum_p m_p N_i(x_p)` (kg).
    fn p2g_mass(&self, particles: &Particles<D>, grid: &mut Grid<D>);

    /// Momentum `sum_p m_p v_p N_i(x_p)` (kg m/s) into `grid.velocity`.
    fn p2g_momentum(&self, particles: &Particles<D>, grid: &mut Grid<D>);

    /// `f_int_i = - sum_p V_p sigma_p grad N_i(x_p)` (N) into `grid.force`.
    fn p2g_internal_force(&self, particles: &Particles<D>, grid: &mut Grid<D>);

    /// Adds `force` (N), which acts at `x`, to the nodes that `x` sees.
    fn p2g_point_force(&self, x: &Vector<D>, force: &Vector<D>, grid: &mut Grid<D>);

    /// New particle velocities from the grid's accelerations over `dt` (s).
    fn g2p_velocity(&self, grid: &Grid<D>, dt: f64, particles: &mut Particles<D>);

    /// `grad v_p = sum_i v_i (x) grad N_i(x_p)` (1/s).
    fn g2p_gradient(&self, grid: &Grid<D>, particles: &mut Particles<D>);

    /// `x_p += dt sum_i v_i N_i(x_p)`.
    fn g2p_position(&self, grid: &Grid<D>, dt: f64, particles: &mut Particles<D>);

    /// Nodes that one particle sees.
    fn support(&self) -> u64;
}

/// The kernel of basis `B` with transfer `T`.
#[derive(Debug, Clone, Copy, Default)]
pub struct Pair<B, T>(PhantomData<(B, T)>);

impl<B, T> Pair<B, T> {
    /// The (stateless) kernel.
    pub fn new() -> Self {
        Self(PhantomData)
    }
}

impl<const D: usize, B: Basis, T: Transfer> Kernel<D> for Pair<B, T> {
    fn p2g_mass(&self, particles: &Particles<D>, grid: &mut Grid<D>) {
        let mut column = std::mem::take(&mut grid.mass);
        column.fill(0.0);
        for (x, m) in particles.x.iter().zip(&particles.mass) {
            B::visit(grid, x, |i, n, _| column[i] += m * n);
        }
        grid.mass = column;
    }

    fn p2g_momentum(&self, particles: &Particles<D>, grid: &mut Grid<D>) {
        let mut column = std::mem::take(&mut grid.velocity);
        column.fill(Vector::zeros());
        for ((x, m), v) in particles.x.iter().zip(&particles.mass).zip(&particles.v) {
            let momentum = T::shown(v) * *m;
            B::visit(grid, x, |i, n, _| column[i] += momentum * n);
        }
        grid.velocity = column;
    }

    fn p2g_internal_force(&self, particles: &Particles<D>, grid: &mut Grid<D>) {
        let mut column = std::mem::take(&mut grid.force);
        column.fill(Vector::zeros());
        for ((x, vol), sigma) in particles.x.iter().zip(&particles.vol).zip(&particles.sigma) {
            let flux = sigma * *vol;
            B::visit(grid, x, |i, _, grad| column[i] -= flux * grad);
        }
        grid.force = column;
    }

    fn p2g_point_force(&self, x: &Vector<D>, force: &Vector<D>, grid: &mut Grid<D>) {
        let mut column = std::mem::take(&mut grid.force);
        B::visit(grid, x, |i, n, _| column[i] += force * n);
        grid.force = column;
    }

    fn g2p_velocity(&self, grid: &Grid<D>, dt: f64, particles: &mut Particles<D>) {
        for (x, v) in particles.x.iter().zip(&mut particles.v) {
            let mut a = Vector::zeros();
            B::visit(grid, x, |i, n, _| a += grid.acceleration[i] * n);
            *v = T::taken(v, &(a * dt));
        }
    }

    fn g2p_gradient(&self, grid: &Grid<D>, particles: &mut Particles<D>) {
        for (x, grad_v) in particles.x.iter().zip(&mut particles.grad_v) {
            grad_v.fill(0.0);
            B::visit(grid, x, |i, _, grad| *grad_v += dyad(&grid.velocity[i], grad));
        }
    }

    fn g2p_position(&self, grid: &Grid<D>, dt: f64, particles: &mut Particles<D>) {
        for x in &mut particles.x {
            let mut v = Vector::zeros();
            B::visit(grid, x, |i, n, _| v += grid.velocity[i] * n);
            *x += v * dt;
        }
    }

    fn support(&self) -> u64 {
        B::support(D)
    }
}

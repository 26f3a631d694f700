//! The particle-node loops, one per stage: the only place where basis and transfer meet.
//!
//! [`Kernel`] is object-safe: one virtual call per stage, none per particle. Sums run over
//! particles in their order and over nodes in theirs, so results are the same bits everywhere.

use super::{
    algebra::{Vector, dyad},
    basis::{Basis, Domain, Seen},
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

    /// Adds `force` (N), which acts on particle `p`, to the nodes that the particle sees.
    fn p2g_point_force(
        &self,
        particles: &Particles<D>,
        p: usize,
        force: &Vector<D>,
        grid: &mut Grid<D>,
    );

    /// New particle velocities from the grid's accelerations over `dt` (s).
    fn g2p_velocity(&self, grid: &Grid<D>, dt: f64, particles: &mut Particles<D>);

    /// `grad v_p = sum_i v_i (x) grad N_i(x_p)` (1/s).
    fn g2p_gradient(&self, grid: &Grid<D>, particles: &mut Particles<D>);

    /// `x_p += dt sum_i v_i N_i(x_p)`.
    fn g2p_position(&self, grid: &Grid<D>, dt: f64, particles: &mut Particles<D>);

    /// Nodes that one particle sees, at most.
    fn support(&self) -> u64;

    /// What the basis must know of a particle.
    fn domain(&self) -> Domain;

    /// An empty grid with the functions of this basis.
    fn grid(&self, origin: Vector<D>, h: f64, cells: [usize; D], periodic: [bool; D]) -> Grid<D>;
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
        for (p, m) in particles.mass.iter().enumerate() {
            B::visit(grid, particles, p, |i| column[i.node] += m * i.weight);
        }
        grid.mass = column;
    }

    fn p2g_momentum(&self, particles: &Particles<D>, grid: &mut Grid<D>) {
        let mut column = std::mem::take(&mut grid.velocity);
        column.fill(Vector::zeros());
        for (p, (m, v)) in particles.mass.iter().zip(&particles.v).enumerate() {
            let momentum = T::shown(v) * *m;
            B::visit(grid, particles, p, |i| column[i.node] += momentum * i.weight);
        }
        grid.velocity = column;
    }

    fn p2g_internal_force(&self, particles: &Particles<D>, grid: &mut Grid<D>) {
        let mut column = std::mem::take(&mut grid.force);
        column.fill(Vector::zeros());
        for (p, (vol, sigma)) in particles.vol.iter().zip(&particles.sigma).enumerate() {
            let flux = sigma * *vol;
            B::visit(grid, particles, p, |i| column[i.node] -= flux * i.gradient);
        }
        grid.force = column;
    }

    fn p2g_point_force(
        &self,
        particles: &Particles<D>,
        p: usize,
        force: &Vector<D>,
        grid: &mut Grid<D>,
    ) {
        let mut column = std::mem::take(&mut grid.force);
        B::visit(grid, particles, p, |i| column[i.node] += force * i.weight);
        grid.force = column;
    }

    fn g2p_velocity(&self, grid: &Grid<D>, dt: f64, particles: &mut Particles<D>) {
        let mut column = std::mem::take(&mut particles.v);
        for (p, v) in column.iter_mut().enumerate() {
            let mut a = Vector::zeros();
            B::visit(grid, particles, p, |i| a += grid.acceleration[i.node] * i.weight);
            *v = T::taken(v, &(a * dt));
        }
        particles.v = column;
    }

    fn g2p_gradient(&self, grid: &Grid<D>, particles: &mut Particles<D>) {
        let mut column = std::mem::take(&mut particles.grad_v);
        for (p, grad_v) in column.iter_mut().enumerate() {
            grad_v.fill(0.0);
            let mut add = |i: Seen<'_, D>| *grad_v += dyad(&grid.velocity[i.node], i.gradient);
            B::visit(grid, particles, p, &mut add);
        }
        particles.grad_v = column;
    }

    fn g2p_position(&self, grid: &Grid<D>, dt: f64, particles: &mut Particles<D>) {
        for p in 0..particles.len() {
            let mut v = Vector::zeros();
            B::visit(grid, particles, p, |i| v += grid.velocity[i.node] * i.weight);
            particles.x[p] += v * dt;
        }
    }

    fn support(&self) -> u64 {
        B::support(D)
    }

    fn domain(&self) -> Domain {
        B::DOMAIN
    }

    fn grid(&self, origin: Vector<D>, h: f64, cells: [usize; D], periodic: [bool; D]) -> Grid<D> {
        let counts = std::array::from_fn(|axis| B::count(cells[axis], periodic[axis]));
        Grid::new(origin, h, cells, periodic, counts)
    }
}

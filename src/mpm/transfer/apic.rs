//! APIC: the particle carries an affine velocity field.
//!
//! `v_p = sum_i v_i N_i`, `B_p = sum_i v_i (x) (x_i - x_p) N_i`, and it shows the nodes
//! `v_p + B_p D_p^-1 (x_i - x_p)` (Jiang, Schroeder, Selle, Teran & Stomakhin 2015, eqs 8-10;
//! Jiang, Schroeder & Teran 2017 prove that angular momentum is exact). B is carried, and D is
//! that of the new position: on the linear basis, whose D changes within a cell, carrying
//! C = B D^-1 would lose angular momentum.

use super::contract::{Kind, Transfer, add_acceleration, mix_velocity};
use crate::{
    mpm::{
        algebra::{Matrix, Vector},
        boundary::Boundary,
        grid::Grid,
        kernel::{Kernel, Shown},
        moments::Moments,
        particles::Particles,
    },
    subject::Column,
};

/// Affine particle in cell.
#[derive(Debug, Clone, Default)]
pub struct Apic<const D: usize> {
    /// B_p (m^2/s).
    b: Vec<Matrix<D>>,
    /// C_p (1/s).
    c: Vec<Matrix<D>>,
    /// D_p and its inverse.
    pub(super) moments: Moments<D>,
}

impl<const D: usize> Transfer<D> for Apic<D> {
    fn kind(&self) -> Kind {
        Kind::Field
    }

    fn start(&mut self, kernel: &dyn Kernel<D>, grid: &Grid<D>, particles: &Particles<D>) {
        self.moments.resize(particles.len());
        kernel.moments(grid, particles, &mut self.moments);
        let gradients = particles.grad_v.iter().zip(&self.moments.second);
        self.b = gradients.map(|(grad_v, second)| grad_v * second).collect();
        self.c.resize(particles.len(), Matrix::zeros());
    }

    fn columns(&self) -> Vec<Column> {
        let own = [Column::of_particles("B", &self.b), Column::of_particles("C", &self.c)];
        own.into_iter().chain(self.moments.columns()).collect()
    }

    fn reads_grid_velocity(&self) -> bool {
        true
    }

    fn p2g_mass(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &mut Grid<D>,
    ) -> u64 {
        kernel.p2g_mass(particles, grid);
        kernel.moments(grid, particles, &mut self.moments);
        2
    }

    fn p2g_momentum(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &Grid<D>,
        momentum: &mut [Vector<D>],
    ) -> u64 {
        for ((c, b), inverse) in self.c.iter_mut().zip(&self.b).zip(&self.moments.inverse) {
            *c = b * inverse;
        }
        let shown = Shown { v: &particles.v, affine: Some((&self.c, &self.moments)) };
        kernel.p2g_momentum(particles, shown, grid, momentum);
        1
    }

    fn g2p_velocity(
        &mut self,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
        _: &[Box<dyn Boundary<D>>],
        _: f64,
        particles: &mut Particles<D>,
    ) -> u64 {
        mix_velocity(kernel, grid, (0.0, 1.0), particles);
        let seen = (&*particles, &self.moments);
        kernel.g2p_moment(grid, &grid.velocity, seen, (0.0, 1.0), &mut self.b);
        2
    }

    fn kick(
        &mut self,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
        dt: f64,
        particles: &mut Particles<D>,
    ) -> u64 {
        add_acceleration(kernel, grid, dt, particles);
        let seen = (&*particles, &self.moments);
        kernel.g2p_moment(grid, &grid.acceleration, seen, (1.0, dt), &mut self.b);
        2
    }

    fn carried(&self) -> &[Matrix<D>] {
        &self.b
    }

    fn carried_mut(&mut self) -> &mut [Matrix<D>] {
        &mut self.b
    }

    fn moment(&self, p: usize) -> Option<Matrix<D>> {
        self.b.get(p).copied()
    }
}

//! TPIC: PIC with the first terms of a Taylor series.
//!
//! `v_p = sum_i v_i N_i`, `C_p = sum_i v_i (x) grad N_i`, and the particle shows the nodes
//! `v_p + C_p (x_i - x_p)` (Nakamura, Matsumura & Mizutani 2023, CMAME 411). No inertia tensor is
//! inverted; angular momentum is not exact, as the gradient of the basis is no moment.

use super::{
    contract::{Kind, Transfer, add_acceleration, map, mix_velocity},
    wanted::Wanted,
};
use crate::{
    mpm::{
        algebra::Matrix,
        boundary::Boundary,
        grid::Grid,
        kernel::{
            contract::Kernel,
            moments::Moments,
            request::{Affine, ParticleField},
        },
        particles::Particles,
    },
    subject::Column,
};

/// Taylor particle in cell.
#[derive(Debug, Clone, Default)]
pub struct Tpic<const D: usize> {
    /// C_p (1/s).
    c: Vec<Matrix<D>>,
    moments: Moments<D>,
}

impl<const D: usize> Transfer<D> for Tpic<D> {
    fn kind(&self) -> Kind {
        Kind::Field
    }

    fn start(&mut self, kernel: &dyn Kernel<D>, grid: &Grid<D>, particles: &Particles<D>) {
        self.moments.resize(particles.len());
        kernel.moments(grid, particles, &mut self.moments);
        self.c.clone_from(&particles.grad_v);
    }

    fn columns(&self) -> Vec<Column> {
        let own = [Column::of_particles("C", &self.c)];
        own.into_iter().chain(self.moments.columns()).collect()
    }

    fn reads_grid_velocity(&self) -> bool {
        true
    }

    fn shown<'a>(&'a self, particles: &'a Particles<D>) -> ParticleField<'a, D> {
        ParticleField { v: &particles.v, affine: Some(Affine::Slope(&self.c)) }
    }

    fn p2g(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &mut Grid<D>,
        wanted: Wanted,
    ) -> u64 {
        if wanted.mass {
            kernel.moments(grid, particles, &mut self.moments);
        }
        u64::from(wanted.mass) + map(self, kernel, particles, grid, wanted)
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
        kernel.g2p_gradient(grid, &grid.velocity, particles, &mut self.c);
        2
    }

    /// The gradient of the accelerations is what velocity gradients change by.
    fn kick(
        &mut self,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
        dt: f64,
        particles: &mut Particles<D>,
    ) -> u64 {
        add_acceleration(kernel, grid, dt, particles);
        // The column of the material is free until its stage comes.
        let mut change = std::mem::take(&mut particles.grad_v);
        kernel.g2p_gradient(grid, &grid.acceleration, particles, &mut change);
        for (c, change) in self.c.iter_mut().zip(&change) {
            *c += change * dt;
        }
        particles.grad_v = change;
        2
    }

    fn carried(&self) -> &[Matrix<D>] {
        &self.c
    }

    fn carried_mut(&mut self) -> &mut [Matrix<D>] {
        &mut self.c
    }

    /// C is a gradient.
    fn carried_size(&self, speed: f64, h: f64) -> f64 {
        speed / h
    }

    fn moment(&self, p: usize) -> Option<Matrix<D>> {
        Some(self.c.get(p)? * self.moments.second.get(p)?)
    }
}

//! APIC: the particle carries an affine velocity field.
//!
//! `v_p = sum_i v_i N_i`, `B_p = sum_i v_i (x) (x_i - x_p) N_i`, and it shows the nodes
//! `v_p + B_p D_p^-1 (x_i - x_p)` (Jiang, Schroeder, Selle, Teran & Stomakhin 2015, eqs 8-10;
//! Jiang, Schroeder & Teran 2017 prove that angular momentum is exact). B is carried, and D is
//! that of the new position: on the linear basis, whose D changes within a cell, carrying
//! C = B D^-1 would lose angular momentum.

use super::{
    contract::{Kind, Transfer, add_acceleration, mix_velocity},
    wanted::Recipe,
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

/// Affine particle in cell.
#[derive(Debug, Clone, Default)]
pub struct Apic<const D: usize> {
    /// B_p (m^2/s).
    b: Vec<Matrix<D>>,
}

impl<const D: usize> Transfer<D> for Apic<D> {
    fn kind(&self) -> Kind {
        Kind::Field
    }

    fn start(&mut self, kernel: &dyn Kernel<D>, grid: &Grid<D>, particles: &Particles<D>) {
        let mut moments = Moments::default();
        moments.resize(particles.len());
        kernel.moments(grid, particles, &mut moments);
        let gradients = particles.grad_v.iter().zip(&moments.second);
        self.b = gradients.map(|(grad_v, second)| grad_v * second).collect();
    }

    fn columns(&self) -> Vec<Column> {
        vec![Column::of_particles("B", &self.b)]
    }

    fn reads_grid_velocity(&self) -> bool {
        true
    }

    fn shown<'a>(&'a self, particles: &'a Particles<D>) -> ParticleField<'a, D> {
        ParticleField { v: &particles.v, affine: Some(Affine::Moment(&self.b)) }
    }

    fn needs_moments(&self) -> bool {
        true
    }

    fn recipe(&self) -> Option<Recipe> {
        Some(Recipe { change: false, mix: Some((0.0, 1.0)) })
    }

    fn moment_column(&mut self) -> Option<&mut [Matrix<D>]> {
        Some(&mut self.b)
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
        kernel.g2p_moment(grid, &grid.velocity, particles, &mut self.b);
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
        // The column of the material is free until its stage comes.
        let mut change = std::mem::take(&mut particles.grad_v);
        kernel.g2p_moment(grid, &grid.acceleration, particles, &mut change);
        for (b, change) in self.b.iter_mut().zip(&change) {
            *b += change * dt;
        }
        particles.grad_v = change;
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

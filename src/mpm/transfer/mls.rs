//! MLS-MPM: APIC whose gradients come from the same least-squares fit as its affine field.
//!
//! `f_int_i = - sum_p V_p sigma_p D_p^-1 (x_i - x_p) N_i` and `grad v_p = C_p = B_p D_p^-1` (Hu et
//! al. 2018, eqs 17-18): grad N_i is never asked for.

use super::{
    apic::Apic,
    contract::{Kind, Transfer},
};
use crate::{
    mpm::{
        algebra::Matrix,
        boundary::Boundary,
        grid::Grid,
        kernel::{
            contract::Kernel,
            request::{Divergence, ParticleField},
        },
        particles::Particles,
    },
    subject::Column,
};

/// Moving least squares MPM.
#[derive(Debug, Clone, Default)]
pub struct Mls<const D: usize> {
    apic: Apic<D>,
}

impl<const D: usize> Transfer<D> for Mls<D> {
    fn kind(&self) -> Kind {
        Kind::Fit
    }

    fn start(&mut self, kernel: &dyn Kernel<D>, grid: &Grid<D>, particles: &Particles<D>) {
        self.apic.start(kernel, grid, particles);
    }

    fn columns(&self) -> Vec<Column> {
        self.apic.columns()
    }

    fn reads_grid_velocity(&self) -> bool {
        true
    }

    fn shown<'a>(&'a self, particles: &'a Particles<D>) -> ParticleField<'a, D> {
        self.apic.shown(particles)
    }

    fn divergence(&self) -> Divergence {
        Divergence::Fit
    }

    fn needs_moments(&self) -> bool {
        true
    }

    fn g2p_velocity(
        &mut self,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
        boundary: &[Box<dyn Boundary<D>>],
        dt: f64,
        particles: &mut Particles<D>,
    ) -> u64 {
        self.apic.g2p_velocity(kernel, grid, boundary, dt, particles)
    }

    fn kick(
        &mut self,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
        dt: f64,
        particles: &mut Particles<D>,
    ) -> u64 {
        self.apic.kick(kernel, grid, dt, particles)
    }

    fn takes_gradient_of_basis(&self) -> bool {
        false
    }

    fn g2p_gradient(
        &mut self,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
        particles: &mut Particles<D>,
    ) -> u64 {
        let mut column = std::mem::take(&mut particles.grad_v);
        kernel.g2p_moment(grid, &grid.velocity, particles, &mut column);
        kernel.divide_by_inertia(grid, particles, &mut column);
        particles.grad_v = column;
        1
    }

    fn carried(&self) -> &[Matrix<D>] {
        self.apic.carried()
    }

    fn carried_mut(&mut self) -> &mut [Matrix<D>] {
        self.apic.carried_mut()
    }

    fn moment(&self, p: usize) -> Option<Matrix<D>> {
        self.apic.moment(p)
    }
}

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
        algebra::{Matrix, Vector},
        boundary::Boundary,
        grid::Grid,
        kernel::Kernel,
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

    fn p2g_mass(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &mut Grid<D>,
    ) -> u64 {
        self.apic.p2g_mass(kernel, particles, grid)
    }

    fn p2g_momentum(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &Grid<D>,
        momentum: &mut [Vector<D>],
    ) -> u64 {
        self.apic.p2g_momentum(kernel, particles, grid, momentum)
    }

    fn p2g_internal_force(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &mut Grid<D>,
    ) -> u64 {
        kernel.p2g_affine_force(particles, &self.apic.moments, grid);
        1
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

    fn g2p_gradient(
        &mut self,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
        particles: &mut Particles<D>,
    ) -> u64 {
        let mut column = std::mem::take(&mut particles.grad_v);
        let moments = &self.apic.moments;
        kernel.g2p_moment(grid, &grid.velocity, (particles, moments), (0.0, 1.0), &mut column);
        for (grad_v, inverse) in column.iter_mut().zip(&moments.inverse) {
            *grad_v *= inverse;
        }
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

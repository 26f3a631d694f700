//! TPIC: PIC with the first terms of a Taylor series.
//!
//! `v_p = sum_i v_i N_i`, `C_p = sum_i v_i (x) grad N_i`, and nodes receive `v_p + C_p (x_i - x_p)`
//! (Nakamura, Matsumura & Mizutani 2023, CMAME 411). Unlike in APIC, no inertia tensor is inverted.
//! Angular momentum is not conserved exactly, because the gradient of the basis is not a moment.

use super::contract::{Transfer, TransferKind, p2g};
use crate::mpm::foundation::algebra::Matrix;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::moments::Moments;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::{
    Affine, Divergence, G2pRequest, Kernel, P2gRequest, ParticleField,
};
use crate::mpm::scheme::Stage;
use mpm_subject::Column;

/// Taylor particle in cell (TPIC).
#[derive(Debug, Clone, Default)]
pub struct Tpic<const D: usize> {
    /// Velocity gradients C_p (1/s).
    c: Vec<Matrix<D>>,
    moments: Moments<D>,
}

impl<const D: usize> Transfer<D> for Tpic<D> {
    fn kind(&self) -> TransferKind {
        TransferKind::Field
    }

    fn start(&mut self, kernel: &dyn Kernel<D>, grid: &Grid<D>, particles: &Particles<D>) {
        self.moments.resize(particles.len());
        kernel.moments(grid, particles, &mut self.moments);
        self.c.clone_from(&particles.grad_v);
    }

    fn columns(&self) -> Vec<Column<'_>> {
        let own = [Column::of_particles("C", &self.c)];
        own.into_iter().chain(self.moments.columns()).collect()
    }

    fn p2g_request<'a>(&'a self, particles: &'a Particles<D>) -> P2gRequest<'a, D> {
        let affine = Some(Affine::Slope(&self.c));
        let momentum = Some(ParticleField { v: &particles.v, affine });
        P2gRequest { mass: true, momentum, force: Some(Divergence::Gradient) }
    }

    fn p2g(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &mut Grid<D>,
        stages: &[Stage],
    ) -> u64 {
        let has_moved = stages.contains(&Stage::Mass);
        if has_moved {
            kernel.moments(grid, particles, &mut self.moments);
        }
        let request = self.p2g_request(particles);
        u64::from(has_moved) + p2g(request, kernel, particles, grid, stages)
    }

    fn g2p_request(&mut self, _: f64) -> G2pRequest<'_, D> {
        let (mix, gradient) = (Some((0.0, 1.0)), Some(&mut *self.c));
        G2pRequest { mix, gradient, ..G2pRequest::default() }
    }

    fn moment(&self, p: usize) -> Option<Matrix<D>> {
        Some(self.c.get(p)? * self.moments.second.get(p)?)
    }
}

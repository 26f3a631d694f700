//! APIC and MLS-MPM: each particle has an affine velocity field.
//!
//! `v_p = sum_i v_i N_i`, `B_p = sum_i v_i (x) (x_i - x_p) N_i`, and nodes receive
//! `v_p + B_p D_p^-1 (x_i - x_p)` (Jiang, Schroeder, Selle, Teran & Stomakhin 2015, eqs 8-10;
//! Jiang, Schroeder & Teran 2017 prove that angular momentum is exact). The stored state is B, and
//! D is evaluated at the new position. On the linear basis D changes within a cell, so storing
//! `C = B D^-1` would lose angular momentum.
//!
//! In MLS-MPM the gradients come from the least-squares fit of the affine velocity field:
//! `f_int_i = - sum_p V_p sigma_p D_p^-1 (x_i - x_p) N_i` and `grad v_p = C_p = B_p D_p^-1` (Hu et
//! al. 2018, eqs 17-18). The gradients grad N_i are not needed.

use super::contract::{Transfer, TransferKind};
use crate::mpm::foundation::algebra::{Matrix, product};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::moments::Moments;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::{
    Affine, Divergence, G2pRequest, Kernel, P2gRequest, ParticleField,
};
use mpm_subject::Column;

/// Affine particle in cell.
pub type Apic<const D: usize> = AffineTransfer<D, false>;

/// Moving least squares MPM (MLS-MPM).
pub type Mls<const D: usize> = AffineTransfer<D, true>;

/// Transfer of affine velocity fields. The gradients are those of the basis functions or, if `FIT`,
/// those of the least-squares fit.
#[derive(Debug, Clone, Default)]
pub struct AffineTransfer<const D: usize, const FIT: bool> {
    /// First moments B_p of the velocity fields (m^2/s).
    b: Vec<Matrix<D>>,
}

impl<const D: usize, const FIT: bool> Transfer<D> for AffineTransfer<D, FIT> {
    fn kind(&self) -> TransferKind {
        if FIT { TransferKind::Fit } else { TransferKind::Field }
    }

    fn start(&mut self, kernel: &dyn Kernel<D>, grid: &Grid<D>, particles: &Particles<D>) {
        let mut moments = Moments::default();
        moments.resize(particles.len());
        kernel.moments(grid, particles, &mut moments);
        let gradients = particles.grad_v.iter().zip(&moments.second);
        self.b = gradients.map(|(grad_v, second)| product(grad_v, second)).collect();
    }

    fn columns(&self) -> Vec<Column<'_>> {
        vec![Column::of_particles("B", &self.b)]
    }

    fn p2g_request<'a>(&'a self, particles: &'a Particles<D>) -> P2gRequest<'a, D> {
        let affine = Some(Affine::Moment(&self.b));
        let momentum = Some(ParticleField { v: &particles.v, affine });
        let force = Some(if FIT { Divergence::Fit } else { Divergence::Gradient });
        P2gRequest { mass: true, momentum, force }
    }

    fn g2p_request(&mut self, _: f64) -> G2pRequest<'_, D> {
        let (mix, moment) = (Some((0.0, 1.0)), Some(&mut *self.b));
        G2pRequest { mix, moment, ..G2pRequest::default() }
    }

    fn moment(&self, p: usize) -> Option<Matrix<D>> {
        self.b.get(p).copied()
    }
}

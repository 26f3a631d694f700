//! MLS-MPM: APIC whose gradients come from the least-squares fit of the affine velocity field.
//!
//! `f_int_i = - sum_p V_p sigma_p D_p^-1 (x_i - x_p) N_i` and `grad v_p = C_p = B_p D_p^-1` (Hu et
//! al. 2018, eqs 17-18). The gradients grad N_i are not needed.

use super::apic::Apic;
use super::contract::{Transfer, TransferKind};
use crate::mpm::foundation::algebra::Matrix;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::{Divergence, G2pRequest, Kernel, P2gRequest};
use mpm_subject::Column;

/// Moving least squares MPM (MLS-MPM).
#[derive(Debug, Clone, Default)]
pub struct Mls<const D: usize> {
    apic: Apic<D>,
}

impl<const D: usize> Transfer<D> for Mls<D> {
    fn kind(&self) -> TransferKind {
        TransferKind::Fit
    }

    fn start(&mut self, kernel: &dyn Kernel<D>, grid: &Grid<D>, particles: &Particles<D>) {
        self.apic.start(kernel, grid, particles);
    }

    fn columns(&self) -> Vec<Column<'_>> {
        self.apic.columns()
    }

    fn p2g_request<'a>(&'a self, particles: &'a Particles<D>) -> P2gRequest<'a, D> {
        P2gRequest { force: Some(Divergence::Fit), ..self.apic.p2g_request(particles) }
    }

    fn g2p_request(&mut self, dt: f64) -> G2pRequest<'_, D> {
        self.apic.g2p_request(dt)
    }

    fn moment(&self, p: usize) -> Option<Matrix<D>> {
        self.apic.moment(p)
    }
}

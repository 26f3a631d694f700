//! AFLIP: the affine field of APIC around a velocity that is mostly that of FLIP.
//!
//! `v_p <- s (v_p + dt sum_i a_i N_i) + (1 - s) sum_i v_i N_i` as in a blend, and
//! `B_p = sum_i v_i (x) (x_i - x_p) N_i` as in APIC (Fei, Guo, Wu, Huang & Gao 2021, ACM
//! Transactions on Graphics 40, 109; their ASFLIP also moves particles apart).

use super::apic::Apic;
use super::contract::{Transfer, TransferKind};
use crate::mpm::foundation::algebra::Matrix;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::{G2pRequest, Kernel, P2gRequest};
use mpm_subject::Column;

/// Affine FLIP.
#[derive(Debug, Clone)]
pub(super) struct Aflip<const D: usize> {
    flip: f64,
    affine: Apic<D>,
}

impl<const D: usize> Aflip<D> {
    /// Affine FLIP with the share `flip` of FLIP, from 0 (which is APIC) to 1.
    pub(super) fn new(flip: f64) -> Self {
        Self { flip, affine: Apic::default() }
    }
}

impl<const D: usize> Transfer<D> for Aflip<D> {
    fn kind(&self) -> TransferKind {
        TransferKind::Field
    }

    fn start(&mut self, kernel: &dyn Kernel<D>, grid: &Grid<D>, particles: &Particles<D>) {
        self.affine.start(kernel, grid, particles);
    }

    fn columns(&self) -> Vec<Column<'_>> {
        self.affine.columns()
    }

    fn p2g_request<'a>(&'a self, particles: &'a Particles<D>) -> P2gRequest<'a, D> {
        self.affine.p2g_request(particles)
    }

    fn g2p_request(&mut self, dt: f64) -> G2pRequest<'_, D> {
        let mix = Some((self.flip, 1.0 - self.flip));
        G2pRequest { change: Some(dt), mix, ..self.affine.g2p_request(dt) }
    }

    fn moment(&self, p: usize) -> Option<Matrix<D>> {
        self.affine.moment(p)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn velocity_is_mostly_that_of_flip() {
        let mut transfer = Aflip::<2>::new(0.75);
        let G2pRequest { change, mix, moment, .. } = transfer.g2p_request(0.5);
        assert_eq!((change, mix), (Some(0.5), Some((0.75, 0.25))));
        assert!(moment.is_some(), "the affine field of APIC");
    }
}

//! XPIC(m): PIC with a filter that preserves modes that the grid can represent.
//!
//! With S the map from grid to particles and S+ its lumped counterpart from particles to grid,
//! `V <- (I - (I - S S+)^m) V + S a dt` (Hammerquist & Nairn 2017, CMAME 318, eq. 21). XPIC(1) is
//! PIC. One step removes the part of the velocities in the null space of S+, and multiplies a mode
//! of S S+ with the eigenvalue l by 1 - (1 - l)^m. The filter ignores walls, which affect particles
//! only through the accelerations.

use super::contract::{Transfer, TransferKind};
use crate::mpm::foundation::algebra::{Vector, zeros};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::{G2pRequest, Kernel, ParticleField};
use mpm_subject::Column;

/// Extended particle in cell of order m.
#[derive(Debug, Clone)]
pub struct Xpic<const D: usize> {
    order: u32,
    remainder: Vec<Vector<D>>,
    nodal: Vec<Vector<D>>,
}

impl<const D: usize> Xpic<D> {
    /// Creates XPIC(m) with m = `order`.
    pub fn new(order: u32) -> Self {
        Self { order, remainder: Vec::new(), nodal: Vec::new() }
    }
}

impl<const D: usize> Transfer<D> for Xpic<D> {
    fn kind(&self) -> TransferKind {
        TransferKind::Series
    }

    fn start(&mut self, _: &dyn Kernel<D>, grid: &Grid<D>, particles: &Particles<D>) {
        self.remainder.resize(particles.len(), zeros());
        self.nodal.resize(grid.nodes(), zeros());
    }

    fn columns(&self) -> Vec<Column<'_>> {
        vec![
            Column::of_particles("remainder", &self.remainder),
            Column::of_nodes("scratch", &self.nodal),
        ]
    }

    fn filter_velocities(
        &mut self,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
        particles: &mut Particles<D>,
    ) -> u64 {
        self.remainder.copy_from_slice(&particles.v);
        for _ in 0..self.order {
            let field = ParticleField { v: &self.remainder, affine: None };
            kernel.p2g_momentum(particles, field, grid, &mut self.nodal);
            grid.divide_by_mass(&mut self.nodal);
            kernel.g2p(grid, &self.nodal, particles, (1.0, -1.0), &mut self.remainder);
        }
        for (v, remainder) in particles.v.iter_mut().zip(&self.remainder) {
            *v -= remainder;
        }
        2 * u64::from(self.order)
    }

    fn g2p_request(&mut self, dt: f64) -> G2pRequest<'_, D> {
        G2pRequest { change: Some(dt), ..G2pRequest::default() }
    }
}

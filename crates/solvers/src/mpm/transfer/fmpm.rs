//! FMPM(k): PIC with an approximate inverse of the consistent mass matrix.
//!
//! With S the map from grid to particles and S+ the map back, the consistent matrix is the lumped
//! matrix times S+ S. The inverse of this matrix is approximated by k terms of the Neumann series,
//! `v(k) = sum_(j<k) (I - S+ S)^j v(1)` with v(1) from the lumped matrix (Nairn & Hammerquist 2021,
//! CMAME 374, eqs 20-24). This inverse converts nodal momenta to velocities, and nodal forces to
//! accelerations. Particles receive the grid velocity, as in PIC. FMPM(1) is PIC.

use super::contract::{Transfer, TransferKind};
use crate::mpm::boundary::Boundary;
use crate::mpm::foundation::algebra::{Vector, zeros};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::{G2pRequest, Kernel, ParticleField};
use mpm_subject::Column;

/// Full-mass-matrix MPM of order k.
#[derive(Debug, Clone)]
pub struct Fmpm<const D: usize> {
    order: u32,
    mapped_back: Vec<Vector<D>>,
    remainder: Vec<Vector<D>>,
    nodal: Vec<Vector<D>>,
}

impl<const D: usize> Fmpm<D> {
    /// Creates FMPM(k) with k = `order`.
    pub fn new(order: u32) -> Self {
        Self { order, mapped_back: Vec::new(), remainder: Vec::new(), nodal: Vec::new() }
    }
}

impl<const D: usize> Transfer<D> for Fmpm<D> {
    fn kind(&self) -> TransferKind {
        TransferKind::Series
    }

    fn start(&mut self, _: &dyn Kernel<D>, grid: &Grid<D>, particles: &Particles<D>) {
        self.mapped_back.resize(particles.len(), zeros());
        self.remainder.resize(grid.nodes(), zeros());
        self.nodal.resize(grid.nodes(), zeros());
    }

    fn columns(&self) -> Vec<Column<'_>> {
        vec![
            Column::of_particles("mapped v", &self.mapped_back),
            Column::of_nodes("remainder", &self.remainder),
            Column::of_nodes("scratch", &self.nodal),
        ]
    }

    fn refine(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &Grid<D>,
        boundary: &[Box<dyn Boundary<D>>],
        field: &mut [Vector<D>],
    ) -> u64 {
        self.remainder.copy_from_slice(field);
        for _ in 1..self.order {
            kernel.g2p(grid, &self.remainder, particles, (0.0, 1.0), &mut self.mapped_back);
            let field_of_particles = ParticleField { v: &self.mapped_back, affine: None };
            kernel.p2g_momentum(particles, field_of_particles, grid, &mut self.nodal);
            grid.divide_by_mass(&mut self.nodal);
            for (remainder, mapped) in self.remainder.iter_mut().zip(&self.nodal) {
                *remainder -= mapped;
            }
            for condition in boundary {
                condition.clear(&mut self.remainder);
            }
            for (value, remainder) in field.iter_mut().zip(&self.remainder) {
                *value += remainder;
            }
        }
        2 * u64::from(self.order - 1)
    }

    fn g2p_request(&mut self, _: f64) -> G2pRequest<'_, D> {
        G2pRequest { mix: Some((0.0, 1.0)), ..G2pRequest::default() }
    }
}

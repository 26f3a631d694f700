//! Textbook loops of P2G and G2P: particle by particle and node by node, straight from the
//! equations.
//!
//! ```text
//! m_i     =  sum_p m_p N_i(x_p)                                    (Sulsky, Chen & Schreyer 1994)
//! (m v)_i =  sum_p m_p (v_p + C_p (x_i - x_p - mean_p)) N_i(x_p)   (APIC: Jiang et al. 2015)
//! f_i     = -sum_p V_p sigma_p grad N_i(x_p)                       (Sulsky, Chen & Schreyer 1994)
//! v_p     =  sum_i v_i N_i(x_p)
//! B_p     =  sum_i v_i (x) (x_i - x_p - mean_p) N_i(x_p)           (APIC: Jiang et al. 2015)
//! L_p     =  sum_i v_i (x) grad N_i(x_p)
//! ```
//!
//! with `mean_p = sum_i (x_i - x_p) N_i(x_p)`, zero except for domains that a wall cuts off. The
//! laws hold the fast loops to these sums. Compiled for tests only: a user has no reason to run the
//! slow loops, and a reader finds here what the fast ones compute.

use crate::mpm::algebra::{Matrix, Vector, dyad};
use crate::mpm::basis::Basis;
use crate::mpm::grid::Grid;
use crate::mpm::particles::Particles;

/// Sums of P2G, one entry for each node.
pub(super) struct NodeSums<const D: usize> {
    /// m_i (kg).
    pub(super) mass: Vec<f64>,
    /// Momentum (kg m/s).
    pub(super) momentum: Vec<Vector<D>>,
    /// Internal force (N).
    pub(super) force: Vec<Vector<D>>,
}

/// Sums of G2P, one entry for each particle.
pub(super) struct ParticleSums<const D: usize> {
    /// v_p (m/s).
    pub(super) velocity: Vec<Vector<D>>,
    /// B_p (m^2/s).
    pub(super) moment: Vec<Matrix<D>>,
    /// L_p (1/s).
    pub(super) gradient: Vec<Matrix<D>>,
}

/// `sum_i (x_i - x_p) N_i(x_p)` (m).
fn mean<B: Basis, const D: usize>(grid: &Grid<D>, particles: &Particles<D>, p: usize) -> Vector<D> {
    let mut mean = Vector::zeros();
    B::visit(grid, particles, p, |i| mean += i.offset * i.weight);
    mean
}

/// Mass, momentum of the field `v_p + C_p (x - x_p - mean_p)`, and internal force.
pub(super) fn p2g<B: Basis, const D: usize>(
    particles: &Particles<D>,
    c: &[Matrix<D>],
    grid: &Grid<D>,
) -> NodeSums<D> {
    let zero = vec![Vector::zeros(); grid.nodes()];
    let (mut mass, mut momentum, mut force) = (vec![0.0; grid.nodes()], zero.clone(), zero);
    for p in 0..particles.len() {
        let (m, flux) = (particles.mass[p], particles.flux(p));
        let mean = mean::<B, D>(grid, particles, p);
        B::visit(grid, particles, p, |i| {
            mass[i.node] += m * i.weight;
            momentum[i.node] += (particles.v[p] + c[p] * (i.offset - mean)) * (m * i.weight);
            force[i.node] -= flux * i.gradient;
        });
    }
    NodeSums { mass, momentum, force }
}

/// Velocity, first moment and gradient of the nodal velocities `v`.
pub(super) fn g2p<B: Basis, const D: usize>(
    grid: &Grid<D>,
    v: &[Vector<D>],
    particles: &Particles<D>,
) -> ParticleSums<D> {
    let zero = vec![Matrix::zeros(); particles.len()];
    let velocity = vec![Vector::zeros(); particles.len()];
    let mut sums = ParticleSums { velocity, moment: zero.clone(), gradient: zero };
    for p in 0..particles.len() {
        let mean = mean::<B, D>(grid, particles, p);
        B::visit(grid, particles, p, |i| {
            let v = &v[i.node];
            sums.velocity[p] += v * i.weight;
            sums.moment[p] += dyad(v, &(i.offset - mean)) * i.weight;
            sums.gradient[p] += dyad(v, i.gradient);
        });
    }
    sums
}

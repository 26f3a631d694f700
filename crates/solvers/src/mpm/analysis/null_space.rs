//! Null space of the map to the grid: the part of the particle velocities without nodal momentum.
//!
//! With N the map from nodes to particles and M the particle masses, velocities split uniquely into
//! `v = N w + v0`, where v0 gives no momentum to any node, `N^T M v0 = 0`. No force acts against v0
//! (Brackbill 1988; Gritton & Berzins 2017, Comp. Part. Mech. 4). The nodal velocity w is the
//! least-squares fit `N^T M N w = N^T M v`. This system is solved by conjugate gradients, which
//! converge even if `N^T M N` is singular. The preconditioner is the lumped mass matrix. Each
//! iteration maps to the grid and back once.

use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::{Kernel, ParticleField};
use crate::mpm::step::solver::Solver;

/// Residual energy that counts as rounding, as a fraction of the initial energy.
const ROUNDING: f64 = 1e-26;

/// Maximum number of iterations. A mode that PIC multiplies by the factor l needs about `1/sqrt(l)`
/// iterations.
const MOST: usize = 200;

impl<const D: usize> Solver<D> {
    /// Returns the kinetic energy (J) of the null-space part of the particle velocities, at the
    /// current positions. Walls do not change this energy, because they act on nodes only.
    pub fn null_space_energy(&self) -> f64 {
        0.5 * square(&self.setup.particles, &self.null_space_velocity())
    }

    /// Returns the null-space part of the particle velocities (m/s).
    pub fn null_space_velocity(&self) -> Vec<Vector<D>> {
        null_part(self.setup.kernel.as_ref(), &self.setup.grid, &self.setup.particles)
    }
}

fn null_part<const D: usize>(
    kernel: &dyn Kernel<D>,
    grid: &Grid<D>,
    particles: &Particles<D>,
) -> Vec<Vector<D>> {
    let masses = masses(kernel, grid, particles);
    let to_nodes = |v: &[Vector<D>], nodal: &mut [Vector<D>]| {
        kernel.p2g_momentum(particles, ParticleField { v, affine: None }, grid, nodal);
    };
    let mut rest = particles.v.clone();
    let mut momentum = vec![Vector::zeros(); grid.nodes()];
    let (mut along, mut mapped) = (momentum.clone(), rest.clone());
    let (size, mut before) = (square(particles, &rest), f64::INFINITY);
    for _ in 0..MOST {
        to_nodes(&rest, &mut momentum);
        let seen = seen(&masses, &momentum);
        // The negated comparison is true for NaN: the loop ends, and NaN remains in the residual.
        if !(seen > ROUNDING * size) {
            break;
        }
        let keep = seen / before;
        for ((along, p), m) in along.iter_mut().zip(&momentum).zip(&masses) {
            *along = *along * keep + divided(p, *m);
        }
        kernel.g2p(grid, &along, particles, (0.0, 1.0), &mut mapped);
        let step = seen / square(particles, &mapped);
        for (rest, mapped) in rest.iter_mut().zip(&mapped) {
            *rest -= mapped * step;
        }
        before = seen;
    }
    rest
}

/// Computes nodal masses (kg) at the current particle positions. The grid stores the masses from
/// before the last move.
fn masses<const D: usize>(
    kernel: &dyn Kernel<D>,
    grid: &Grid<D>,
    particles: &Particles<D>,
) -> Vec<f64> {
    let ones = vec![Vector::from_element(1.0); particles.len()];
    let mut nodal = vec![Vector::zeros(); grid.nodes()];
    kernel.p2g_momentum(particles, ParticleField { v: &ones, affine: None }, grid, &mut nodal);
    nodal.iter().map(|mass| mass[0]).collect()
}

fn divided<const D: usize>(momentum: &Vector<D>, mass: f64) -> Vector<D> {
    if mass > 0.0 { momentum / mass } else { Vector::zeros() }
}

/// Returns twice the kinetic energy (J) of nodes with these momenta.
fn seen<const D: usize>(masses: &[f64], momentum: &[Vector<D>]) -> f64 {
    masses.iter().zip(momentum).map(|(m, p)| divided(p, *m).dot(p)).sum()
}

/// Returns twice the kinetic energy (J) of particles with these velocities.
fn square<const D: usize>(particles: &Particles<D>, v: &[Vector<D>]) -> f64 {
    particles.mass.iter().zip(v).map(|(m, v)| m * v.norm_squared()).sum()
}

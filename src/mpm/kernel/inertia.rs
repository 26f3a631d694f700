//! Moments of the weights of one particle.

use crate::mpm::basis::{Basis, Patch};
use crate::mpm::foundation::algebra::{Matrix, Vector};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::moments::{InertiaTensor, WeightMoments};
use crate::mpm::foundation::particles::Particles;

/// Mean and second moments of the weights of particle `p`, from all its patches.
#[inline(always)]
pub(in crate::mpm) fn inertia<const D: usize, B: Basis>(
    grid: &Grid<D>,
    particles: &Particles<D>,
    p: usize,
) -> InertiaTensor<D> {
    let mut all = WeightMoments { first: Vector::zeros(), second: Matrix::zeros() };
    let mut one = InertiaTensor { mean: Vector::zeros(), second: Matrix::zeros() };
    let mut patches = 0;
    B::patches(grid, particles, p, |patch| {
        one = InertiaTensor::diagonal(patch.variance());
        patches += 1;
        if !B::ONE_PATCH {
            let weight_moments = patch.weight_moments();
            all.first += weight_moments.first;
            all.second += weight_moments.second;
        }
    });
    // A single patch is a product of one-dimensional functions.
    if B::ONE_PATCH || patches == 1 { one } else { InertiaTensor::full(&all) }
}

//! Moments of the weights of one particle.

use crate::mpm::{
    algebra::{Matrix, Vector},
    basis::{Basis, Patch, Spread},
    grid::Grid,
    moments::Inertia,
    particles::Particles,
};

/// Mean and second moments of the weights of particle `p`, from all its patches.
#[inline(always)]
pub(super) fn inertia<const D: usize, B: Basis>(
    grid: &Grid<D>,
    particles: &Particles<D>,
    p: usize,
) -> Inertia<D> {
    let mut all = Spread { first: Vector::zeros(), second: Matrix::zeros() };
    let mut one = Inertia { mean: Vector::zeros(), second: Matrix::zeros() };
    B::patches(grid, particles, p, |patch| {
        if B::ONE_PATCH {
            one = Inertia::diagonal(patch.variance());
        } else {
            let spread = patch.spread();
            all.first += spread.first;
            all.second += spread.second;
        }
    });
    if B::ONE_PATCH { one } else { Inertia::full(&all) }
}

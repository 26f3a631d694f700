//! A solver whose state is rounded to single precision after each pass.
//!
//! Arithmetic within a pass is in double precision, as in a solver that stores its arrays in single
//! precision and accumulates sums in registers. Rounded particle quantities are positions,
//! velocities, volumes, stresses, deformation gradients, temperatures and affine moments. Rounded
//! node quantities are mass, velocity, force and acceleration. Internal variables of a law, the
//! state of effects and conditions, and reference positions remain in double precision.

use super::setup::Setup;
use super::solver::Solver;
use super::subject::affine_state_mut;
use crate::mpm::foundation::algebra::{Matrix, Vector};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use mpm_subject::{Failure, Precision};

impl<const D: usize> Solver<D> {
    /// Creates a solver at t = 0 whose state is rounded to single precision, initially and after
    /// each pass.
    ///
    /// # Errors
    /// The errors of [`Solver::new`].
    #[inline(never)]
    pub fn in_single_precision(mut setup: Setup<D>) -> Result<Self, Failure> {
        round_particles(&mut setup.particles);
        let mut solver = Self { precision: Precision::Single, ..Self::new(setup)? };
        solver.round_to_precision();
        Ok(solver)
    }

    /// Rounds the state of particles, nodes and transfer if the solver is in single precision.
    pub(super) fn round_to_precision(&mut self) {
        if self.precision == Precision::Double {
            return;
        }
        round_vectors(&mut self.advected);
        let Setup { particles, grid, transfer, .. } = &mut self.setup;
        round_particles(particles);
        let Grid { mass, velocity, force, acceleration, .. } = grid;
        round(mass);
        for field in [velocity, force, acceleration] {
            round_vectors(field);
        }
        round_matrices(affine_state_mut(transfer.as_mut()));
    }
}

/// Rounds all columns except the reference positions, which only identify particles.
fn round_particles<const D: usize>(particles: &mut Particles<D>) {
    let ([_, vectors @ ..], scalars, matrices) = particles.columns_mut();
    for column in vectors {
        round_vectors(column);
    }
    for column in scalars {
        round(column);
    }
    for column in matrices {
        round_matrices(column);
    }
}

fn round_vectors<const D: usize>(column: &mut [Vector<D>]) {
    for vector in column {
        round(vector.as_mut_slice());
    }
}

fn round_matrices<const D: usize>(column: &mut [Matrix<D>]) {
    for matrix in column {
        round(matrix.as_mut_slice());
    }
}

#[inline]
fn round(numbers: &mut [f64]) {
    for number in numbers {
        *number = f64::from(*number as f32);
    }
}

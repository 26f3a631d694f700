//! A solver whose state is rounded to single precision after each pass.
//!
//! Arithmetic within a pass is in double precision, as in a solver that stores its arrays in single
//! precision and accumulates sums in registers. Rounded particle quantities are positions,
//! velocities, volumes, stresses, deformation gradients, temperatures and affine moments. Rounded
//! node quantities are mass, velocity, force and acceleration. Internal variables of a law, the
//! state of effects and conditions, and reference positions remain in double precision.

use super::setup::Setup;
use super::solver::{CustomStep, Solver};
use super::subject::affine_state_mut;
use crate::mpm::foundation::algebra::{Matrix, Vector};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::step::schedule::{Pass, StepSchedule};
use mpm_subject::Failure;

impl<const D: usize> Solver<D> {
    /// Creates a solver at t = 0 whose state is rounded to single precision, initially and after
    /// each pass.
    ///
    /// # Errors
    /// The errors of [`Solver::new`].
    #[inline(never)]
    pub fn in_single_precision(mut setup: Setup<D>) -> Result<Self, Failure> {
        round_particles(&mut setup.particles);
        let mut solver = Self { custom_step: Some(Box::new(RoundedStep)), ..Self::new(setup)? };
        round_state(&mut solver);
        Ok(solver)
    }
}

/// A step that rounds the state after each pass.
struct RoundedStep;

impl<const D: usize> CustomStep<D> for RoundedStep {
    fn step(&mut self, solver: &mut Solver<D>, dt: f64) -> Result<(), Failure> {
        let StepSchedule { opening, passes } = solver.schedule.clone();
        if !solver.started {
            solver.open(dt);
            round_state(solver);
            run_each(solver, &opening, dt)?;
            solver.opened(dt);
            round_state(solver);
        }
        run_each(solver, &passes, dt)?;
        solver.time += dt;
        Ok(())
    }
}

fn run_each<const D: usize>(
    solver: &mut Solver<D>,
    passes: &[Pass],
    dt: f64,
) -> Result<(), Failure> {
    for pass in passes {
        solver.run(*pass, dt)?;
        round_state(solver);
    }
    Ok(())
}

/// Rounds the state of particles, nodes and transfer.
fn round_state<const D: usize>(solver: &mut Solver<D>) {
    round_vectors(&mut solver.advected);
    let Setup { particles, grid, transfer, .. } = &mut solver.setup;
    round_particles(particles);
    let Grid { mass, velocity, force, acceleration, .. } = grid;
    round(mass);
    for field in [velocity, force, acceleration] {
        round_vectors(field);
    }
    round_matrices(affine_state_mut(transfer.as_mut()));
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

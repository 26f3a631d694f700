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
use crate::mpm::step::schedule::{Pass, StepSchedule};
use crate::subject::{BodyFields, Failure, Reaction, RunCounters, Samples, Subject, Totals};

/// A single-precision solver for one body.
pub struct SinglePrecision<const D: usize>(Solver<D>);

impl<const D: usize> SinglePrecision<D> {
    /// Creates a solver at t = 0 with a rounded initial state.
    ///
    /// # Errors
    /// The errors of [`Solver::new`].
    #[inline(never)]
    pub fn new(mut setup: Setup<D>) -> Result<Self, Failure> {
        round_particles(&mut setup.particles);
        let mut solver = Solver::new(setup)?;
        round_state(&mut solver);
        Ok(Self(solver))
    }

    /// Returns the particles in their current state.
    pub fn particles(&self) -> &Particles<D> {
        self.0.particles()
    }

    fn run_each(&mut self, passes: &[Pass], dt: f64) -> Result<(), Failure> {
        for pass in passes {
            self.0.run(*pass, dt)?;
            round_state(&mut self.0);
        }
        Ok(())
    }
}

// Not inlined, so that tests and other crates link to the code compiled here.
impl<const D: usize> Subject for SinglePrecision<D> {
    #[inline(never)]
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        let StepSchedule { opening, passes } = self.0.schedule.clone();
        if !self.0.started {
            self.0.open(dt);
            round_state(&mut self.0);
            self.run_each(&opening, dt)?;
            self.0.opened(dt);
            round_state(&mut self.0);
        }
        self.run_each(&passes, dt)?;
        self.0.time += dt;
        Ok(())
    }

    #[inline(never)]
    fn sample(&self, samples: &mut Samples) {
        self.0.sample(samples);
    }

    fn counters(&self) -> RunCounters {
        self.0.counters()
    }

    fn passes(&self) -> Vec<String> {
        self.0.passes()
    }

    #[inline(never)]
    fn fields(&self) -> Vec<BodyFields> {
        self.0.fields()
    }

    #[inline(never)]
    fn totals(&self) -> Option<Totals> {
        self.0.totals()
    }

    fn reaction(&self, face: Option<(usize, bool)>) -> Option<Reaction> {
        Subject::reaction(&self.0, face)
    }

    fn null_space_energy(&self) -> Option<f64> {
        Subject::null_space_energy(&self.0)
    }
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

fn round_particles<const D: usize>(particles: &mut Particles<D>) {
    let Particles {
        // Reference positions only identify particles and are not rounded.
        x0: _,
        x,
        current_position,
        v,
        mass,
        vol0,
        vol,
        sigma,
        def_grad,
        across,
        rate_across,
        stress_across,
        samples_stress_across: _,
        domain,
        domain0,
        grad_v,
        temperature,
        spacing: _,
    } = particles;
    for column in [x, current_position, v] {
        round_vectors(column);
    }
    for column in [mass, vol0, vol, across, rate_across, stress_across, temperature] {
        round(column);
    }
    for column in [sigma, def_grad, domain, domain0, grad_v] {
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

//! Implements [`Subject`] for a solver: the step, and the state as a vector of numbers.
//!
//! A step runs the passes of the schedule in order.
//!
//! The vector contains the state that a step reads and changes: velocities, stresses, volumes, F if
//! its column exists, and the affine state of the transfer. Internal variables of a material
//! (plastic flow) and the configuration (positions and domains) are excluded.

use super::schedule::{Coupled, Pass, StepSchedule};
use super::setup::{Setup, fields};
use super::solver::Solver;
use crate::mpm::boundary::Side;
use crate::mpm::foundation::algebra::{Matrix, pairs};
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::{Affine, G2pRequest};
use crate::mpm::transfer::{Transfer, kick};
use mpm_subject::{
    BodyFields, Failure, Perturbable, Reaction, RunCounters, Samples, Start, Subject, Totals,
};

impl<const D: usize> Solver<D> {
    /// Performs [`Subject::step`], and calls `after` with the name of each completed pass, so that
    /// a caller can time the passes.
    ///
    /// # Errors
    /// The errors of [`Subject::step`].
    pub fn step_by_pass(&mut self, dt: f64, after: &mut dyn FnMut(String)) -> Result<(), Failure> {
        self.step_observed(dt, &mut |pass| after(pass.name()))
    }

    fn step_observed(&mut self, dt: f64, after: &mut dyn FnMut(Pass)) -> Result<(), Failure> {
        let StepSchedule { opening, passes } = self.schedule.clone();
        if !self.started {
            self.open(dt);
            self.round_to_precision();
            self.run_each(&opening, dt, after)?;
            self.opened(dt);
            self.round_to_precision();
        }
        self.run_each(&passes, dt, after)?;
        self.time += dt;
        Ok(())
    }

    pub(in crate::mpm) fn run_all(&mut self, passes: &[Pass], dt: f64) -> Result<(), Failure> {
        self.run_each(passes, dt, &mut |_| {})
    }

    fn run_each(
        &mut self,
        passes: &[Pass],
        dt: f64,
        after: &mut dyn FnMut(Pass),
    ) -> Result<(), Failure> {
        for pass in passes {
            self.run(*pass, dt)?;
            self.round_to_precision();
            after(*pass);
        }
        Ok(())
    }

    /// Applies the boundary conditions to velocities again, after a coupling of bodies.
    pub(in crate::mpm) fn hold_velocity(&mut self) {
        for condition in &self.setup.boundary {
            condition.hold_velocity(&mut self.setup.grid.velocity, self.velocity_time);
        }
    }

    /// Applies the boundary conditions to accelerations again, after a coupling of bodies.
    pub(in crate::mpm) fn hold_acceleration(&mut self) {
        for condition in &self.setup.boundary {
            condition.hold_acceleration(&mut self.setup.grid.acceleration, &self.advance);
        }
    }

    pub(in crate::mpm) fn open(&mut self, dt: f64) {
        self.drive(0.0);
        if self.setup.start == Start::HalfStepBack {
            // The initial acceleration a(0) acts over the whole step around t = 0.
            self.velocity_time = -0.5 * dt;
        }
    }

    /// Computes `v(-dt/2) = v(0) - dt/2 a(0)` from the accelerations of the opening passes.
    pub(in crate::mpm) fn opened(&mut self, dt: f64) {
        self.started = true;
        if self.setup.start == Start::AtZero {
            return;
        }
        self.velocity_time = -0.5 * dt;
        let Setup { grid, particles, kernel, transfer, .. } = &mut self.setup;
        let passes = kick(transfer.as_mut(), kernel.as_ref(), grid, -0.5 * dt, particles);
        self.count(passes);
        self.drive(0.0);
    }
}

// Not inlined, so that tests and other crates link to the code compiled here.
impl<const D: usize> Subject for Solver<D> {
    #[inline(never)]
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        self.step_observed(dt, &mut |_| {})
    }

    #[inline(never)]
    fn sample(&self, samples: &mut Samples) {
        samples.clear();
        self.setup.particles.sample_with(self.setup.material.as_ref(), samples);
    }

    #[inline(never)]
    fn fields(&self) -> Vec<BodyFields> {
        vec![fields(&self.setup.grid, &self.setup.particles, &self.columns())]
    }

    #[inline(never)]
    fn totals(&self) -> Option<Totals> {
        let Setup { particles, transfer, material, .. } = &self.setup;
        // With averaged volume ratios, the internal force is not the derivative of the energy of F.
        let is_averaged = self.volume_average.is_some();
        let strain_energy = if is_averaged { None } else { material.energy(particles) };
        Some(Totals { strain_energy, ..particles.totals(|p| transfer.moment(p)) })
    }

    fn reaction(&self, face: Option<(usize, bool)>) -> Option<Reaction> {
        let side = |high| if high { Side::High } else { Side::Low };
        self.started.then(|| self.reaction(face.map(|(axis, high)| (axis, side(high)))))
    }

    fn null_space_energy(&self) -> Option<f64> {
        Some(Self::null_space_energy(self))
    }

    fn counters(&self) -> RunCounters {
        let transfers = RunCounters::new(self.transfers);
        self.cell_tracker.counters(RunCounters { min_j: self.min_j, ..transfers })
    }

    fn passes(&self) -> Vec<String> {
        self.schedule.texts(&self.setup.state_passes())
    }
}

/// Returns the matrix columns of the particles, in the order of the state vector.
fn matrices<const D: usize>(particles: &Particles<D>) -> impl Iterator<Item = &Matrix<D>> {
    [&particles.sigma, &particles.def_grad].into_iter().flatten()
}

fn affine<const D: usize>(solver: &Solver<D>) -> Option<Affine<'_, D>> {
    solver.setup.transfer.p2g_request(&solver.setup.particles).momentum?.affine
}

/// Returns the state of the affine velocity field; empty if the transfer has none.
pub(in crate::mpm) fn affine_state_mut<const D: usize>(
    transfer: &mut dyn Transfer<D>,
) -> &mut [Matrix<D>] {
    let G2pRequest { moment, gradient, .. } = transfer.g2p_request(0.0);
    moment.or(gradient).unwrap_or_default()
}

impl<const D: usize> Perturbable for Solver<D> {
    fn fix_configuration(&mut self) {
        self.schedule = StepSchedule::new(&mut self.setup, Coupled::default(), true);
    }

    fn state(&self, state: &mut Vec<f64>) {
        let particles = &self.setup.particles;
        state.clear();
        for v in &particles.v {
            state.extend_from_slice(v.as_slice());
        }
        for matrix in matrices(particles) {
            state.extend_from_slice(matrix.as_slice());
        }
        state.extend(&particles.vol);
        state.extend(particles.across.iter().chain(&particles.stress_across));
        let affine = affine(self).map_or(&[][..], Affine::state);
        for matrix in affine {
            state.extend_from_slice(matrix.as_slice());
        }
    }

    fn set_state(&mut self, state: &[f64]) {
        let Particles { v, sigma, def_grad, vol, across, stress_across, .. } =
            &mut self.setup.particles;
        let affine_state = affine_state_mut(self.setup.transfer.as_mut());
        let mut rest = state;
        let mut set = |numbers: &mut [f64]| {
            pairs(numbers, rest, |number, value| *number = *value);
            rest = &rest[numbers.len().min(rest.len())..];
        };
        for v in v {
            set(v.as_mut_slice());
        }
        for matrix in sigma.iter_mut().chain(def_grad) {
            set(matrix.as_mut_slice());
        }
        for column in [vol, across, stress_across] {
            set(column);
        }
        for matrix in affine_state {
            set(matrix.as_mut_slice());
        }
    }

    fn sizes(&self, speed: f64, modulus: f64, sizes: &mut Vec<f64>) {
        let particles = &self.setup.particles;
        sizes.clear();
        let mut same = |size: f64, count: usize| sizes.extend(std::iter::repeat_n(size, count));
        same(speed, D * particles.len());
        same(modulus, D * D * particles.sigma.len());
        same(1.0, D * D * particles.def_grad.len());
        for vol in &particles.vol0 {
            same(*vol, 1);
        }
        same(1.0, particles.across.len());
        same(modulus, particles.stress_across.len());
        if let Some(affine) = affine(self) {
            same(affine.size(speed, self.setup.grid.h), D * D * affine.state().len());
        }
    }
}

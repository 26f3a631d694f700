//! A step: the passes of the schedule in their order, and the start of a run.

use super::columns::fields;
use super::schedule::{Pass, StepSchedule};
use super::setup::Setup;
use super::solver::Solver;
use crate::mpm::boundary::Side;
use crate::mpm::transfer::kick;
use crate::subject::{
    BodyFields, Checkpoint, Failure, Reaction, RunCounters, Samples, Start, Subject, Totals,
};

impl<const D: usize> Solver<D> {
    /// The step of [`Subject::step`]; `after` is called with the name of each pass when it is done,
    /// for those who time passes.
    ///
    /// # Errors
    /// Those of [`Subject::step`].
    pub fn step_by_pass(&mut self, dt: f64, after: &mut dyn FnMut(String)) -> Result<(), Failure> {
        self.step_with(dt, &mut |pass| after(pass.name()))
    }

    fn step_with(&mut self, dt: f64, after: &mut dyn FnMut(Pass)) -> Result<(), Failure> {
        let StepSchedule { opening, passes } = self.schedule.clone();
        if !self.started {
            self.open(dt);
            self.run_each(&opening, dt, after)?;
            self.opened(dt);
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

    /// Before the passes of the opening.
    pub(in crate::mpm) fn open(&mut self, dt: f64) {
        self.drive(0.0);
        if self.setup.start == Start::HalfStepBack {
            // a(0) is that of the whole step around t = 0.
            self.velocity_time = -0.5 * dt;
        }
    }

    /// After the passes of the opening: `v(-dt/2) = v(0) - dt/2 a(0)`.
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

impl<const D: usize> Subject for Solver<D> {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        self.step_with(dt, &mut |_| {})
    }

    fn sample(&self, samples: &mut Samples) {
        samples.clear();
        self.setup.particles.sample(samples);
    }

    fn fields(&self) -> Vec<BodyFields> {
        vec![fields(&self.setup.grid, &self.setup.particles, &self.columns())]
    }

    fn totals(&self) -> Option<Totals> {
        let Setup { particles, transfer, material, .. } = &self.setup;
        let strain_energy = material.energy(particles);
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
        RunCounters {
            particles: Some(self.setup.particles.len() as u64),
            transfers: self.transfers,
            crossings: Some(self.cell_tracker.crossings),
            left_domain: Some(self.cell_tracker.left_domain),
            min_j: self.min_j,
        }
    }

    fn passes(&self) -> Vec<String> {
        self.schedule.texts(&self.setup.state_passes())
    }

    fn checkpoint(&mut self, checkpoint: &mut Checkpoint<'_>) -> bool {
        checkpoint.visit(self);
        true
    }
}

//! Steps: the stages in their order, and how a run starts.

use super::{setup::Setup, solver::Solver, stage::Stage};
use crate::subject::{Checkpoint, Failure, RunCounters, Samples, Start, Subject, Totals};

impl<const D: usize> Solver<D> {
    fn run_all(&mut self, stages: &[Stage], dt: f64) -> Result<(), Failure> {
        (0..stages.len()).try_for_each(|k| self.run_first(&stages[k..], dt))
    }

    /// Gives walls back what they hold of velocities that something else has changed.
    pub(super) fn hold_velocity(&mut self) {
        for condition in &self.setup.boundary {
            condition.hold_velocity(&mut self.setup.grid.velocity, self.stands);
        }
    }

    /// Gives walls back what they hold of accelerations that something else has changed.
    pub(super) fn hold_acceleration(&mut self) {
        for condition in &self.setup.boundary {
            condition.hold_acceleration(&mut self.setup.grid.acceleration, &self.advance);
        }
    }

    /// What comes before the first step: the stages that give the accelerations at t = 0, where
    /// the velocities start half a step back.
    pub(super) fn opening(&self) -> &'static [Stage] {
        match (self.setup.start, self.setup.reads_velocity()) {
            (Start::AtZero, _) => &[],
            (Start::HalfStepBack, false) => &[Stage::Mass, Stage::Force, Stage::Acceleration],
            (Start::HalfStepBack, true) => {
                &[Stage::Mass, Stage::Momentum, Stage::Force, Stage::Acceleration]
            }
        }
    }

    /// Before the [opening](Self::opening).
    pub(super) fn open(&mut self, dt: f64) {
        self.drive(0.0);
        if self.setup.start == Start::HalfStepBack {
            // a(0) is that of the whole step around t = 0.
            self.stands = -0.5 * dt;
        }
    }

    /// After the [opening](Self::opening): `v(-dt/2) = v(0) - dt/2 a(0)`.
    pub(super) fn opened(&mut self, dt: f64) {
        self.started = true;
        if self.setup.start == Start::AtZero {
            return;
        }
        self.stands = -0.5 * dt;
        let Setup { grid, particles, kernel, transfer, .. } = &mut self.setup;
        let passes = transfer.kick(kernel.as_ref(), grid, -0.5 * dt, particles);
        self.count(passes);
        self.drive(0.0);
    }
}

impl<const D: usize> Subject for Solver<D> {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        if !self.started {
            self.open(dt);
            self.run_all(self.opening(), dt)?;
            self.opened(dt);
        }
        self.run_all(self.setup.stages(false), dt)?;
        self.time += dt;
        Ok(())
    }

    fn sample(&self, samples: &mut Samples) {
        samples.clear();
        self.setup.particles.sample(samples);
    }

    fn totals(&self) -> Option<Totals> {
        let Setup { particles, transfer, material, .. } = &self.setup;
        let strain_energy = material.energy(particles);
        Some(Totals { strain_energy, ..particles.totals(|p| transfer.moment(p)) })
    }

    fn null_space_energy(&self) -> Option<f64> {
        Some(Self::null_space_energy(self))
    }

    fn counters(&self) -> RunCounters {
        RunCounters {
            particles: Some(self.setup.particles.len() as u64),
            transfers: self.transfers,
            crossings: Some(self.whereabouts.crossings),
            left_domain: Some(self.whereabouts.left_domain),
            min_j: self.min_j,
        }
    }
    fn checkpoint(&mut self, checkpoint: &mut Checkpoint<'_>) -> bool {
        checkpoint.visit(self);
        true
    }
}

//! The solver: implements the passes of a step. [`schedule`](super::schedule) defines their order.

use super::cell_tracker::CellTracker;
use super::initial;
use super::schedule::{Coupled, Pass, StepSchedule};
use super::setup::{Setup, profile};
use super::volume_average::{PASSES, VolumeAverage, VolumeName};
use crate::mpm::basis::Domain;
use crate::mpm::boundary::Advance;
use crate::mpm::effect::{BodyOnGrid, strain};
use crate::mpm::foundation::algebra::{Vector, zeros};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::{FrameName, Particles};
use crate::mpm::foundation::simd::vectorized;
use crate::mpm::foundation::threads::PIECES;
use crate::mpm::kernel::contract::Tally;
use crate::mpm::material::{Material, StressUpdate};
use crate::mpm::scheme::Stage;
use crate::mpm::transfer::{Transfer, g2p};
use mpm_subject::{Column, Failure, Precision, Profile};

/// The original MPM for one body, with the state that changes from step to step.
pub struct Solver<const D: usize> {
    pub(in crate::mpm) setup: Setup<D>,
    pub(in crate::mpm) schedule: StepSchedule,
    pub(in crate::mpm) time: f64,
    /// Time to which the velocities belong (s). After the first step, they are half a step behind.
    pub(in crate::mpm) velocity_time: f64,
    pub(in crate::mpm) advance: Advance,
    pub(in crate::mpm) started: bool,
    pub(in crate::mpm) transfers: u64,
    pub(in crate::mpm) min_j: f64,
    pub(in crate::mpm) cell_tracker: CellTracker<D>,
    /// Position of each particle after the step (m), stored between G2P and the update of
    /// positions.
    pub(in crate::mpm) advected: Vec<Vector<D>>,
    /// Arrays for averaged volume ratios; `None` if the method does not average volume ratios.
    pub(in crate::mpm) volume_average: Option<VolumeAverage<D>>,
    /// In single precision, the state is rounded after each pass.
    pub(in crate::mpm) precision: Precision,
}

impl<const D: usize> Solver<D> {
    /// Creates a solver at t = 0.
    ///
    /// # Errors
    /// [`Failure::NonFinite`] if the initial state of a particle is not finite;
    /// [`Failure::LeftDomain`] if a particle starts outside the grid; [`Failure::Inverted`] or
    /// [`Failure::NotOfDeformation`] if the initial deformation is invalid.
    #[inline(never)]
    pub fn new(mut setup: Setup<D>) -> Result<Self, Failure> {
        let Setup { grid, particles, kernel, material, effects, volume, .. } = &mut setup;
        let mut volume_average = match volume {
            VolumeName::Particle => None,
            VolumeName::Averaged => {
                Some(VolumeAverage::new(particles, grid, material.reads_deformation())?)
            }
        };
        if effects.iter().any(|effect| effect.reads_deformation()) {
            particles.track_deformation();
        }
        let mut averaged;
        let law: &mut dyn Material<D> = if let Some(average) = &mut volume_average {
            averaged = average.law(material.as_mut(), kernel.as_ref(), grid);
            &mut averaged
        } else {
            material.as_mut()
        };
        let min_j = initial::complete(particles, kernel.domain(), law)?;
        for effect in effects {
            effect.start(law, particles);
        }
        particles.deformed_finite()?;
        particles.stressed_finite()?;
        if setup.frame == FrameName::Total {
            setup.particles.stay_in_reference();
        }
        let cell_tracker = CellTracker::new(&setup.grid, &setup.particles)?;
        let Setup { grid, particles, kernel, transfer, .. } = &mut setup;
        transfer.start(kernel.as_ref(), grid, particles);
        Ok(Self {
            schedule: StepSchedule::new(&mut setup, Coupled::default(), false),
            time: 0.0,
            velocity_time: 0.0,
            advance: Advance { from: 0.0, to: 0.0, dt: 0.0 },
            started: false,
            transfers: 0,
            min_j,
            cell_tracker,
            advected: vec![zeros(); setup.particles.len()],
            volume_average,
            precision: Precision::Double,
            setup,
        })
    }

    /// Returns the particles in their current state.
    pub fn particles(&self) -> &Particles<D> {
        &self.setup.particles
    }

    /// Returns the transfer, with its particle state.
    pub fn transfer(&self) -> &dyn Transfer<D> {
        self.setup.transfer.as_ref()
    }

    /// Returns the grid after the last pass.
    pub fn grid(&self) -> &Grid<D> {
        &self.setup.grid
    }

    /// Returns the active effects, and all columns of particles and nodes.
    pub fn profile(&self) -> Profile {
        let Setup { grid, particles, effects, .. } = &self.setup;
        profile(grid, particles, effects, &self.columns())
    }

    pub(in crate::mpm) fn columns(&self) -> Vec<Column<'_>> {
        let advected = Column::of_particles("advected x", &self.advected);
        let of_average = self.volume_average.iter().flat_map(VolumeAverage::columns);
        let own = [self.cell_tracker.columns(), advected];
        self.setup.columns(own.into_iter().chain(of_average))
    }

    /// Returns the quantities that passes have computed since the last call, each with the number
    /// of visited particles. Counting starts with the first call.
    pub fn take_visits(&self) -> Vec<(&'static str, u64)> {
        Tally::take(&[self.setup.kernel.tally()])
    }

    pub(in crate::mpm) fn run(&mut self, pass: Pass, dt: f64) -> Result<(), Failure> {
        let Setup { grid, particles, kernel, transfer, .. } = &mut self.setup;
        match pass {
            Pass::P2g(stages) => {
                let passes = transfer.p2g(kernel.as_ref(), particles, grid, stages);
                self.count(passes);
            }
            Pass::G2p(stages) => {
                let (transfer, advected) = (transfer.as_mut(), &mut *self.advected);
                let passes = g2p(transfer, kernel.as_ref(), grid, dt, particles, stages, advected);
                self.count(passes);
            }
            Pass::Update(stage) => self.update(stage, dt)?,
            Pass::IntegrateState => self.integrate_state(dt)?,
            Pass::Couple(_) => {}
        }
        Ok(())
    }

    /// Performs the work of a stage that follows its P2G or G2P pass.
    fn update(&mut self, stage: Stage, dt: f64) -> Result<(), Failure> {
        match stage {
            Stage::Mass => self.mass()?,
            Stage::Momentum => self.momentum(),
            Stage::Force => self.force(),
            Stage::Acceleration => self.accelerate(dt),
            Stage::GridVelocity => {
                let Grid { velocity, acceleration, .. } = &mut self.setup.grid;
                advance(velocity, acceleration, dt);
            }
            Stage::ParticleVelocity => self.drive(dt),
            Stage::Stress => self.stress(dt)?,
            Stage::Position => self.position(dt)?,
        }
        Ok(())
    }

    fn mass(&mut self) -> Result<(), Failure> {
        let Setup { grid, particles, kernel, mass, boundary, .. } = &mut self.setup;
        let passes = mass.assemble(kernel.as_ref(), particles, grid, boundary)?;
        self.count(passes);
        Ok(())
    }

    fn momentum(&mut self) {
        let Setup { grid, particles, kernel, transfer, mass, boundary, .. } = &mut self.setup;
        let mut field = std::mem::take(&mut grid.velocity);
        mass.solve(grid, &mut field);
        for condition in boundary.iter() {
            condition.hold_velocity(&mut field, self.velocity_time);
        }
        let passes = transfer.refine(kernel.as_ref(), particles, grid, boundary, &mut field);
        grid.velocity = field;
        self.count(passes);
    }

    fn force(&mut self) {
        let Setup { grid, particles, kernel, effects, .. } = &mut self.setup;
        let mut body = BodyOnGrid { particles, kernel: kernel.as_ref(), grid };
        for effect in effects.iter_mut() {
            self.transfers += effect.add_force(self.time, &mut body);
        }
        for effect in &self.setup.effects {
            effect.modify_force(&mut self.setup.grid);
        }
    }

    fn accelerate(&mut self, dt: f64) {
        let Setup { grid, particles, kernel, transfer, mass, boundary, .. } = &mut self.setup;
        let mut field = std::mem::take(&mut grid.acceleration);
        field.copy_from_slice(&grid.force);
        mass.solve(grid, &mut field);
        let advance = Advance { from: self.velocity_time, to: self.time + 0.5 * dt, dt };
        for condition in boundary.iter_mut() {
            condition.hold_advance(&mut grid.velocity, &mut field, &advance);
        }
        (self.velocity_time, self.advance) = (advance.to, advance);
        let passes = transfer.refine(kernel.as_ref(), particles, grid, boundary, &mut field);
        grid.acceleration = field;
        self.count(passes);
    }

    /// Calls the velocity hooks of the effects after an advance by `dt` (s).
    pub(in crate::mpm) fn drive(&mut self, dt: f64) {
        for effect in &self.setup.effects {
            effect.modify_velocity(self.velocity_time, dt, &mut self.setup.particles);
        }
    }

    fn integrate_state(&mut self, dt: f64) -> Result<(), Failure> {
        let Setup { grid, particles, kernel, effects, .. } = &mut self.setup;
        for effect in effects {
            let kernel = kernel.as_ref();
            self.transfers += effect.integrate_state(self.time, dt, particles, kernel, grid)?;
        }
        Ok(())
    }

    fn position(&mut self, dt: f64) -> Result<(), Failure> {
        let Setup { grid, particles, kernel, frame, effects, .. } = &mut self.setup;
        std::mem::swap(particles.positions_mut(), &mut self.advected);
        for effect in effects {
            effect.modify_position(dt, particles);
        }
        if kernel.domain() == Domain::Follows && *frame == FrameName::Updated {
            particles.track_domains();
        }
        self.cell_tracker.track(grid, particles)?;
        particles.moving_finite()?;
        self.count(1);
        Ok(())
    }

    pub(in crate::mpm) fn count(&mut self, passes: u64) {
        let pairs = self.setup.particles.len() as u64 * self.setup.kernel.support();
        self.transfers += passes * pairs;
    }
}

fn advance<const D: usize>(v: &mut [Vector<D>], a: &[Vector<D>], dt: f64) {
    PIECES.each(v, &|k, piece| {
        let a = &a[k * PIECES.length..];
        vectorized(
            #[inline(always)]
            || {
                for (v, a) in piece.iter_mut().zip(a) {
                    for axis in 0..D {
                        v[axis] += a[axis] * dt;
                    }
                }
            },
        );
    });
}

impl<const D: usize> Solver<D> {
    /// Updates deformation, stress and volume from the velocity gradients of the particles.
    pub(in crate::mpm) fn stress(&mut self, dt: f64) -> Result<(), Failure> {
        let Setup { particles, material, frame, effects, kernel, grid, .. } = &mut self.setup;
        if *frame == FrameName::Total {
            particles.push_gradients_forward();
        }
        for effect in effects.iter_mut() {
            self.transfers += effect.map_velocity(dt, kernel.as_ref(), grid, particles);
        }
        let update = StressUpdate::straining(dt, particles);
        let least_j = if let Some(average) = &mut self.volume_average {
            let mut law = average.law(material.as_mut(), kernel.as_ref(), grid);
            let least_j = strain(effects, &mut law, update);
            self.count(PASSES);
            least_j
        } else {
            strain(effects, material.as_mut(), update)
        };
        if let Some(least) = least_j {
            self.min_j = self.min_j.min(least);
        } else {
            self.setup.particles.volumes_positive(&mut self.min_j)?;
        }
        let Setup { particles, material, .. } = &self.setup;
        // A law that reads F computes J from F, so the check of J also detects a NaN or an infinity
        // in F.
        if !material.reads_deformation() {
            particles.deformed_finite()?;
        }
        if least_j.is_none() { particles.stressed_finite() } else { Ok(()) }
    }
}

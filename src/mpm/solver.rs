//! The solver: every stage of a step, one by one. [`step`](super::step) has their order.

use super::{
    algebra::Vector,
    analysis::cell_tracker::CellTracker,
    basis::Domain,
    boundary::Advance,
    frame::FrameName,
    grid::Grid,
    particles::Particles,
    setup::Setup,
    stage::{Gathered, Stage, Visited, maps, takes},
    state::initial,
    transfer::{Transfer, Wanted},
};
use crate::subject::{Column, Failure, Profile};

/// The original MPM at one level of refinement.
pub struct Solver<const D: usize> {
    pub(super) setup: Setup<D>,
    pub(super) time: f64,
    /// Time that the velocities stand for (s): once steps are made, half a step behind.
    pub(super) stands: f64,
    /// The last advance of velocities.
    pub(super) advance: Advance,
    pub(super) started: bool,
    /// Whether nothing moves.
    pub(super) frozen: bool,
    pub(super) transfers: u64,
    pub(super) min_j: f64,
    pub(super) whereabouts: CellTracker<D>,
    /// Where the grid carries each particle (m), from the visit that asks for it until positions move.
    pub(super) carried: Vec<Vector<D>>,
    pub(super) visited: Visited,
}

impl<const D: usize> Solver<D> {
    /// A solver at t = 0.
    ///
    /// # Errors
    /// [`Failure::NonFinite`] if the initial state of a particle is; [`Failure::LeftDomain`] if it
    /// starts outside the grid; [`Failure::Inverted`] or [`Failure::NotOfDeformation`] if the body
    /// starts deformed in a way that has no meaning.
    pub fn new(mut setup: Setup<D>) -> Result<Self, Failure> {
        let Setup { particles, kernel, material, effects, .. } = &mut setup;
        if effects.iter().any(|effect| effect.reads_deformation()) {
            particles.track_deformation();
        }
        let min_j = initial::complete(particles, kernel.as_ref(), material.as_mut())?;
        for effect in effects {
            effect.start(material.as_mut(), particles);
        }
        particles.strained_finite()?;
        if setup.frame == FrameName::Total {
            setup.particles.stay_in_reference();
        }
        let whereabouts = CellTracker::new(&setup.grid, &setup.particles)?;
        let Setup { grid, particles, kernel, transfer, .. } = &mut setup;
        transfer.start(kernel.as_ref(), grid, particles);
        let (time, stands, started, frozen, transfers) = (0.0, 0.0, false, false, 0);
        let advance = Advance { from: 0.0, to: 0.0, dt: 0.0 };
        let (carried, visited) = (vec![Vector::zeros(); setup.particles.len()], Visited::default());
        Ok(Self {
            setup,
            time,
            stands,
            advance,
            started,
            frozen,
            transfers,
            min_j,
            whereabouts,
            carried,
            visited,
        })
    }

    /// The particles as they are now.
    pub fn particles(&self) -> &Particles<D> {
        &self.setup.particles
    }

    /// The transfer, with what particles carry for it.
    pub fn transfer(&self) -> &dyn Transfer<D> {
        self.setup.transfer.as_ref()
    }

    /// The grid as the last stage left it.
    pub fn grid(&self) -> &Grid<D> {
        &self.setup.grid
    }

    /// The effects, and all that is kept for particles and nodes: what a step works with.
    pub fn profile(&self) -> Profile {
        let carried = Column::of_particles("carried", &self.carried);
        self.setup.profile([self.whereabouts.columns(), carried])
    }

    /// Runs one stage of a step of length `dt` (s).
    ///
    /// # Errors
    /// See [`Subject::step`](crate::subject::Subject::step).
    pub fn run(&mut self, stage: Stage, dt: f64) -> Result<(), Failure> {
        self.run_first(&[stage], dt)
    }

    /// Runs the first of `stages`. What those after it want of the same particles and nodes is done
    /// in the same visit, if nothing in between changes either.
    pub(super) fn run_first(&mut self, stages: &[Stage], dt: f64) -> Result<(), Failure> {
        let Some((&stage, rest)) = stages.split_first() else { return Ok(()) };
        match stage {
            Stage::Mass => {
                self.visited.p2g = maps(stages);
                self.map(self.visited.p2g);
                self.mass()?;
                if self.started {
                    self.advance_effects(dt)?;
                }
            }
            Stage::Momentum => {
                let is_mapped = std::mem::take(&mut self.visited.p2g.momentum);
                self.momentum(is_mapped);
            }
            Stage::Force => {
                let is_mapped = std::mem::take(&mut self.visited.p2g.force);
                self.force(is_mapped);
            }
            Stage::Acceleration => self.accelerate(dt),
            Stage::GridVelocity => {
                let Grid { velocity, acceleration, .. } = &mut self.setup.grid;
                for (v, a) in velocity.iter_mut().zip(acceleration) {
                    *v += *a * dt;
                }
            }
            Stage::ParticleVelocity => {
                self.visited.g2p = takes(rest);
                self.take(dt, true, self.visited.g2p);
                self.drive(dt);
            }
            Stage::Stress => {
                if !std::mem::take(&mut self.visited.g2p.gradient) {
                    let wanted = takes(stages);
                    self.take(dt, false, wanted);
                    self.visited.g2p = Gathered { gradient: false, ..wanted };
                }
                self.stress(dt)?;
            }
            Stage::Position if self.frozen => {}
            Stage::Position => {
                if !std::mem::take(&mut self.visited.g2p.carried) {
                    self.take(dt, false, takes(stages));
                }
                self.position(dt)?;
            }
        }
        Ok(())
    }

    fn mass(&mut self) -> Result<(), Failure> {
        let Setup { grid, particles, kernel, mass, boundary, .. } = &mut self.setup;
        let passes = mass.assemble(kernel.as_ref(), particles, grid, boundary)?;
        self.count(passes);
        Ok(())
    }

    /// From momenta to velocities; `is_mapped` tells that the momenta are there.
    fn momentum(&mut self, is_mapped: bool) {
        let Setup { grid, particles, kernel, transfer, mass, boundary, .. } = &mut self.setup;
        let mut field = std::mem::take(&mut grid.velocity);
        let mut passes = 0;
        if !is_mapped {
            passes += transfer.p2g_momentum(kernel.as_ref(), particles, grid, &mut field);
        }
        mass.solve(grid, &mut field);
        for condition in boundary.iter() {
            condition.hold_velocity(&mut field, self.stands);
        }
        passes += transfer.refine(kernel.as_ref(), particles, grid, boundary, &mut field);
        grid.velocity = field;
        self.count(passes);
    }

    /// External forces on top of the internal ones; `is_mapped` tells that these are there.
    fn force(&mut self, is_mapped: bool) {
        if !is_mapped {
            self.map(Wanted { force: true, ..Wanted::default() });
        }
        let Setup { grid, particles, kernel, effects, .. } = &mut self.setup;
        for effect in effects.iter_mut() {
            self.transfers += effect.add_force(self.time, particles, kernel.as_ref(), grid);
        }
        for effect in &self.setup.effects {
            effect.oppose_motion(&mut self.setup.grid);
        }
    }

    fn accelerate(&mut self, dt: f64) {
        let Setup { grid, particles, kernel, transfer, mass, boundary, .. } = &mut self.setup;
        let mut field = std::mem::take(&mut grid.acceleration);
        field.copy_from_slice(&grid.force);
        mass.solve(grid, &mut field);
        let advance = Advance { from: self.stands, to: self.time + 0.5 * dt, dt };
        for condition in boundary.iter_mut() {
            condition.hold_advance(&mut grid.velocity, &mut field, &advance);
        }
        (self.stands, self.advance) = (advance.to, advance);
        let passes = transfer.refine(kernel.as_ref(), particles, grid, boundary, &mut field);
        grid.acceleration = field;
        self.count(passes);
    }

    /// Lets effects have their say on velocities that have advanced by `dt` (s).
    pub(super) fn drive(&mut self, dt: f64) {
        for effect in &self.setup.effects {
            effect.drive_velocity(self.stands, dt, &mut self.setup.particles);
        }
    }

    /// Lets effects advance what they keep.
    fn advance_effects(&mut self, dt: f64) -> Result<(), Failure> {
        let Setup { grid, particles, kernel, effects, .. } = &mut self.setup;
        for effect in effects {
            let now = (self.time, dt);
            self.transfers += effect.advance(now, particles, kernel.as_ref(), grid)?;
        }
        Ok(())
    }

    fn position(&mut self, dt: f64) -> Result<(), Failure> {
        let Setup { grid, particles, kernel, frame, effects, .. } = &mut self.setup;
        std::mem::swap(particles.positions_mut(), &mut self.carried);
        for effect in effects {
            effect.drive_position(dt, particles);
        }
        if kernel.domain() == Domain::Follows && *frame == FrameName::Updated {
            particles.track_domains();
        }
        self.whereabouts.track(grid, particles)?;
        particles.moving_finite()?;
        self.count(1);
        Ok(())
    }

    pub(super) fn count(&mut self, passes: u64) {
        let pairs = self.setup.particles.len() as u64 * self.setup.kernel.support();
        self.transfers += passes * pairs;
    }
}

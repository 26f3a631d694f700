//! The solver: every stage of a step, one by one. [`step`](super::step) has their order.

use super::{
    algebra::Matrix, basis::Domain, boundary::Advance, effect::strain, frame::FrameName,
    grid::Grid, initial, particles::Particles, setup::Setup, stage::Stage, transfer::Transfer,
    whereabouts::Whereabouts,
};
use crate::subject::{Failure, Profile, Site};

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
    pub(super) whereabouts: Whereabouts<D>,
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
        let whereabouts = Whereabouts::new(&setup.grid, &setup.particles)?;
        let Setup { grid, particles, kernel, transfer, .. } = &mut setup;
        transfer.start(kernel.as_ref(), grid, particles);
        let (time, stands, started, frozen, transfers) = (0.0, 0.0, false, false, 0);
        let advance = Advance { from: 0.0, to: 0.0, dt: 0.0 };
        Ok(Self { setup, time, stands, advance, started, frozen, transfers, min_j, whereabouts })
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
        self.setup.profile(self.whereabouts.columns())
    }

    /// Runs one stage of a step of length `dt` (s).
    ///
    /// # Errors
    /// See [`Subject::step`](crate::subject::Subject::step).
    pub fn run(&mut self, stage: Stage, dt: f64) -> Result<(), Failure> {
        match stage {
            Stage::Mass => {
                self.mass()?;
                if self.started {
                    self.advance_effects(dt)?;
                }
            }
            Stage::Momentum => self.momentum(),
            Stage::Force => self.force(),
            Stage::Acceleration => self.accelerate(dt),
            Stage::GridVelocity => {
                let Grid { velocity, acceleration, .. } = &mut self.setup.grid;
                for (v, a) in velocity.iter_mut().zip(acceleration) {
                    *v += *a * dt;
                }
            }
            Stage::ParticleVelocity => {
                let Setup { grid, particles, kernel, transfer, boundary, .. } = &mut self.setup;
                let passes = transfer.g2p_velocity(kernel.as_ref(), grid, boundary, dt, particles);
                self.count(passes);
                self.drive(dt);
            }
            Stage::Stress => self.stress(dt)?,
            Stage::Position if self.frozen => {}
            Stage::Position => self.position(dt)?,
        }
        Ok(())
    }

    fn mass(&mut self) -> Result<(), Failure> {
        let Setup { grid, particles, kernel, transfer, mass, boundary, .. } = &mut self.setup;
        let passes = transfer.p2g_mass(kernel.as_ref(), particles, grid)
            + mass.assemble(kernel.as_ref(), particles, grid, boundary)?;
        self.count(passes);
        Ok(())
    }

    fn momentum(&mut self) {
        let Setup { grid, particles, kernel, transfer, mass, boundary, .. } = &mut self.setup;
        let mut field = std::mem::take(&mut grid.velocity);
        let passes = transfer.p2g_momentum(kernel.as_ref(), particles, grid, &mut field);
        mass.solve(grid, &mut field);
        for condition in boundary.iter() {
            condition.hold_velocity(&mut field, self.stands);
        }
        let refined = transfer.refine(kernel.as_ref(), particles, grid, boundary, &mut field);
        grid.velocity = field;
        self.count(passes + refined);
    }

    fn force(&mut self) {
        let Setup { grid, particles, kernel, transfer, effects, .. } = &mut self.setup;
        let passes = transfer.p2g_internal_force(kernel.as_ref(), particles, grid);
        for effect in effects.iter_mut() {
            self.transfers += effect.add_force(self.time, particles, kernel.as_ref(), grid);
        }
        for effect in &self.setup.effects {
            effect.oppose_motion(&mut self.setup.grid);
        }
        self.count(passes);
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

    fn stress(&mut self, dt: f64) -> Result<(), Failure> {
        let Setup { grid, particles, kernel, transfer, material, frame, effects, .. } =
            &mut self.setup;
        let passes = transfer.g2p_gradient(kernel.as_ref(), grid, particles);
        if *frame == FrameName::Total {
            particles.push_gradients_forward();
        }
        for (f, grad_v) in particles.def_grad.iter_mut().zip(&particles.grad_v) {
            *f = (Matrix::identity() + grad_v * dt) * *f;
        }
        strain(effects, material.as_mut(), dt, particles);
        self.count(passes);
        for (p, (vol, vol0)) in
            self.setup.particles.vol.iter().zip(&self.setup.particles.vol0).enumerate()
        {
            let (j, site) = (vol / vol0, Site::Particle(p));
            if !j.is_finite() {
                return Err(Failure::NonFinite { quantity: "J", site });
            }
            self.min_j = self.min_j.min(j);
            if j <= 0.0 {
                return Err(Failure::Inverted { site, j });
            }
        }
        self.setup.particles.strained_finite()
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
        kernel.g2p_position(grid, dt, particles);
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

//! Heat conduction in a body at rest, without mechanical stages and columns.

use super::cell_tracker::CellTracker;
use super::setup::{fields, profile};
use crate::mpm::basis::Domain;
use crate::mpm::effect::Effect;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::{Kernel, Tally};
use mpm_subject::{BodyFields, Column, Failure, Profile, RunCounters, Samples, Subject};

/// Solver for a body at rest. Nodal masses are computed once, and a step integrates the state of
/// the effects.
pub struct HeatSolver<const D: usize> {
    grid: Grid<D>,
    particles: Particles<D>,
    kernel: Box<dyn Kernel<D>>,
    effects: Vec<Box<dyn Effect<D>>>,
    time: f64,
    transfers: u64,
}

impl<const D: usize> HeatSolver<D> {
    /// Creates a body at t = 0.
    ///
    /// # Errors
    /// [`Failure::NonFinite`] if the initial state of a particle is not finite;
    /// [`Failure::LeftDomain`] if a particle is outside the grid.
    #[inline(never)]
    pub fn new(
        kernel: Box<dyn Kernel<D>>,
        mut grid: Grid<D>,
        mut particles: Particles<D>,
        effects: Vec<Box<dyn Effect<D>>>,
    ) -> Result<Self, Failure> {
        particles.all_finite()?;
        CellTracker::new(&grid, &particles)?;
        if kernel.domain() == Domain::Follows {
            particles.track_domains();
        }
        particles.forget_motion();
        grid.forget_motion();
        kernel.p2g_mass(&particles, &mut grid);
        let transfers = particles.len() as u64 * kernel.support();
        Ok(Self { grid, particles, kernel, effects, time: 0.0, transfers })
    }

    /// Returns the active effects, and all columns of particles and nodes.
    pub fn profile(&self) -> Profile {
        profile(&self.grid, &self.particles, &self.effects, &self.columns())
    }

    fn columns(&self) -> Vec<Column<'_>> {
        let mut columns = self.particles.columns();
        columns.extend(self.effects.iter().flat_map(|effect| effect.columns()));
        columns.extend(self.grid.columns());
        columns
    }

    /// Returns the number of visited particles, see
    /// [`Solver::take_visits`](super::solver::Solver::take_visits).
    pub fn take_visits(&self) -> Vec<(&'static str, u64)> {
        Tally::take(&[self.kernel.tally()])
    }
}

// Not inlined, so that tests and other crates link to the code compiled here.
impl<const D: usize> Subject for HeatSolver<D> {
    #[inline(never)]
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        let Self { grid, particles, kernel, effects, .. } = self;
        for effect in effects {
            let kernel = kernel.as_ref();
            self.transfers += effect.integrate_state(self.time, dt, particles, kernel, grid)?;
        }
        self.time += dt;
        Ok(())
    }

    #[inline(never)]
    fn sample(&self, samples: &mut Samples) {
        samples.clear();
        self.particles.sample(samples);
    }

    #[inline(never)]
    fn fields(&self) -> Vec<BodyFields> {
        vec![fields(&self.grid, &self.particles, &self.columns())]
    }

    fn counters(&self) -> RunCounters {
        RunCounters {
            particles: Some(self.particles.len() as u64),
            transfers: self.transfers,
            crossings: Some(0),
            left_domain: Some(0),
            min_j: 1.0,
        }
    }

    fn passes(&self) -> Vec<String> {
        let passes = self.effects.iter().flat_map(|effect| effect.state_passes());
        passes.map(|pass| (*pass).to_owned()).collect()
    }
}

//! Quasi-static MPM: the load grows in steps. In each step, Newton's method solves for the
//! equilibrium at the end of the step (Charlton, Coombs & Augarde 2017, Comput. Struct. 190; Coombs
//! & Augarde 2020, Adv. Eng. Softw. 139).
//!
//! Load step k of N:
//!
//! 1. evaluate the basis functions at the particles;
//! 2. solve `sum_p V0 tau(F') grad' N_i = (k/N) f_ext_i` for nodal displacement increments,
//!    starting from zero ([`balance`]);
//! 3. move the particles, `x += sum_i u_i N_i`, update F, the state of the law and the domains, and
//!    reset the grid.
//!
//! A body with the initial stress S0 is held at the start by the forces
//! `f_0 = sum_p V0 S0 F^T grad N_i`, which do not depend on the deformation. These forces are
//! removed while the load grows, so the right side of step 2 is `(k/N) f_ext_i + (1 - k/N) f_0_i`.
//! If S0 balances the full load, the body remains at rest.
//!
//! In a body of revolution, the hoop stretch F_33 is updated with the displacement at the particle,
//! `F_33 += sum_i N_i u_ir/R`, so it remains r/R.
//!
//! The particles store only F, the state of the law and positions: there is no velocity and no
//! transfer. If Newton's method does not converge, the load step is not divided, and the run fails.

mod balance;
mod banded;
mod newton;

use super::basis::Domain;
use super::boundary::{Boundary, Side};
use super::effect::{BodyOnGrid, Effect};
use super::foundation::algebra::{Matrix, Vector, identity, in_body, zeros};
use super::foundation::grid::Grid;
use super::foundation::particles::Particles;
use super::kernel::contract::{Kernel, Tally};
use super::material::{Material, StressUpdate};
use super::step::cell_tracker::CellTracker;
use super::step::initial;
use super::step::observables::wall_reaction;
use super::step::setup::{fields, profile};
use balance::{NO_TANGENT, StepEquations};
use mpm_subject::{
    BodyFields, Column, Failure, Profile, Reaction, RunCounters, Samples, Subject, Totals,
};

/// Parts of a quasi-static solver of one body.
pub struct QuasiStaticSetup<const D: usize> {
    /// The background grid.
    pub grid: Grid<D>,
    /// The undeformed body.
    pub particles: Particles<D>,
    /// Basis functions, compiled for the loops over particles and nodes.
    pub kernel: Box<dyn Kernel<D>>,
    /// The constitutive law.
    pub material: Box<dyn Material<D>>,
    /// Loads that depend neither on time nor on the deformation.
    pub effects: Vec<Box<dyn Effect<D>>>,
    /// Fixed walls.
    pub boundary: Vec<Box<dyn Boundary<D>>>,
    /// Number of load steps, each of length 1, that add up to the full load.
    pub load_steps: u64,
}

/// A body whose load grows in steps, in equilibrium after each step.
pub struct QuasiStatic<const D: usize> {
    setup: QuasiStaticSetup<D>,
    /// Sum of the lengths of the load steps so far. The current fraction of the load is this sum
    /// divided by [`QuasiStaticSetup::load_steps`].
    advanced: f64,
    transfers: u64,
    min_j: f64,
    cell_tracker: CellTracker<D>,
    /// Residuals of the iterates of the last load step, divided by the load of this step.
    residuals: Vec<f64>,
    /// Initial stress of each particle (Pa); empty if there is none.
    initial_stress: Vec<Matrix<D>>,
}

impl<const D: usize> QuasiStatic<D> {
    /// Creates a body without load.
    ///
    /// # Errors
    /// [`Failure::NonFinite`] or [`Failure::LeftDomain`] for an invalid particle;
    /// [`Failure::Solve`] for a law without a consistent tangent.
    #[inline(never)]
    pub fn new(mut setup: QuasiStaticSetup<D>) -> Result<Self, Failure> {
        let QuasiStaticSetup { grid, particles, kernel, material, effects, .. } = &mut setup;
        particles.track_deformation();
        for effect in effects.iter_mut() {
            effect.integrate_over_domain_ends();
        }
        let min_j = initial::complete(particles, kernel.domain(), material.as_mut())?;
        if material.response(0, &identity()).is_none() {
            return Err(Failure::Solve(NO_TANGENT.to_owned()));
        }
        let cell_tracker = CellTracker::new(grid, particles)?;
        let (advanced, transfers, residuals) = (0.0, 0, Vec::new());
        let is_stressed = particles.sigma.iter().any(|stress| *stress != zeros::<D, D>());
        let initial_stress = if is_stressed { particles.sigma.clone() } else { Vec::new() };
        Ok(Self { setup, advanced, transfers, min_j, cell_tracker, residuals, initial_stress })
    }

    /// Returns the residuals of the iterates in the last load step: norms over all nodes with
    /// unknowns, divided by the norm of the load. The first residual belongs to zero increments.
    pub fn residuals(&self) -> &[f64] {
        &self.residuals
    }

    /// Returns the particles in their current state.
    pub fn particles(&self) -> &Particles<D> {
        &self.setup.particles
    }

    /// Returns the active effects, and all columns of particles and nodes.
    pub fn profile(&self) -> Profile {
        let QuasiStaticSetup { grid, particles, effects, .. } = &self.setup;
        profile(grid, particles, effects, &self.columns())
    }

    /// Returns the number of visited particles, see
    /// [`Solver::take_visits`](super::Solver::take_visits).
    pub fn take_visits(&self) -> Vec<(&'static str, u64)> {
        Tally::take(&[self.setup.kernel.tally()])
    }

    fn columns(&self) -> Vec<Column<'_>> {
        let QuasiStaticSetup { grid, particles, material, effects, boundary, .. } = &self.setup;
        let mut columns = particles.columns();
        columns.push(self.cell_tracker.columns());
        columns.extend(material.columns());
        columns.extend(effects.iter().flat_map(|effect| effect.columns()));
        columns.extend(grid.columns());
        columns.extend(boundary.iter().flat_map(|condition| condition.columns()));
        columns
    }

    /// Computes the external nodal forces of the full load (N) and stores them in the grid.
    fn load(&mut self) {
        let QuasiStaticSetup { grid, particles, kernel, effects, .. } = &mut self.setup;
        grid.force.fill(zeros());
        kernel.p2g_mass(particles, grid);
        let mut body = BodyOnGrid { particles, kernel: kernel.as_ref(), grid };
        for effect in effects {
            self.transfers += effect.add_force(0.0, &mut body);
        }
    }

    /// Moves the particles by the increments of a load step (m), and updates F, the state of the
    /// law, volumes, stresses and domains.
    fn advance(
        &mut self,
        balance: &StepEquations<D>,
        increment: &[Vector<D>],
    ) -> Result<(), Failure> {
        let QuasiStaticSetup { grid, particles, kernel, material, .. } = &mut self.setup;
        for p in 0..particles.len() {
            let stretch = balance.stretch(p, increment);
            particles.def_grad[p] = in_body::<D>(&stretch) * particles.def_grad[p];
            if let Some(across) = particles.across.get_mut(p) {
                *across *= stretch[(2, 2)];
            }
            for function in balance.functions_of(p) {
                particles.x[p] += increment[function.node] * function.weight;
            }
        }
        // F already has its value at the end of the step.
        material.update(&mut StressUpdate::new(0.0, particles));
        if kernel.domain() == Domain::Follows {
            particles.track_domains();
        }
        particles.volumes_positive(&mut self.min_j)?;
        particles.stressed_finite()?;
        self.cell_tracker.track(grid, particles)
    }
}

// Not inlined, so that tests and other crates link to the code compiled here.
impl<const D: usize> Subject for QuasiStatic<D> {
    /// Performs one load step of length `dt`, which is 1/2 in a reference run with steps of half
    /// the length.
    #[inline(never)]
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        self.advanced += dt;
        self.load();
        let share = self.advanced / self.setup.load_steps as f64;
        let QuasiStaticSetup { grid, particles, kernel, material, boundary, .. } = &mut self.setup;
        let mut load: Vec<Vector<D>> = grid.force.iter().map(|force| force * share).collect();
        let balance = StepEquations::new(grid, particles, kernel.as_ref(), boundary)?;
        balance.add_holding_forces(&self.initial_stress, particles, 1.0 - share, &mut load);
        let solution = newton::solve(&balance, particles, material.as_ref(), &load);
        self.residuals = solution.residuals;
        // For each iterate, the computation of the stress and that of the tangent each visit the
        // nodes of all particles.
        let passes = 2 * self.residuals.len() as u64;
        self.transfers += passes * balance.pairs();
        let iterate = solution.last?;
        for (force, residual) in grid.force.iter_mut().zip(&iterate.residual) {
            *force = -residual;
        }
        self.advance(&balance, &iterate.increment)
    }

    #[inline(never)]
    fn sample(&self, samples: &mut Samples) {
        samples.clear();
        self.setup.particles.sample_with(self.setup.material.as_ref(), samples);
    }

    fn counters(&self) -> RunCounters {
        let transfers = RunCounters::new(self.transfers);
        self.cell_tracker.counters(RunCounters { min_j: self.min_j, ..transfers })
    }

    fn passes(&self) -> Vec<String> {
        let passes = ["P2G(external force)", "Newton(stress, tangent)", "G2P(position, F)"];
        passes.map(ToOwned::to_owned).to_vec()
    }

    #[inline(never)]
    fn fields(&self) -> Vec<BodyFields> {
        vec![fields(&self.setup.grid, &self.setup.particles, &self.columns())]
    }

    #[inline(never)]
    fn totals(&self) -> Option<Totals> {
        let QuasiStaticSetup { particles, material, .. } = &self.setup;
        let strain_energy = material.energy(particles);
        Some(Totals { strain_energy, ..particles.totals(|_| None) })
    }

    /// Returns the reaction. [`Reaction::time`] is the sum of the lengths of the load steps.
    fn reaction(&self, face: Option<(usize, bool)>) -> Option<Reaction> {
        let QuasiStaticSetup { grid, boundary, .. } = &self.setup;
        let side = |high| if high { Side::High } else { Side::Low };
        let face = face.map(|(axis, high)| (axis, side(high)));
        let force = wall_reaction(&grid.force, boundary, face);
        (self.advanced > 0.0).then_some(Reaction { time: self.advanced, force })
    }
}

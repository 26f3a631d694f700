//! Several bodies on one grid.
//!
//! Each body is a [`Solver`] with its own particles, material, effects and fields, on a separate
//! grid with the same geometry. All bodies run each pass. The bodies are then coupled at the nodes
//! to which more than one body contributes mass:
//!
//! - [`SharedVelocity`]: the bodies have a common velocity and acceleration at these nodes, and are
//!   bonded permanently. The original MPM does not distinguish bodies and has the same effect
//!   (Sulsky, Chen & Schreyer 1994);
//! - [`Contact`]: each body has its own velocity, and approaching bodies exchange impulses.
//!
//! A single body has no coupling.

mod contact;
mod coupling;

use super::kernel::contract::Tally;
use super::step::schedule::{Coupled, Pass, StepSchedule};
use super::step::setup::Setup;
use super::step::solver::Solver;
use contact::Contact;
use coupling::{Coupling, SharedVelocity};
use mpm_subject::{
    BodyFields, ColumnSize, Failure, Perturbable, Profile, RunCounters, Samples, Site, Subject,
    Totals,
};

/// Bodies on a common grid. Particles are numbered over all bodies, one body after another.
pub struct Bodies<const D: usize> {
    solvers: Vec<Solver<D>>,
    /// Coupling at interface nodes; `None` for a single body.
    coupling: Option<Box<dyn Coupling<D>>>,
    schedule: StepSchedule,
}

impl<const D: usize> Bodies<D> {
    /// Creates bodies at t = 0, with contact if a coefficient of friction is given. All bodies must
    /// have the same grid, scheme and start.
    ///
    /// # Errors
    /// Failures of [`Solver::new`], and [`Failure::Solve`] for bodies on different grids.
    #[inline(never)]
    pub fn new(setups: Vec<Setup<D>>, friction: Option<f64>) -> Result<Self, Failure> {
        let mut solvers: Vec<Solver<D>> = Vec::new();
        for setup in setups {
            let first = particles(&solvers);
            let solver = Solver::new(setup).map_err(|failure| among(failure, first))?;
            if solvers.first().is_some_and(|known| known.grid().counts != solver.grid().counts) {
                return Err(Failure::Solve(
                    "bodies must share one grid, but these have two".into(),
                ));
            }
            solvers.push(solver);
        }
        let coupling: Option<Box<dyn Coupling<D>>> = match friction {
            _ if solvers.len() < 2 => None,
            Some(friction) => Some(Box::new(Contact::new(&solvers, friction))),
            None => Some(Box::new(SharedVelocity::new(solvers[0].grid().nodes()))),
        };
        let mut bodies = Self { solvers, coupling, schedule: StepSchedule::default() };
        bodies.compile(false);
        Ok(bodies)
    }

    /// Returns the solver of each body.
    pub fn solvers(&self) -> &[Solver<D>] {
        &self.solvers
    }

    /// Returns the profile of a step of all bodies and their coupling.
    pub fn profile(&self) -> Profile {
        let coupling = self.coupling.as_deref();
        joint_profile(self.solvers.iter().map(Solver::profile), coupling)
    }

    /// Returns the numbers of visited particles, summed over all bodies, see
    /// [`Solver::take_visits`].
    pub fn take_visits(&self) -> Vec<(&'static str, u64)> {
        let tallies = self.solvers.iter().map(|solver| solver.setup.kernel.tally());
        Tally::take(&tallies.collect::<Vec<_>>())
    }

    /// Compiles the schedule from the schedule of the first body and the coupling of all bodies.
    fn compile(&mut self, fixed_configuration: bool) {
        let reads_velocity = self.coupling.as_ref().is_some_and(|c| c.reads_velocity());
        let coupled = Coupled { bodies: self.coupling.is_some(), reads_velocity };
        if let Some(one) = self.solvers.first_mut() {
            self.schedule = StepSchedule::new(&mut one.setup, coupled, fixed_configuration);
        }
    }

    /// Runs `passes` one after another, each on all bodies.
    fn run_all(&mut self, passes: &[Pass], dt: f64) -> Result<(), Failure> {
        for &pass in passes {
            let mut first = 0;
            for solver in &mut self.solvers {
                solver.run(pass, dt).map_err(|failure| among(failure, first))?;
                first += solver.particles().len();
            }
            if let (Pass::Couple(at), Some(coupling)) = (pass, &mut self.coupling) {
                coupling.couple(at, &mut self.solvers, dt);
            }
        }
        Ok(())
    }
}

fn particles<const D: usize>(solvers: &[Solver<D>]) -> usize {
    solvers.iter().map(|solver| solver.particles().len()).sum()
}

// Not inlined, so that tests and other crates link to the code compiled here.
impl<const D: usize> Subject for Bodies<D> {
    #[inline(never)]
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        let StepSchedule { opening, passes } = self.schedule.clone();
        if self.solvers.iter().any(|solver| !solver.started) {
            self.solvers.iter_mut().for_each(|solver| solver.open(dt));
            self.run_all(&opening, dt)?;
            self.solvers.iter_mut().for_each(|solver| solver.opened(dt));
        }
        self.run_all(&passes, dt)?;
        self.solvers.iter_mut().for_each(|solver| solver.time += dt);
        Ok(())
    }

    #[inline(never)]
    fn sample(&self, samples: &mut Samples) {
        samples.clear();
        for solver in &self.solvers {
            solver.particles().sample_with(solver.setup.material.as_ref(), samples);
        }
        // The column must be empty if a body has no deformation gradients.
        if samples.deformation_gradient.len() != samples.len() * D * D {
            samples.deformation_gradient.clear();
        }
    }

    #[inline(never)]
    fn fields(&self) -> Vec<BodyFields> {
        self.solvers.iter().flat_map(Subject::fields).collect()
    }

    #[inline(never)]
    fn totals(&self) -> Option<Totals> {
        self.solvers.iter().filter_map(Solver::totals).reduce(Totals::plus)
    }

    fn counters(&self) -> RunCounters {
        let all = || self.solvers.iter().map(Solver::counters);
        RunCounters {
            particles: all().map(|counters| counters.particles).sum(),
            transfers: all().map(|counters| counters.transfers).sum(),
            crossings: all().map(|counters| counters.crossings).sum(),
            left_domain: all().map(|counters| counters.left_domain).sum(),
            min_j: all().map(|counters| counters.min_j).fold(f64::INFINITY, f64::min),
        }
    }

    /// Returns the passes of the first body, whose schedule all bodies share, and of the coupling.
    fn passes(&self) -> Vec<String> {
        let state = self.solvers.first().map(|one| one.setup.state_passes());
        self.schedule.texts(&state.unwrap_or_default())
    }
}

/// Renumbers the particle in a failure. `first` is the number of the body's first particle.
pub(in crate::mpm) fn among(failure: Failure, first: usize) -> Failure {
    let shifted = |site: Site| match site {
        Site::Particle(p) => Site::Particle(first + p),
        other => other,
    };
    match failure {
        Failure::NonFinite { quantity, site } => {
            Failure::NonFinite { quantity, site: shifted(site) }
        }
        Failure::Inverted { site, j } => Failure::Inverted { site: shifted(site), j },
        Failure::LeftDomain { site, position } => {
            Failure::LeftDomain { site: shifted(site), position }
        }
        other => other,
    }
}

/// Combines the profiles of all bodies and their coupling into one. Nodes are summed over the grids
/// of all bodies.
pub(in crate::mpm) fn joint_profile<const D: usize>(
    bodies: impl Iterator<Item = Profile>,
    coupling: Option<&dyn Coupling<D>>,
) -> Profile {
    let mut all = Profile::default();
    for body in bodies {
        all.particles += body.particles;
        all.nodes += body.nodes;
        for effect in body.effects {
            if !all.effects.contains(&effect) {
                all.effects.push(effect);
            }
        }
        add_columns(&mut all.columns, body.columns);
    }
    if let Some(coupling) = coupling {
        all.effects.extend(coupling.name());
        let sizes = coupling.columns().into_iter().map(|column| column.size);
        all.columns.extend(sizes.filter(|column| column.entries > 0));
    }
    all
}

/// Adds the columns of one body to `all`. Columns of the same kind are added to each other. If a
/// body has several columns of one kind, for example for two walls, their order decides which ones
/// are added.
fn add_columns(all: &mut Vec<ColumnSize>, body: Vec<ColumnSize>) {
    let kind = |column: &ColumnSize| (column.name, column.holder, column.bytes);
    let known = all.len();
    let mut taken = vec![false; known];
    for column in body {
        let same = (0..known).find(|&k| !taken[k] && kind(&all[k]) == kind(&column));
        match same {
            Some(k) => {
                taken[k] = true;
                all[k].entries += column.entries;
            }
            None => all.push(column),
        }
    }
}

impl<const D: usize> Perturbable for Bodies<D> {
    fn fix_configuration(&mut self) {
        self.solvers.iter_mut().for_each(Perturbable::fix_configuration);
        self.compile(true);
    }

    fn state(&self, state: &mut Vec<f64>) {
        joined(state, self.solvers.iter(), Perturbable::state);
    }

    fn set_state(&mut self, state: &[f64]) {
        let (mut rest, mut own) = (state, Vec::new());
        for solver in &mut self.solvers {
            solver.state(&mut own);
            let (mine, others) = rest.split_at(own.len().min(rest.len()));
            solver.set_state(mine);
            rest = others;
        }
    }

    fn sizes(&self, speed: f64, modulus: f64, sizes: &mut Vec<f64>) {
        joined(sizes, self.solvers.iter(), |solver, own| solver.sizes(speed, modulus, own));
    }
}

/// Concatenates the numbers that `give` writes for each body.
fn joined<T>(all: &mut Vec<f64>, each: impl Iterator<Item = T>, give: impl Fn(T, &mut Vec<f64>)) {
    all.clear();
    let mut own = Vec::new();
    for one in each {
        give(one, &mut own);
        all.extend_from_slice(&own);
    }
}

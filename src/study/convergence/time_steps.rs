//! Time steps of levels: the stable step, the step by rule, and the steps that runs take.
//!
//! The stable step comes from [`crate::mpm::Solver::stable_time_step`], for the solver's own stages
//! and the state at the start, and is at most `h/(c + |v|)`: neither a wave nor a particle crosses
//! more than a cell. It is predicted before a run and holds for all of it, so that each level has
//! one step and its order has a meaning. Where particles with linear functions move, later steps
//! may have shorter limits (`tiny-nodal-mass`). The share of the rule is a margin for these.

use crate::mpm::simplest_with_same_response;
use crate::study::kind::StepWarning;
use crate::study::setup::dispatch;
use crate::subject::Start;
use crate::suite::compile::check::size::particles;
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::{Extent, LevelPlan};
use crate::suite::model::{Case, ConvergencePlan, Suite};
use crate::verify::{Clock, STEP_TOLERANCE};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// The time step on one level of a case.
#[derive(Debug, Clone)]
pub struct TimeStep {
    /// Name of the case.
    pub case: String,
    /// The level.
    pub level: LevelPlan,
    /// Step that the suite asks for (s).
    pub wanted: f64,
    /// Steps that are taken.
    pub clock: Clock,
}

impl TimeStep {
    /// Share of the wanted step that is taken.
    pub fn ratio(&self) -> f64 {
        self.clock.dt() / self.wanted
    }
}

/// The time steps of all cases and levels of `suite`; none for a study that takes no steps or
/// chooses them as it runs. Levels that cannot be set up are left out: a run says why.
pub fn time_steps(suite: &Suite, extent: Extent) -> Vec<TimeStep> {
    let Some(plan) = suite.plan::<ConvergencePlan>() else { return Vec::new() };
    let steps = StableSteps::default();
    let mut found = Vec::new();
    for case in &plan.cases {
        for level in plan.refine.levels(extent) {
            // A stated step is known without a look at the particles.
            let stepped = match plan.refine.rule {
                Some(_) => steps.of(plan, case, *level).map(|(level, _)| level),
                None => Ok(*level),
            };
            let Ok(level) = stepped else { continue };
            let Some(clock) = case.clock(plan, level.dt) else { continue };
            let (case, wanted) = (case.name.clone(), level.dt);
            found.push(TimeStep { case, level, wanted, clock });
        }
    }
    found
}

/// One level of a case, before it runs.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedLevel {
    /// Cells along the first axis.
    pub cells: u64,
    /// Cell size (m).
    pub h: f64,
    /// Particles, to rounding.
    pub particles: f64,
    /// Time step (s).
    pub dt: f64,
    /// Number of steps.
    pub steps: u64,
    /// Courant number c dt/h, with the speed c of the fastest wave in the body at rest.
    pub courant: f64,
}

/// The levels of the gate of each case, in order; none of a study without levels.
pub fn planned_levels(suite: &Suite) -> Vec<(String, Vec<PlannedLevel>)> {
    let Some(plan) = suite.plan::<ConvergencePlan>() else { return Vec::new() };
    let waves = plan.scene.fastest_wave();
    let mut all: Vec<(String, Vec<PlannedLevel>)> = Vec::new();
    for TimeStep { case, level, clock, .. } in time_steps(suite, Extent::Usual) {
        let planned = PlannedLevel {
            cells: level.cells,
            h: level.h,
            particles: level.ppc.map_or(0.0, |_| particles(&plan.scene, level)),
            dt: clock.dt(),
            steps: clock.steps,
            courant: waves * clock.dt() / level.h,
        };
        match all.last_mut().filter(|(known, _)| *known == case) {
            Some((_, levels)) => levels.push(planned),
            None => all.push((case, vec![planned])),
        }
    }
    all
}

/// Rounds of the prediction that a rule takes its step from.
pub(crate) const ROUNDS: u32 = 40;

/// Rounds of the prediction that a stated step is held against first: as expensive as so many
/// steps.
const FEW: u32 = 6;

/// Share of the limit from few rounds above which a step is held against more rounds: few rounds
/// overestimate the limit by up to one half.
const NEAR: f64 = 0.6;

/// A level with the step that is taken on it, and the stable time step (s) where that is known.
type Stepped = (LevelPlan, Option<f64>);

/// Stable time steps (s) of a study, by what they depend on: those of methods that share one, and
/// of levels that differ in their step only, are predicted once.
#[derive(Debug, Default)]
pub(crate) struct StableSteps(Mutex<BTreeMap<String, Result<f64, String>>>);

impl StableSteps {
    /// The step on one level.
    pub(crate) fn of(
        &self,
        plan: &ConvergencePlan,
        case: &Case,
        level: LevelPlan,
    ) -> Result<Stepped, String> {
        let Method::Mpm { .. } = case.method else { return Ok((level, None)) };
        let limit = |rounds| self.limit(plan, case.method, level, rounds);
        if let Some(share) = plan.refine.rule {
            let limit = limit(ROUNDS)?;
            return Ok((LevelPlan { dt: share * limit, ..level }, Some(limit)));
        }
        // Iterations that have not settled give more than there is. A level that cannot be set up
        // says so when it is run.
        let taken = taken(plan, case, level);
        let is_suspect = limit(FEW).is_ok_and(|limit| taken > NEAR * limit);
        let limit = if is_suspect { limit(ROUNDS).ok() } else { None };
        Ok((level, limit.filter(|limit| taken > *limit)))
    }

    fn limit(
        &self,
        plan: &ConvergencePlan,
        method: Method,
        level: LevelPlan,
        rounds: u32,
    ) -> Result<f64, String> {
        let method = simplest(method);
        let key = format!("{method:?} {:?} {rounds}", LevelPlan { dt: 0.0, ..level });
        let known = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = known().get(&key) {
            return found.clone();
        }
        let found = dispatch::stable_time_step(plan, method, level, rounds);
        known().insert(key, found.clone());
        found
    }

    /// Warnings about the levels and the fine grids that run, in their order.
    pub(crate) fn warnings(&self, plan: &ConvergencePlan, extent: Extent) -> Vec<StepWarning> {
        let levels = plan.refine.levels(extent);
        let each = |case: &Case| levels.iter().copied().chain(case.against.fine_grid());
        let runs = (0..plan.cases.len())
            .flat_map(|case| each(&plan.cases[case]).map(move |level| (case, level)));
        let runs: Vec<(usize, LevelPlan)> = runs.collect();
        let said = |(case, level)| {
            let stepped = self.of(plan, &plan.cases[case], level).ok()?;
            let (text, is_too_long) = warning(plan, &plan.cases[case], stepped)?;
            Some(StepWarning { case, text, is_too_long })
        };
        runs.into_par_iter().filter_map(said).collect()
    }
}

/// The simplest method with the stable time step of `method`.
fn simplest(method: Method) -> Method {
    let Method::Mpm { basis, transfer, scheme, mass, frame, volume, .. } = method else {
        return method;
    };
    let (scheme, transfer) = simplest_with_same_response(scheme, transfer);
    Method::Mpm { basis, transfer, scheme, start: Start::AtZero, mass, frame, volume }
}

/// The step (s) that is taken.
fn taken(plan: &ConvergencePlan, case: &Case, level: LevelPlan) -> f64 {
    case.clock(plan, level.dt).map_or(level.dt, |clock| clock.dt())
}

/// Warning about a step that is longer than the stable time step, or not the one asked for, and
/// whether it is too long.
fn warning(plan: &ConvergencePlan, case: &Case, (level, limit): Stepped) -> Option<(String, bool)> {
    let clock = case.clock(plan, level.dt)?;
    let (dt, name, cells) = (clock.dt(), &case.name, level.cells);
    if let Some(limit) = limit.filter(|limit| dt > *limit) {
        let times = dt / limit;
        let text = format!(
            "{name}, {cells} cells: dt = {dt:.4e} s is {times:.2} times the stable time \
             step, {limit:.4e} s"
        );
        return Some((text, true));
    }
    let (ratio, steps) = (dt / level.dt, clock.steps);
    let is_near = (ratio - 1.0).abs() <= STEP_TOLERANCE;
    (!is_near).then(|| {
        let text = format!(
            "{name}, {cells} cells: the run takes {steps} steps of {dt:.4e} s, {ratio:.3} times what \
             the suite asks for; a longer run, or a step that divides it, would take the step itself"
        );
        (text, false)
    })
}

//! Time steps of levels: the stable, the automatic and the actual step.
//!
//! [`crate::mpm::Solver::stable_time_step`] computes the stable step from the solver stages and the
//! initial state. The step is at most `h/(c + |v|)`, so neither a wave nor a particle crosses more
//! than one cell. Each level has one constant step, because otherwise no order could be observed.
//! With linear basis functions the stability limit may decrease when particles move (suite
//! `tiny-nodal-mass`), so an automatic step is a fraction of the stable step.

use crate::mpm::input::MpmMethod;
use crate::mpm::simplest_with_same_response;
use crate::study::kind::StepWarning;
use crate::study::setup::dispatch;
use crate::subject::{Precision, Start, SubjectError};
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::{Extent, LevelPlan};
use crate::suite::model::{Case, ConvergencePlan, Suite};
use crate::verify::{Clock, STEP_TOLERANCE, StepKind, grouped};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// Requested and actual time step on one level of a case.
#[derive(Debug, Clone)]
pub struct TimeStep {
    /// Name of the case.
    pub case: String,
    /// Level that has this time step.
    pub level: LevelPlan,
    /// Requested time step (s).
    pub wanted: f64,
    /// Actual steps of the run.
    pub clock: Clock,
}

impl TimeStep {
    /// Returns the ratio of the actual step to the requested step.
    pub fn ratio(&self) -> f64 {
        self.clock.dt() / self.wanted
    }
}

/// Computes the time steps of all cases and levels of `suite`; empty unless it is a convergence
/// study. Levels whose set-up fails are excluded, because the run reports the reason.
pub fn time_steps(suite: &Suite, extent: Extent) -> Vec<TimeStep> {
    let Some(plan) = suite.convergence() else { return Vec::new() };
    let steps = StableSteps::default();
    let mut found = Vec::new();
    for case in &plan.cases {
        for level in plan.refine.levels(extent) {
            // A time step that the suite states needs no prediction.
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
    /// Number of particles, estimated from the volume of the body.
    pub particles: f64,
    /// Time step (s).
    pub dt: f64,
    /// Number of steps.
    pub steps: u64,
    /// Courant number c dt/h with the fastest wave speed c at rest; `None` for load steps.
    pub courant: Option<f64>,
}

/// Returns the levels of each case, in order; empty for a study without levels.
pub fn planned_levels(suite: &Suite) -> Vec<(String, Vec<PlannedLevel>)> {
    let Some(plan) = suite.convergence() else { return Vec::new() };
    let waves = plan.scene.fastest_wave();
    let planned = |TimeStep { case, level, clock, .. }: TimeStep| {
        let planned = PlannedLevel {
            cells: level.cells,
            h: level.h,
            particles: level.ppc.map_or(0.0, |_| level.particles(&plan.scene)),
            dt: clock.dt(),
            steps: clock.steps,
            courant: (plan.steps == StepKind::Time).then(|| waves * clock.dt() / level.h),
        };
        (case, planned)
    };
    grouped(time_steps(suite, Extent::Usual).into_iter().map(planned))
}

/// Number of power iterations in the prediction of an automatic time step.
pub(crate) const ROUNDS: u32 = 40;

/// Number of power iterations in the first prediction for a time step from the suite. Each
/// iteration costs as much as a step.
const FEW: u32 = 6;

/// Fraction of the first predicted limit above which a second prediction is made. With few
/// iterations, the first limit is up to 50 % too large.
const NEAR: f64 = 0.6;

/// A level with its time step, and the stable time step (s) if it is known.
type Stepped = (LevelPlan, Option<f64>);

/// Stable time steps (s) of a study, by the inputs of their prediction.
#[derive(Debug, Default)]
pub(crate) struct StableSteps(Mutex<BTreeMap<String, Result<f64, SubjectError>>>);

impl StableSteps {
    /// Returns the level with its time step. The stable step is included if the time step is
    /// automatic or too long.
    pub(crate) fn of(
        &self,
        plan: &ConvergencePlan,
        case: &Case,
        level: LevelPlan,
    ) -> Result<Stepped, SubjectError> {
        let Method::Mpm(_) = case.method else { return Ok((level, None)) };
        let limit = |rounds| self.limit(plan, case.method, level, rounds);
        if let Some(share) = plan.refine.rule {
            let limit = limit(ROUNDS)?;
            return Ok((LevelPlan { dt: share * limit, ..level }, Some(limit)));
        }
        // Few iterations overestimate the limit. A failed set-up is not reported here, because the
        // run reports it.
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
    ) -> Result<f64, SubjectError> {
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

    /// Returns the warnings about levels and fine grids of references, in the order of their runs.
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

fn simplest(method: Method) -> Method {
    let Method::Mpm(method) = method else { return method };
    let (scheme, transfer) = simplest_with_same_response(method.scheme, method.transfer);
    let (start, precision) = (Start::AtZero, Precision::Double);
    Method::Mpm(MpmMethod { transfer, scheme, start, precision, ..method })
}

/// Returns the actual time step (s).
fn taken(plan: &ConvergencePlan, case: &Case, level: LevelPlan) -> f64 {
    case.clock(plan, level.dt).map_or(level.dt, |clock| clock.dt())
}

/// Returns a warning about a step that is longer than the stable step or differs from the requested
/// step, and whether the step is too long.
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
            "{name}, {cells} cells: the run takes {steps} steps of {dt:.4e} s, {ratio:.3} times \
             the stated step, because the stated step does not divide the run"
        );
        (text, false)
    })
}

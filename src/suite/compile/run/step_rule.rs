//! Time steps by rule: a share of the longest safe step, level by level.
//!
//! The prediction is that of [`crate::mpm::Solver::safe_step`], from the solver's own stages and the state at
//! the start, and no more than `h/(c + |v|)`: a wave, and a particle, crosses no more than a cell. It
//! is made before a run and holds for all of it, so that a level has one step and orders mean something.
//! Where linear particles move, later steps may have shorter limits (`tiny-nodal-mass`): for these is the
//! share.

use crate::{
    study::build::dispatch,
    suite::{
        compile::{evaluator::Evaluator, path::Path},
        grammar::{MethodSpec, StepSpec},
        model::{
            Case, ConvergencePlan, Scene,
            method::Method,
            refine_plan::{Extent, LevelPlan},
        },
        yaml::{Diagnostic, NumberText},
    },
    verify::Clock,
};
use rayon::prelude::*;
use std::{
    collections::BTreeMap,
    sync::{Mutex, PoisonError},
};

/// The share that `auto` takes.
const AUTO: f64 = 0.5;

/// Rounds of the prediction that a rule takes its step from.
pub(crate) const ROUNDS: u32 = 40;

/// Rounds of the one that a stated step is held against first: as dear as so many steps.
const FEW: u32 = 6;

/// Share of what the few rounds give from which on it is looked at more closely: they give up to half
/// as much again as there is.
const NEAR: f64 = 0.6;

/// The share of the longest safe step that `words` at `path` ask for, if they are a rule.
pub(crate) fn share(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &StepSpec,
) -> Result<Option<f64>, Diagnostic> {
    match words {
        StepSpec::Length(_) => Ok(None),
        StepSpec::Auto => Ok(Some(AUTO)),
        StepSpec::Courant(text) => evaluator
            .positive(&path.then("courant"), text, "the share of the stable step")
            .map(Some),
    }
}

/// The step (s) as a formula of h: as stated, or, by a rule, what it is without looking at the particles.
pub(crate) fn formula_text(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &StepSpec,
    scene: &Scene,
) -> Result<NumberText, Diagnostic> {
    let share = match (words, share(evaluator, path, words)?) {
        (StepSpec::Length(text), _) => return Ok(text.clone()),
        (_, share) => share.unwrap_or(AUTO),
    };
    let speed = scene.each().iter().map(Scene::wave_speed).fold(0.0, f64::max);
    if speed > 0.0 && speed.is_finite() {
        let [share, speed] = [share, speed].map(NumberText::Number);
        return Ok(NumberText::Formula(format!("{share}*h/{speed}")));
    }
    let message = "a time step is chosen by the speed of waves, and this body has none";
    Err(evaluator.diagnostic(path, message).with_label("expected a number"))
}

/// Refuses methods whose steps no rule can choose.
pub(crate) fn check(
    evaluator: &Evaluator<'_>,
    methods: &[MethodSpec],
    rule: Option<f64>,
) -> Result<(), Diagnostic> {
    let other = methods.iter().position(|method| !matches!(method, MethodSpec::Mpm { .. }));
    let (Some(i), Some(_)) = (other, rule) else { return Ok(()) };
    let message = "the time step is chosen by a rule, which is one for the steps of MPM in motion";
    let diagnostic = evaluator.diagnostic(&Path::top("methods").then(i), message);
    Err(diagnostic
        .with_help("state `dt` as a number or a formula of h, or put this into a suite of its own"))
}

/// A level with the step that is taken on it, and the longest safe one (s) where that is known.
type Stepped = (LevelPlan, Option<f64>);

/// The steps of the levels of each case, each looked for once.
#[derive(Debug, Default)]
pub(crate) struct Steps(Mutex<BTreeMap<String, Result<Stepped, String>>>);

impl Steps {
    /// The step on one level.
    pub(crate) fn of(
        &self,
        plan: &ConvergencePlan,
        case: &Case,
        level: LevelPlan,
    ) -> Result<Stepped, String> {
        let key = format!("{} {level:?}", case.name);
        let known = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = known().get(&key) {
            return found.clone();
        }
        let found = stepped(plan, case, level);
        known().insert(key, found.clone());
        found
    }

    /// What is to be said of the levels that run, in their order.
    pub(crate) fn warnings(&self, plan: &ConvergencePlan, extent: Extent) -> Vec<String> {
        let levels = plan.refine.levels(extent);
        let each = |case| levels.iter().map(move |level| (case, *level));
        let runs: Vec<(&Case, LevelPlan)> = plan.cases.iter().flat_map(each).collect();
        let said = |(case, level)| warning(plan, case, self.of(plan, case, level).ok()?);
        runs.into_par_iter().filter_map(said).collect()
    }
}

fn stepped(plan: &ConvergencePlan, case: &Case, level: LevelPlan) -> Result<Stepped, String> {
    let Method::Mpm { .. } = case.method else { return Ok((level, None)) };
    if let Some(share) = plan.refine.rule {
        let limit = dispatch::safe_step(plan, case.method, level, ROUNDS)?;
        return Ok((LevelPlan { dt: share * limit, ..level }, Some(limit)));
    }
    // A level that cannot be set up says so when it is run.
    let limit = |rounds| dispatch::safe_step(plan, case.method, level, rounds).ok();
    // Iterations that have not settled give more than there is.
    let taken = taken(plan, case, level);
    let suspect = limit(FEW).is_some_and(|limit| taken > NEAR * limit);
    let limit = if suspect { limit(ROUNDS) } else { None };
    Ok((level, limit.filter(|limit| taken > *limit)))
}

/// The step (s) that ends at the instants.
fn taken(plan: &ConvergencePlan, case: &Case, level: LevelPlan) -> f64 {
    Clock::new(case.until, level.dt, plan.instants).map_or(level.dt, |clock| clock.dt())
}

/// What is said of a step that is longer than the longest safe one.
fn warning(plan: &ConvergencePlan, case: &Case, (level, limit): Stepped) -> Option<String> {
    let (dt, limit) = (taken(plan, case, level), limit?);
    (dt > limit).then(|| {
        let (cells, times) = (level.cells, dt / limit);
        format!(
            "{}, {cells} cells: dt = {dt:.4e} s is {times:.2} times the longest \
             safe step, {limit:.4e} s",
            case.name
        )
    })
}

//! Runs levels again with other settings if the verdict depends on the results.
//!
//! - To find why the error has stopped decreasing (an error floor), the finest level runs again
//!   with half the spacing on another axis.
//! - Some suites have one time step on all levels. In a solver that is accurate in space, the error
//!   of this step may dominate, so that the total error stops decreasing or has a low order. If an
//!   external solver then misses the requirement of `run --gate`, the levels run again with shorter
//!   steps.

use super::judge_plan::{JudgePlan, LevelRun, series, usable_series};
use crate::verify::{
    Acceptance, Axis, Floor, GateResult, Judgement, LevelOutcome, Probe, Requirement, Verdict,
};
use rayon::prelude::*;
use std::fmt::Display;

/// Runs levels of a case again.
pub trait Reruns: Sync {
    /// Reason why a level cannot be run.
    type Error: Display + Send;

    /// Whether halving a spacing can reveal which axis causes an error. False if the reference is
    /// computed by the same method, because the spacings of the reference are not halved.
    fn can_halve(&self) -> bool;

    /// Runs the level with half the spacing on an axis; `None` if the level has no such spacing.
    fn run_halved(&self, level: &LevelOutcome, axis: Axis)
    -> Option<Result<LevelRun, Self::Error>>;

    /// Runs the level with the time step `dt` (s), as often as the other levels of the case.
    ///
    /// # Errors
    /// If the level cannot be set up.
    fn run_with_step(&self, level: &LevelOutcome, dt: f64) -> Result<LevelRun, Self::Error>;

    /// Returns the sizes of the numbers that the solver rounds; `None` if the judged quantity has
    /// no natural size.
    fn rounding(&self) -> Option<RoundingSizes>;
}

/// Sizes of the numbers that a solver rounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoundingSizes {
    /// Largest exact value of the judged quantity.
    pub value: f64,
    /// Largest number from which the judged quantity is computed.
    pub number: f64,
    /// Half of the distance between 1 and the next floating-point number.
    pub unit: f64,
}

/// Number of roundings of a value per step, for the prediction of rounding errors.
const ROUNDINGS: f64 = 8.0;

/// Maximum fraction of the judged quantity that is attributed to rounding.
const MOST_ROUNDING: f64 = 0.01;

/// Maximum number of times that the time step is halved.
const HALVINGS: i32 = 3;

/// Minimum relative decrease of the error on the finest level after the time step is halved. With a
/// smaller decrease the other levels do not run again.
const LEAST_FALL: f64 = 0.05;

/// Minimum exponent of h for which a time step counts as refined together with the cells.
const FOLLOWS: f64 = 0.5;

/// Measures the effect of halving the spacings of the other axes on the error of the finest level
/// that counts. `None` if the error has not stopped decreasing and the suite expects no floor, if
/// this level failed, or if spacings cannot be halved.
///
/// Runs one to three probes in parallel. The results are listed in the order of the axes.
pub(super) fn floor<R: Reruns>(
    plan: &JudgePlan<'_>,
    judgement: &Judgement,
    levels: &[LevelOutcome],
    reruns: &R,
) -> Option<Floor> {
    let expected = plan.expectation.is_some_and(|expectation| expectation.floor.is_some());
    let asked = judgement.verdict == Verdict::AtFloor || expected;
    let counts = |level: &&LevelOutcome| level.exclusion().is_none();
    let finest = levels.iter().rev().find(counts).filter(|_| asked)?;
    if finest.run.failure.is_some() || !reruns.can_halve() {
        return None;
    }
    let others = [Axis::Time, Axis::Particles, Axis::Space].into_par_iter();
    let probe = |axis: Axis| {
        let run = reruns.run_halved(finest, axis)?;
        let outcome = run.map(|run| plan.level(run)).map_err(|error| error.to_string());
        let error = outcome.and_then(|outcome| outcome.run.failure.map_or(Ok(outcome.error), Err));
        Some(Probe { axis, error })
    };
    let probes = others.filter(|axis| *axis != plan.settings.axis).filter_map(probe).collect();
    Some(Floor { error: finest.error, probes })
}

/// Checks a requirement. If shorter time steps are needed to test it, the levels run again.
pub(super) fn gate<R: Reruns>(
    plan: &JudgePlan<'_>,
    required: &Requirement,
    levels: &[LevelOutcome],
    judgement: &Judgement,
    reruns: &R,
) -> GateResult {
    let rounding = rounding(plan, levels, reruns);
    let result = required.check(&usable_series(levels), plan.settings.axis, judgement, rounding);
    let remark = match result {
        Err(_) if is_step_fixed(plan, levels) => shorten(plan, required, levels, rounding, reruns),
        _ => None,
    };
    match remark {
        Some((met, remark)) => GateResult { result: Ok(met), remark: Some(remark), rounding },
        None => GateResult { result, remark: None, rounding },
    }
}

/// Tries to meet the requirement with shorter steps. Returns the acceptance with a remark.
fn shorten<R: Reruns>(
    plan: &JudgePlan<'_>,
    required: &Requirement,
    levels: &[LevelOutcome],
    rounding: f64,
    reruns: &R,
) -> Option<(Acceptance, String)> {
    let (last, coarser) = levels.split_last()?;
    let mut before = last.error;
    for halving in 1..=HALVINGS {
        let share = libm::exp2(-f64::from(halving));
        let shorter = |level: &LevelOutcome| {
            reruns.run_with_step(level, share * level.dt).map(|run| plan.level(run))
        };
        // The finest level alone shows whether the time step contributes to the error.
        let finest = shorter(last).ok()?;
        if !(finest.error <= (1.0 - LEAST_FALL) * before) {
            return None;
        }
        before = finest.error;
        let again: Result<Vec<LevelOutcome>, R::Error> = coarser.par_iter().map(shorter).collect();
        let mut again = again.ok()?;
        again.push(finest);
        let judgement = plan.judge_series(&series(&again), None);
        let usable = usable_series(&again);
        if let Ok(met) = required.check(&usable, plan.settings.axis, &judgement, rounding) {
            let order = judgement.order.map_or("none".to_owned(), |order| order.shown());
            let remark = format!(
                "with 1/{} of the time step, which the suite does not refine, the order is {order}",
                1_u32 << halving
            );
            return Some((met, remark));
        }
    }
    None
}

/// Whether the cells are refined while the time step is constant or nearly constant.
fn is_step_fixed(plan: &JudgePlan<'_>, levels: &[LevelOutcome]) -> bool {
    let (Some(first), Some(last)) = (levels.first(), levels.last()) else { return false };
    plan.settings.axis == Axis::Space
        && last.h < first.h
        && first.dt < last.dt * libm::pow(first.h / last.h, FOLLOWS)
}

/// Estimates the error due to rounding, in the judged norm and relative to the judged scale:
/// rounding errors of the largest number from which the judged quantity is computed are added like
/// the steps of a random walk.
pub(super) fn rounding<R: Reruns>(
    plan: &JudgePlan<'_>,
    levels: &[LevelOutcome],
    reruns: &R,
) -> f64 {
    let Some(RoundingSizes { value, number, unit }) = reruns.rounding() else { return 0.0 };
    let steps = levels.iter().map(|level| level.run.steps).max().unwrap_or(0);
    let walk = ROUNDINGS * unit * number * libm::sqrt(steps as f64 + 1.0);
    walk.min(MOST_ROUNDING * value) / plan.settings.scale.unwrap_or(1.0)
}

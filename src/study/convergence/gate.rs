//! The gate of an external solver: whether its errors meet what is required.
//!
//! Where a suite keeps its time step on all levels, a solver that is accurate in space shows the
//! error of that step: the order falls, or the error stops falling. The levels are then run again
//! with shorter steps, and the gate asks whether these restore the order.

use super::error_scale::largest_exact;
use super::outcome::{judge_series, series};
use crate::exact::Truth;
use crate::subject::Precision;
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{Case, ConvergencePlan};
use crate::verify::{Axis, GateResult, Gating, Judgement, LevelOutcome, Quantity, Requirement};
use rayon::prelude::*;

/// Roundings of a value in one step, for the prediction of rounding errors.
const ROUNDINGS: f64 = 8.0;

/// Largest share of the judged quantity that is ever explained by rounding.
const MOST_ROUNDING: f64 = 0.01;

/// Maximum number of times that the steps are halved.
const HALVINGS: i32 = 3;

/// Halving the step must reduce the finest error by this share, for the levels to run again.
const LEAST_FALL: f64 = 0.05;

/// The time step follows the cells if it shrinks with at least this power of h.
const FOLLOWS: f64 = 0.5;

/// Reason for which the gate requires nothing of a case with these levels, if it does not.
pub(super) fn exemption(case: &Case, levels: &[LevelOutcome]) -> Option<String> {
    match &case.gating {
        Some(Gating::NotGated(reason)) => Some(reason.clone()),
        Some(Gating::Required(required)) => required.untestable(&series(levels)),
        _ => None,
    }
}

/// Checks the requirement of a case, if it has one. The levels must be able to test it: see
/// [`exemption`].
pub(super) fn result(
    (plan, case): (&ConvergencePlan, &Case),
    (levels, judgement): (&[LevelOutcome], &Judgement),
    truth: &dyn Truth,
    run: impl Fn(LevelPlan) -> Result<LevelOutcome, String> + Sync,
) -> Option<GateResult> {
    let Some(Gating::Required(required)) = &case.gating else { return None };
    Some(check((plan, case), required, (levels, judgement), truth, run))
}

/// Checks a requirement on levels that have run; `run` runs a level.
fn check(
    (plan, case): (&ConvergencePlan, &Case),
    requirement: &Requirement,
    (levels, judgement): (&[LevelOutcome], &Judgement),
    truth: &dyn Truth,
    run: impl Fn(LevelPlan) -> Result<LevelOutcome, String> + Sync,
) -> GateResult {
    let rounding = rounding(plan, case, levels, truth);
    let axis = plan.refine.axis;
    let result = requirement.check(&series(levels), axis, judgement, rounding);
    let (Err(_), true) = (&result, is_step_fixed(plan, levels)) else {
        return GateResult { result, remark: None };
    };
    let mut before = levels.last().map_or(f64::NAN, |level| level.error);
    for halving in 1..=HALVINGS {
        let share = libm::exp2(-f64::from(halving));
        let shorter = |level: &LevelOutcome| {
            let LevelOutcome { cells, h, dt, ppc, .. } = *level;
            run(LevelPlan { cells, h, dt: share * dt, ppc })
        };
        // The finest level alone tells whether the step has a part in the error.
        let Some(Ok(finest)) = levels.last().map(shorter) else { break };
        if !(finest.error <= (1.0 - LEAST_FALL) * before) {
            break;
        }
        before = finest.error;
        let coarser = &levels[..levels.len() - 1];
        let again: Result<Vec<LevelOutcome>, String> = coarser.par_iter().map(shorter).collect();
        let Ok(mut again) = again else { break };
        again.push(finest);
        let series = series(&again);
        let judgement = judge_series(plan, case, None, &series);
        if let Ok(met) = requirement.check(&series, axis, &judgement, rounding) {
            let order = judgement.order.map_or("none".to_owned(), |order| order.shown());
            let remark = format!(
                "with 1/{} of the time step, which the suite does not refine, the order is {order}",
                1_u32 << halving
            );
            return GateResult { result: Ok(met), remark: Some(remark) };
        }
    }
    GateResult { result, remark: None }
}

/// Whether the cells are refined and the time step is not, or hardly.
fn is_step_fixed(plan: &ConvergencePlan, levels: &[LevelOutcome]) -> bool {
    let (Some(first), Some(last)) = (levels.first(), levels.last()) else { return false };
    plan.refine.axis == Axis::Space
        && last.h < first.h
        && first.dt < last.dt * libm::pow(first.h / last.h, FOLLOWS)
}

/// Error that rounding explains, in the norm and over the scale that are judged: a random walk of
/// roundings of the largest number that the judged quantity is computed from.
fn rounding(
    plan: &ConvergencePlan,
    case: &Case,
    levels: &[LevelOutcome],
    truth: &dyn Truth,
) -> f64 {
    let unit = match case.method {
        Method::External { precision: Precision::Single, .. } => f64::from(f32::EPSILON) / 2.0,
        _ => f64::EPSILON / 2.0,
    };
    // The size of a sum over the body is the scale of its error.
    let size = Some(largest_exact(plan, case, truth)).filter(|size| *size > 0.0).or(plan.scale);
    let Some(size) = size else { return 0.0 };
    let scene = &plan.scene;
    let positions = scene.from.iter().chain(&scene.to).fold(0.0_f64, |most, x| most.max(x.abs()));
    let number = match plan.of {
        // Displacements are differences of positions.
        Quantity::Displacement => positions + size,
        Quantity::DeformationGradient => 1.0,
        Quantity::Stress => size.max(scene.density * scene.wave_speed() * scene.wave_speed()),
        _ => size,
    };
    let steps = levels.iter().map(|level| level.run.steps).max().unwrap_or(0);
    let walk = ROUNDINGS * unit * number * libm::sqrt(steps as f64 + 1.0);
    walk.min(MOST_ROUNDING * size) / plan.scale.unwrap_or(1.0)
}

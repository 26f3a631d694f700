//! Scales of the errors and of the work of a case.

use crate::exact::Truth;
use crate::suite::model::{Against, Case, ConvergencePlan};
use crate::verify::{Axis, ErrorScale};

/// Intervals of the sampling raster along each axis and in time, in 1-D and 2-D, and in 3-D, where
/// it has many points. Even numbers, so that the middle is a point.
const FINE: usize = 20;
const COARSE: usize = 8;

/// The error scale of `case`, whose errors are taken against `truth`.
pub(crate) fn error_scale(plan: &ConvergencePlan, case: &Case, truth: &dyn Truth) -> ErrorScale {
    ErrorScale {
        problem: format!("until t = {} s, against {}", case.until, case.against.words()),
        size: size(plan, case, truth),
        growth: growth(plan),
    }
}

fn size(plan: &ConvergencePlan, case: &Case, truth: &dyn Truth) -> f64 {
    if case.against == Against::Nothing {
        return f64::NAN;
    }
    if plan.scale.is_some() {
        return 1.0;
    }
    largest_exact(plan, case, truth)
}

/// Largest exact value of the judged quantity over the body and the run.
pub(crate) fn largest_exact(plan: &ConvergencePlan, case: &Case, truth: &dyn Truth) -> f64 {
    // Shorter steps know their own labels only; a formula of the same motion knows every place.
    let formula = plan.exact.as_ref().map(|exact| exact as &dyn Truth);
    let is_same = matches!(case.against, Against::SameMethod(_));
    let truth = if is_same { formula.unwrap_or(truth) } else { truth };
    let per_axis = if plan.scene.dimension() == 3 { COARSE } else { FINE };
    let at_rest = plan.exact.as_ref().is_some_and(|exact| exact.at_rest);
    let share = |k: usize| case.until * (k as f64 / per_axis as f64);
    let times: Vec<f64> =
        if at_rest { vec![case.until] } else { (0..=per_axis).map(share).collect() };
    plan.of.largest_exact(truth, &places(plan, per_axis), &times)
}

/// A raster of the body, faces included.
fn places(plan: &ConvergencePlan, per_axis: usize) -> Vec<Vec<f64>> {
    let scene = &plan.scene;
    let place = |index: usize| -> Vec<f64> {
        let along = |axis: usize| {
            let k = index / (per_axis + 1).pow(axis as u32) % (per_axis + 1);
            scene.from[axis] + (scene.to[axis] - scene.from[axis]) * (k as f64 / per_axis as f64)
        };
        (0..scene.dimension()).map(along).collect()
    };
    let inside = |place: &Vec<f64>| plan.exact.as_ref().is_none_or(|exact| exact.holds(place));
    (0..(per_axis + 1).pow(scene.dimension() as u32)).map(place).filter(inside).collect()
}

/// Powers of one over the spacing by which work grows in theory. The rule of the time step is read
/// off the levels, so that it may be any formula.
fn growth(plan: &ConvergencePlan) -> f64 {
    let d = plan.scene.dimension() as f64;
    let levels = &plan.refine.levels;
    let steps = match (levels.first(), levels.last()) {
        (Some(first), Some(last)) if last.h < first.h => {
            libm::log(first.dt / last.dt) / libm::log(first.h / last.h)
        }
        _ => 0.0,
    };
    match plan.refine.axis {
        Axis::Space => d + steps,
        Axis::Time => 1.0,
        // Particles fill the body, the more the closer they are.
        Axis::Particles => d,
    }
}

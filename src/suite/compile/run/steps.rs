//! Time steps that runs can take.

use super::refine::{COARSE_TO_FINE, LevelPaths};
use crate::suite::compile::evaluator::Evaluator;
use crate::suite::compile::path::Path;
use crate::suite::compile::wording::shown;
use crate::suite::grammar::ConvergenceSpec;
use crate::suite::model::grid_size::cell_size;
use crate::suite::model::refine_plan::RefinePlan;
use crate::suite::model::{Against, Case, ConvergencePlan};
use crate::suite::yaml::Diagnostic;
use crate::verify::{Axis, Clock, STEP_TOLERANCE};

/// Ratio of the finest step to that of the same method that serves as truth. Its start is of second
/// order, so that an error of second order on the finest level is known to 1/64.
const SHORTER: f64 = 8.0;

/// The time step (s) of the same method, where a suite compares with it.
pub(crate) fn same_method(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
    refine: &RefinePlan,
    until: &[(String, f64)],
    instants: u64,
) -> Result<Option<f64>, Diagnostic> {
    let same = spec.reference.as_ref().and_then(|reference| reference.same_method.as_ref());
    let (Some(same), Some(finest)) = (same, refine.levels.last()) else { return Ok(None) };
    let path = Path::top("reference").then("same_method");
    if refine.axis != Axis::Time {
        let message = "the same method with shorter steps knows the error of the time step only";
        let diagnostic = evaluator.diagnostic_at_key(&path, message);
        return Err(diagnostic.with_help("list time steps under `dt` in `refine`"));
    }
    let path = path.then("dt");
    let dt = evaluator.formula(&path, &same.dt, &["h"])?.eval(&[finest.h]);
    for (_, until) in until {
        let clock = |dt| {
            Clock::with_common_instants(*until, dt, instants)
                .map_or(0.0, |clock| clock.steps as f64)
        };
        if !(clock(dt) >= SHORTER * clock(finest.dt)) {
            let message =
                format!("the time step is {}, the finest level's {}", shown(dt), shown(finest.dt));
            let label = format!("expected at most 1/{SHORTER} of that, and at most 1e9 steps");
            return Err(evaluator.diagnostic(&path, &message).with_label(&label));
        }
    }
    Ok(Some(dt))
}

/// Whether every level, and the reference, has a usable time step, and a finer one where time is
/// refined. Instants that are shared with a computed truth must not change it.
pub(crate) fn check(
    evaluator: &Evaluator<'_>,
    plan: &ConvergencePlan,
    places: &[LevelPaths],
) -> Result<(), Diagnostic> {
    for case in &plan.cases {
        let mut coarser: Option<(f64, Clock)> = None;
        for (level, place) in plan.refine.levels.iter().zip(places) {
            let clock = case.clock(plan, level.dt);
            let clock = usable(evaluator, &place.dt, clock, (level.cells, level.dt))?;
            if plan.refine.axis == Axis::Time || plan.refine.steps.len() > 1 {
                if let Some(coarser) = coarser {
                    finer(evaluator, &place.dt, coarser, (level.dt, clock))?;
                }
                coarser = Some((level.dt, clock));
            }
            let shares_instants = matches!(case.against, Against::Reference | Against::SameMethod);
            if shares_instants && plan.refine.rule.is_none() {
                as_wanted(evaluator, &place.dt, case, (level.dt, clock))?;
            }
        }
        if let Some(fine) = &plan.reference {
            let path = Path::top("reference").then("fem").then("dt");
            let dt = fine.dt.eval(&[cell_size(&plan.scene, fine.cells)]);
            let clock = plan.clock(Against::Reference, case.until, dt);
            usable(evaluator, &path, clock, (fine.cells, dt))?;
        }
    }
    Ok(())
}

fn usable(
    evaluator: &Evaluator<'_>,
    path: &Path,
    clock: Option<Clock>,
    (cells, dt): (u64, f64),
) -> Result<Clock, Diagnostic> {
    clock.ok_or_else(|| {
        let message = format!("with {cells} cells the time step is {}", shown(dt));
        let label = "expected a positive step, and at most 1e9 of them";
        evaluator.diagnostic(path, &message).with_label(label)
    })
}

/// Two wanted steps can become the same in a short run.
fn finer(
    evaluator: &Evaluator<'_>,
    path: &Path,
    (coarse, coarse_clock): (f64, Clock),
    (fine, fine_clock): (f64, Clock),
) -> Result<(), Diagnostic> {
    let (wide, narrow) = (shown(coarse), shown(fine));
    if !(fine < coarse) {
        let message = format!("a level with dt = {narrow} after one with {wide}");
        return Err(evaluator.diagnostic(path, &message).with_label(COARSE_TO_FINE));
    }
    if fine_clock.steps > coarse_clock.steps {
        return Ok(());
    }
    let message = format!("dt = {narrow} and {wide} both become {} s", shown(fine_clock.dt()));
    let label = format!("both runs take {} steps", fine_clock.steps);
    Err(evaluator.diagnostic(path, &message).with_label(&label))
}

/// Refuses instants that cut a step by more than the tolerance.
fn as_wanted(
    evaluator: &Evaluator<'_>,
    path: &Path,
    case: &Case,
    (wanted, clock): (f64, Clock),
) -> Result<(), Diagnostic> {
    let is_near = |clock: &Clock| (clock.dt() / wanted - 1.0).abs() <= STEP_TOLERANCE;
    if is_near(&clock) {
        return Ok(());
    }
    let (dt, instants) = (shown(clock.dt()), clock.instants);
    let message = format!("dt = {} becomes {dt} s, to end at {instants} instants", shown(wanted));
    let label = "expected a step that divides the time between instants to 1 %";
    let fewer = (1..instants).rev().find(|instants| {
        Clock::with_common_instants(case.until, wanted, *instants).is_some_and(|c| is_near(&c))
    });
    let help = fewer.map_or_else(
        || format!("a run until {} s has no such step of this length", shown(case.until)),
        |fewer| format!("`instants: {fewer}` keeps this step"),
    );
    Err(evaluator.diagnostic(path, &message).with_label(label).with_help(&help))
}

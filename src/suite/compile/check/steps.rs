use super::size::LevelPaths;
use crate::suite::evaluator::{Evaluator, shown};
use crate::suite::model::{Against, Case, ConvergencePlan};
use crate::suite::scene::cell_size;
use crate::suite::yaml::{Diagnostic, Path};
use crate::verify::{Axis, Clock, STEP_TOLERANCE};

/// Label under the caret for a level that is not finer than the previous level.
pub(crate) const COARSE_TO_FINE: &str = "expected levels from coarse to fine";

/// A stated time step (s), and the actual steps computed from it.
#[derive(Clone, Copy)]
struct StatedStep {
    dt: f64,
    clock: Clock,
}

/// Checks that every level and the reference have valid time steps. If time is refined, the steps
/// must decrease from level to level. A run that is compared with a computed reference must have
/// steps that end at the instants of the reference, with a change of the time step by at most
/// [`STEP_TOLERANCE`].
pub(crate) fn refuse_unusable(
    evaluator: &Evaluator<'_>,
    plan: &ConvergencePlan,
    places: &[LevelPaths],
) -> Result<(), Diagnostic> {
    for case in &plan.cases {
        let mut coarser: Option<StatedStep> = None;
        for (level, place) in plan.refine.levels.iter().zip(places) {
            let clock = case.clock(plan, level.dt);
            let clock = usable(evaluator, &place.dt, clock, level.cells, level.dt)?;
            let step = StatedStep { dt: level.dt, clock };
            if plan.refine.axis == Axis::Time || plan.refine.steps.len() > 1 {
                if let Some(coarser) = coarser {
                    finer(evaluator, &place.dt, coarser, step)?;
                }
                coarser = Some(step);
            }
            if case.against.is_computed() && plan.refine.rule.is_none() {
                as_wanted(evaluator, &place.dt, case, step)?;
            }
        }
        if let Some(fine) = case.against.fine_grid() {
            let path = Path::top("reference").then("same_method").then("cells");
            let clock = usable(evaluator, &path, case.clock(plan, fine.dt), fine.cells, fine.dt)?;
            if plan.refine.rule.is_none() {
                as_wanted(evaluator, &path, case, StatedStep { dt: fine.dt, clock })?;
            }
        }
        if let Some(fine) = &plan.reference {
            let path = Path::top("reference").then("fem").then("dt");
            let dt = fine.dt.eval(&[cell_size(&plan.scene, fine.cells)]);
            let clock = plan.clock(Against::Reference, case.until, dt);
            usable(evaluator, &path, clock, fine.cells, dt)?;
        }
    }
    Ok(())
}

fn usable(
    evaluator: &Evaluator<'_>,
    path: &Path,
    clock: Option<Clock>,
    cells: u64,
    dt: f64,
) -> Result<Clock, Diagnostic> {
    clock.ok_or_else(|| {
        let message = format!("with {cells} cells the time step is {}", shown(dt));
        let label = "expected a positive step, and at most 1e9 of them";
        evaluator.diagnostic(path, &message).with_label(label)
    })
}

/// Refuses a level whose stated or rounded time step is not smaller than on the previous level.
fn finer(
    evaluator: &Evaluator<'_>,
    path: &Path,
    coarse: StatedStep,
    fine: StatedStep,
) -> Result<(), Diagnostic> {
    let (wide, narrow) = (shown(coarse.dt), shown(fine.dt));
    if !(fine.dt < coarse.dt) {
        let message = format!("a level with dt = {narrow} after one with {wide}");
        return Err(evaluator.diagnostic(path, &message).with_label(COARSE_TO_FINE));
    }
    if fine.clock.steps > coarse.clock.steps {
        return Ok(());
    }
    let message = format!("dt = {narrow} and {wide} both become {} s", shown(fine.clock.dt()));
    let label = format!("both runs take {} steps", fine.clock.steps);
    Err(evaluator.diagnostic(path, &message).with_label(&label))
}

/// Refuses a number of instants that changes the time step of `case` by more than
/// [`STEP_TOLERANCE`].
fn as_wanted(
    evaluator: &Evaluator<'_>,
    path: &Path,
    case: &Case,
    step: StatedStep,
) -> Result<(), Diagnostic> {
    let StatedStep { dt: wanted, clock } = step;
    let is_near = |clock: &Clock| (clock.dt() / wanted - 1.0).abs() <= STEP_TOLERANCE;
    if is_near(&clock) {
        return Ok(());
    }
    let (dt, instants) = (shown(clock.dt()), clock.instants);
    let message = format!(
        "dt = {} is changed to {dt} s, so that steps end at {instants} instants",
        shown(wanted)
    );
    let label = "expected a step that divides the time between instants to 1 %";
    let fewer = (1..instants).rev().find(|instants| {
        Clock::with_common_instants(case.until, wanted, *instants).is_some_and(|c| is_near(&c))
    });
    let help = fewer.map_or_else(
        || format!("no step near this length divides a run until {} s", shown(case.until)),
        |fewer| format!("`instants: {fewer}` keeps this step"),
    );
    Err(evaluator.diagnostic(path, &message).with_label(label).with_help(&help))
}

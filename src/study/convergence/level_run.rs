//! One level of a case: its run, and what comes of it.

use super::outcome::error_of;
use crate::exact::{Problem, Truth};
use crate::subject::Subject;
use crate::suite::grammar::CrossingLevels;
use crate::suite::model::ConvergencePlan;
use crate::suite::model::refine_plan::LevelPlan;
use crate::verify;
use crate::verify::{Axis, CheckpointStore, Clock, Comparison, LevelOutcome, RunResult};

/// The run of a subject against `truth`, from where `keeper` has it.
///
/// # Errors
/// Those of `make`.
pub(super) fn run_of(
    plan: &ConvergencePlan,
    truth: &dyn Truth,
    (clock, keeper): (&Clock, &mut dyn CheckpointStore),
    keeps_field: bool,
    make: impl FnMut() -> Result<Box<dyn Subject>, String>,
) -> Result<RunResult, String> {
    let rest = plan.exact.as_ref().filter(|truth| truth.at_rest).map(Problem::wave_speed);
    let (sum, observe) = (plan.sum.as_deref(), plan.observe.as_deref());
    let comparison = Comparison { of: plan.of, sum, observe, at_rest: rest, keeps_field };
    verify::resume(make, truth, clock, &comparison, keeper)
}

/// The outcome of a level of `plan`, with steps of `dt` (s), from its run.
pub(super) fn level_of(
    plan: &ConvergencePlan,
    level: LevelPlan,
    dt: f64,
    run: RunResult,
) -> LevelOutcome {
    let crossed = run.counters.crossings.is_some_and(|n| n > 0);
    let excluded = crossed && plan.crossing_levels == CrossingLevels::Excluded;
    let LevelPlan { cells, h, .. } = level;
    let ppc = level.ppc.filter(|_| run.counters.particles.is_some());
    let spacing = match plan.refine.axis {
        Axis::Space => h,
        Axis::Time => dt,
        Axis::Particles => level.particle_spacing(plan.scene.dimension()),
    };
    let error = error_of(plan, &run);
    let (usable, order, stable_time_step) = (!excluded, None, None);
    LevelOutcome { cells, h, spacing, dt, ppc, run, error, usable, order, stable_time_step }
}

//! The time steps that a suite asks for, beside those that its runs take.

use super::stable_step::StableSteps;
use crate::suite::model::refine_plan::{Extent, LevelPlan};
use crate::suite::model::{ConvergencePlan, Suite};
use crate::verify::Clock;

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

//! The time steps that a suite asks for, beside those that its runs take.

use super::stable_step::StableSteps;
use crate::suite::compile::check::size::particles;
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

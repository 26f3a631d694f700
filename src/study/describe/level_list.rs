//! The levels of a case in figures that a mechanician asks for first.

use crate::study::convergence::time_steps::{TimeStep, time_steps};
use crate::suite::compile::check::size::particles;
use crate::suite::model::refine_plan::Extent;
use crate::suite::model::{ConvergencePlan, Suite};

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

//! Predicted time and memory of a suite, before any run.

use crate::suite::compile::check::size;
use crate::suite::model::refine_plan::{Extent, LevelPlan};
use crate::suite::model::{Case, ConvergencePlan, Suite};

/// Seconds per particle and step, by dimension, including errors and set-up: fitted to whole runs
/// of eight suites in the profile of `cargo run`, on one thread. Single suites differ by a factor
/// of up to three.
const SECONDS: [f64; 3] = [2.5e-7, 6e-7, 1.8e-6];

/// Time (s) of a case without a prediction.
pub(crate) const UNKNOWN: f64 = 0.5;

/// Bytes of a particle, and of a node, by dimension.
const BYTES: [[f64; 2]; 3] = [[100.0, 40.0], [250.0, 70.0], [450.0, 100.0]];

/// Estimate of a whole suite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Particles times steps, over all cases and levels.
    pub particle_steps: f64,
    /// Seconds of one thread, to a factor of about three.
    pub seconds: f64,
    /// Memory of the largest level (bytes).
    pub bytes: f64,
}

/// Cost of the levels of the gate of a convergence study; `None` for other studies.
pub fn estimate(suite: &Suite) -> Option<Estimate> {
    suite.plan().map(estimate_of)
}

/// Cost of each case of a suite; `None` for studies without refinement.
pub fn estimates(suite: &Suite, extent: Extent) -> Vec<Option<Estimate>> {
    match suite.plan::<ConvergencePlan>() {
        Some(plan) => plan.cases.iter().map(|case| Some(of_case(plan, case, extent))).collect(),
        None => vec![None; suite.case_names().len()],
    }
}

/// Cost of the levels of the gate.
pub(crate) fn estimate_of(plan: &ConvergencePlan) -> Estimate {
    let none = Estimate { particle_steps: 0.0, seconds: 0.0, bytes: 0.0 };
    let cases = plan.cases.iter().map(|case| of_case(plan, case, Extent::Usual));
    cases.fold(none, |all, case| Estimate {
        particle_steps: all.particle_steps + case.particle_steps,
        seconds: all.seconds + case.seconds,
        bytes: all.bytes.max(case.bytes),
    })
}

/// Time (s, one thread) of each unit of progress of a run: its levels, or an estimate for studies
/// without refinement.
pub fn unit_seconds(suite: &Suite, extent: Extent) -> Vec<f64> {
    let Some(plan) = suite.plan::<ConvergencePlan>() else {
        return vec![UNKNOWN; suite.case_names().len()];
    };
    let index = plan.scene.dimension().clamp(1, 3) - 1;
    let levels = plan.refine.levels(extent);
    let each = plan.cases.iter().flat_map(|case| levels.iter().map(move |level| (case, level)));
    each.map(|(case, level)| SECONDS[index] * particle_steps(plan, case, *level)).collect()
}

/// Particles times steps of a level.
fn particle_steps(plan: &ConvergencePlan, case: &Case, level: LevelPlan) -> f64 {
    let steps = case.clock(plan, level.dt).map_or(0, |clock| clock.steps);
    size::particles(&plan.scene, level) * steps as f64
}

fn of_case(plan: &ConvergencePlan, case: &Case, extent: Extent) -> Estimate {
    let scene = &plan.scene;
    let index = scene.dimension().clamp(1, 3) - 1;
    let (mut all, mut bytes) = (0.0, 0.0_f64);
    for level in plan.refine.levels(extent) {
        let particles = size::particles(scene, *level);
        all += particle_steps(plan, case, *level);
        let [particle, node] = BYTES[index];
        bytes = bytes.max(particle * particles + node * size::nodes(scene, level.h));
    }
    Estimate { particle_steps: all, seconds: SECONDS[index] * all, bytes }
}

//! The finest level once more, with the spacing of another axis halved: whose error is the floor?

use crate::suite::compile::check::size;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{Against, Case, ConvergencePlan};
use crate::verify::{Axis, Expectation, Floor, Judgement, LevelOutcome, Probe, Verdict};
use rayon::prelude::*;

/// Effect of halving the axes that are not refined on the error of the finest level that counts.
/// `None` if it is not needed: the error has not stopped falling, and the suite expects no floor;
/// and where the truth is the same method, whose own spacings are not halved.
///
/// `run` runs a level. One to three runs, in parallel; the outcome keeps the order of the axes.
pub(crate) fn floor(
    plan: &ConvergencePlan,
    case: &Case,
    expectation: Option<&Expectation>,
    judgement: &Judgement,
    levels: &[LevelOutcome],
    run: impl Fn(LevelPlan) -> Result<LevelOutcome, String> + Sync,
) -> Option<Floor> {
    let expected = expectation.is_some_and(|expectation| expectation.floor.is_some());
    let asked = judgement.verdict == Verdict::AtFloor || expected;
    let finest = levels.iter().rev().find(|level| level.usable).filter(|_| asked)?;
    if finest.run.failure.is_some() || matches!(case.against, Against::SameMethod(_)) {
        return None;
    }
    // The step that was taken, so that a halved one is half of it.
    let (cells, h, dt, ppc) = (finest.cells, finest.h, finest.dt, finest.ppc);
    let level = LevelPlan { cells, h, dt, ppc };
    let dimension = plan.scene.dimension();
    let others: Vec<(Axis, LevelPlan)> = [Axis::Time, Axis::Particles, Axis::Space]
        .into_iter()
        .filter(|axis| *axis != plan.refine.axis)
        .filter_map(|axis| Some((axis, level.halved(axis, dimension)?)))
        .collect();
    let probe = |(axis, level): (Axis, LevelPlan)| {
        let error = match size::too_large(&plan.scene, level) {
            Some((what, amount)) => Err(format!("{amount:.1e} {what} are too many")),
            None => run(level).and_then(|outcome| match outcome.run.failure {
                Some(reason) => Err(reason),
                None => Ok(outcome.error),
            }),
        };
        Probe { axis, error }
    };
    Some(Floor { error: finest.error, probes: others.into_par_iter().map(probe).collect() })
}

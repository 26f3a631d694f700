//! Why a case does not have the order of theory: its finest levels again, with one thing changed at
//! a time.
//!
//! A change is the cause if it restores the order; where none does, the one that takes most off the
//! finest error is named, with what is left. Nothing is read of what the suite's author gives as a
//! reason. (One factor at a time, as the isolating runs of Roy 2005, J. Comput. Phys. 205, 131.)

pub(crate) mod probes;

use self::probes::{Crossings, PROBES, ProbeKind};
use crate::study::convergence::formal_order::formal_order;
use crate::study::convergence::outcome::to_judge;
use crate::study::kind::{RunContext, Storage, Study};
use crate::study::preflight::cost::estimate_of;
use crate::suite::compile::suite::with_amplitude;
use crate::suite::model::refine_plan::{Extent, LevelPlan};
use crate::suite::model::{Against, Case, ConvergencePlan, Suite};
use crate::suite::yaml::Source;
use crate::verify::{
    Axis, ChangedRun, Convergence, Diagnosis, FEWEST_LEVELS, Judgement, Level, LevelOutcome,
    OrderHypothesis, judge,
};

/// Finest levels that are run again.
const LEVELS: usize = 5;

/// An order that is restored is no further below that of theory.
const NEAR: f64 = 0.2;

/// And no further above: a case may be better than its theory.
const ABOVE: f64 = 0.8;

/// Factor of the amplitude in the probe that makes the motion smaller.
pub(crate) const SMALLER: f64 = 0.1;

/// The finding on the case number `index` of a suite, within a predicted time (s) for all runs.
/// `None` for a case that has no order to explain: of another kind of study, without a truth, or
/// with too few levels.
///
/// # Errors
/// One line that says why the case itself cannot be run.
pub fn diagnose(
    suite: &Suite,
    source: &Source,
    index: usize,
    budget: f64,
) -> Result<Option<Diagnosis>, String> {
    let Some(exploring) = suite.without_expectations() else { return Ok(None) };
    let Some(plan) = exploring.plan::<ConvergencePlan>() else { return Ok(None) };
    let case = &plan.cases[index];
    if case.against == Against::Nothing || plan.refine.usual < FEWEST_LEVELS {
        return Ok(None);
    }
    let context = Context { suite: &suite.name, case, formal_order: formal_order(plan, case) };
    let all = only(plan, case, plan.refine.levels(Extent::Usual));
    let found = context.run(&all)?;
    // Levels that do not count show another error than the one that is judged.
    let end = found.levels.iter().rposition(|level| level.usable).map_or(0, |last| last + 1);
    let range = end.saturating_sub(LEVELS)..end;
    let levels = &found.levels[range.clone()];
    let mut diagnosis = Diagnosis {
        case: case.name.clone(),
        formal_order: context.formal_order,
        finest: context.judge(levels, plan.refine.axis),
        levels: levels.iter().map(|level| level.name(found.axis)).collect(),
        judgement: found.judgement.clone(),
        left_grid: levels.iter().any(|level| level.run.counters.left_domain > Some(0)),
        kink: kink(suite, plan),
        runs: Vec::new(),
        skipped: Vec::new(),
    };
    if diagnosis.is_sound() || diagnosis.left_grid {
        return Ok(Some(diagnosis));
    }
    let finest = only(plan, case, &plan.refine.levels(Extent::Usual)[range]);
    context.try_all(source, &finest, levels, budget, &mut diagnosis);
    Ok(Some(diagnosis))
}

/// Functions with a kink or a jump.
const KINKED: [&str; 7] = ["max", "min", "abs", "sign", "step", "floor", "where"];

/// The first function with a kink that the exact motion calls.
fn kink(suite: &Suite, plan: &ConvergencePlan) -> Option<&'static str> {
    let bodies = suite.functions.iter().map(|(_, body)| body.clone());
    let texts: Vec<String> =
        plan.exact.iter().map(|problem| problem.motion.source()).chain(bodies).collect();
    KINKED.into_iter().find(|name| texts.iter().any(|text| text.contains(&format!("{name}("))))
}

/// The plan with one case and some levels.
fn only(plan: &ConvergencePlan, case: &Case, levels: &[LevelPlan]) -> ConvergencePlan {
    let mut plan = plan.clone();
    plan.refine.levels = levels.to_vec();
    plan.refine.usual = levels.len();
    plan.cases = vec![case.clone()];
    plan
}

/// The parts that all runs of a case share.
struct Context<'a> {
    suite: &'a str,
    case: &'a Case,
    formal_order: f64,
}

impl Context<'_> {
    fn run(&self, plan: &ConvergencePlan) -> Result<Convergence, String> {
        let (suite, extent, storage) = (self.suite, Extent::Usual, Storage::Nowhere);
        let context = RunContext { suite, fingerprint: 0, extent, storage, solver: None };
        let outcome = plan.runner(context).case(0, &|| ());
        outcome.convergence().cloned().ok_or(outcome.reason)
    }

    fn judge(&self, levels: &[LevelOutcome], axis: Axis) -> Judgement {
        let levels: Vec<Level> = levels.iter().map(to_judge).collect();
        let p = self.formal_order;
        judge(&levels, &OrderHypothesis::within(p, p - NEAR, p + ABOVE).over(axis))
    }

    fn try_all(
        &self,
        source: &Source,
        finest: &ConvergencePlan,
        levels: &[LevelOutcome],
        budget: f64,
        into: &mut Diagnosis,
    ) {
        let error = |levels: &[LevelOutcome]| levels.last().map_or(f64::NAN, |level| level.error);
        let crossed = |level: &LevelOutcome| level.run.counters.crossings != Some(0);
        let crossings = if levels.iter().any(crossed) { Crossings::Some } else { Crossings::None };
        let mut left = budget;
        for (kind, plan, scale) in self.changed(source, finest) {
            let h = |plan: &ConvergencePlan| plan.refine.levels.last().map_or(0.0, |level| level.h);
            let finer = plan.refine.axis == Axis::Space && h(&plan) < h(finest);
            let cost = estimate_of(&plan).seconds;
            if cost > left {
                into.skipped.push(kind.change.to_owned());
                continue;
            }
            left -= cost;
            // A change that cannot be set up is no evidence.
            let Ok(found) = self.run(&plan) else { continue };
            let judgement = self.judge(&found.levels, found.axis);
            into.runs.push(ChangedRun {
                change: kind.change.to_owned(),
                cause: (kind.cause)(self.case, crossings),
                remedy: kind.remedy,
                verdict: judgement.verdict,
                order: judgement.order,
                ratio: error(&found.levels) / scale / error(levels),
                is_finer: finer,
            });
        }
    }

    /// Every change that means something, with the factor of the amplitude that it brings.
    fn changed(
        &self,
        source: &Source,
        finest: &ConvergencePlan,
    ) -> Vec<(&'static ProbeKind, ConvergencePlan, f64)> {
        let mut changed = Vec::new();
        for kind in PROBES {
            let plan = (kind.apply)(finest).map(|plan| (kind, plan, 1.0));
            changed.extend(plan);
        }
        let has_motion = finest.exact.is_some() && finest.refine.axis != Axis::Particles;
        let smaller = has_motion.then(|| with_amplitude(source, SMALLER).ok()).flatten();
        let plan = smaller.as_ref().and_then(Suite::plan::<ConvergencePlan>);
        changed.extend(plan.map(|plan| {
            let plan = only(plan, self.case, &finest.refine.levels);
            (&probes::AMPLITUDE, plan, SMALLER)
        }));
        changed
    }
}

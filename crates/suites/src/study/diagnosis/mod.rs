//! Determines why a case does not have the theoretical order.
//!
//! The finest levels run again with one change at a time (as in the isolating runs of Roy 2005, J.
//! Comput. Phys. 205, 131). A change reveals the cause if it restores the order. If no change does,
//! one that raises the order is reported, or else the one with the largest decrease of the finest
//! error.

mod levels;
mod probes;
mod regularity;
mod session;
mod steps;
mod walls;

use self::probes::{
    ALIGNMENT, AMPLITUDE, CELLS, Crossings, DOMAINS, DURATION, FORMULA, FRAME, GRADIENTS, MASS,
    PARTICLES, ProbeKind, REFERENCE, SCHEME, SMOOTH_BASIS, START, STEP,
};
use self::session::{Known, Session, only, refusal};
use crate::external::SolverFactory;
use crate::study::convergence::judge_plan::formal_order;
use crate::suite::compile::suite::with_amplitude;
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::Extent;
use crate::suite::model::{Against, ConvergencePlan, Suite};
use crate::suite::yaml::Source;
use crate::verify::{
    Axis, ChangedRun, Diagnosis, FEWEST_LEVELS, KnownCause, LevelOutcome, Quantity,
};

/// Number of levels that run again, starting with the finest.
const LEVELS: usize = 5;

/// Factor on the amplitude in the probe with a smaller motion.
const SMALLER: f64 = 0.1;

/// Changes that modify only the plan, starting with the most specific one.
const PROBES: [&ProbeKind; 14] = [
    &REFERENCE,
    &FORMULA,
    &START,
    &SCHEME,
    &DOMAINS,
    &ALIGNMENT,
    &PARTICLES,
    &GRADIENTS,
    &MASS,
    &FRAME,
    &SMOOTH_BASIS,
    &DURATION,
    &STEP,
    &CELLS,
];

const CHECKS: [fn(&Known<'_>) -> Option<KnownCause>; 6] = [
    steps::check,
    walls::check,
    levels::undamped,
    levels::another_problem,
    levels::coarse,
    regularity::check,
];

/// Diagnoses case number `index` of a suite. The predicted time of all changed runs is limited to a
/// budget (s). With `solver`, `suite` must come from [`under`](crate::study::under). `None` if
/// there is no order to explain: another kind of study, neither an exact solution nor a reference,
/// or too few levels.
///
/// # Errors
/// The reason why the case itself cannot run.
pub fn diagnose(
    suite: &Suite,
    source: &Source,
    index: usize,
    budget: f64,
    solver: Option<&dyn SolverFactory>,
) -> Result<Option<Diagnosis>, String> {
    let Some(exploring) = suite.without_expectations() else { return Ok(None) };
    let Some(plan) = exploring.convergence() else { return Ok(None) };
    let case = &plan.cases[index];
    if case.against == Against::Nothing || plan.refine.usual < FEWEST_LEVELS {
        return Ok(None);
    }
    let formal_order = formal_order(plan, case);
    let session = Session::new(&suite.name, source, case, formal_order, solver, budget);
    let all = only(plan, case, plan.refine.levels(Extent::Usual));
    let found = session.first(&all).map_err(|reason| with_cause(&session, &all, reason))?;
    // The last level must count for the verdict, because its error is compared.
    let end = found.levels.iter().rposition(|level| level.usable).map_or(0, |last| last + 1);
    let range = end.saturating_sub(LEVELS)..end;
    let levels = &found.levels[range.clone()];
    let finest = session.judge(levels, plan.refine.axis);
    let mut diagnosis = Diagnosis {
        case: case.name.clone(),
        formal_order,
        judgement: found.judgement.clone(),
        finest_error: finest_error(levels),
        levels: levels.iter().map(|level| level.name(found.axis)).collect(),
        is_external: matches!(case.method, Method::External { .. }),
        finest: finest.clone(),
        findings: Vec::new(),
        runs: Vec::new(),
        skipped: Vec::new(),
    };
    if diagnosis.is_sound() {
        return Ok(Some(diagnosis));
    }
    let known = Known { session: &session, plan: &all, levels: &found.levels, finest: &finest };
    for check in CHECKS {
        diagnosis.findings.extend(check(&known));
        // If the cause is known, runs with one change give no evidence, because they have the same
        // step, grid or load.
        if diagnosis.is_known() {
            break;
        }
    }
    if !diagnosis.is_known() {
        let finest = only(plan, case, &all.refine.levels[range]);
        diagnosis.runs = changed_runs(&session, &finest, levels);
        check_remedy(&session, &finest, &mut diagnosis);
    }
    diagnosis.skipped = session.into_skipped();
    Ok(Some(diagnosis))
}

fn with_cause(session: &Session<'_>, plan: &ConvergencePlan, reason: String) -> String {
    let lost = |level| walls::particle_on_wall(session, plan, level);
    let Some(finding) = plan.refine.levels.iter().copied().find_map(lost) else { return reason };
    let remedy = finding.remedy.map_or(String::new(), |remedy| format!("; remedy: {remedy}"));
    format!("{reason}; cause: {}{remedy}", finding.cause)
}

fn finest_error(levels: &[LevelOutcome]) -> f64 {
    levels.last().map_or(f64::NAN, |level| level.error)
}

/// Runs the levels of `finest` with one change at a time; `levels` are the unchanged results.
fn changed_runs(
    session: &Session<'_>,
    finest: &ConvergencePlan,
    levels: &[LevelOutcome],
) -> Vec<ChangedRun> {
    let crossed = |level: &LevelOutcome| level.run.counters.crossings != Some(0);
    let crossings = if levels.iter().any(crossed) { Crossings::Some } else { Crossings::None };
    let before = finest_error(levels);
    let mut runs = Vec::new();
    for (kind, plan, size) in changed_plans(session, finest) {
        let h = |plan: &ConvergencePlan| plan.refine.levels.last().map_or(0.0, |level| level.h);
        let Some(found) = session.changed(kind.change, &plan) else { continue };
        let judgement = session.judge(&found.levels, found.axis);
        let error = finest_error(&found.levels);
        runs.push(ChangedRun {
            change: kind.change.to_owned(),
            cause: (kind.cause)(session.case, crossings),
            remedy: kind.remedy,
            refusal: None,
            verdict: judgement.verdict,
            order: judgement.order,
            error,
            ratio: error / before,
            relative_ratio: error / before / size,
            is_finer: plan.refine.axis == Axis::Space && h(&plan) < h(finest),
            has_more_particles: kind.change == PARTICLES.change,
        });
    }
    runs
}

/// Lists the applicable changes, each with its factor on the size of the judged quantity.
fn changed_plans(
    session: &Session<'_>,
    finest: &ConvergencePlan,
) -> Vec<(&'static ProbeKind, ConvergencePlan, f64)> {
    let planned = |kind: &'static ProbeKind| Some((kind, (kind.apply)(finest)?, 1.0));
    let mut changed: Vec<_> = PROBES.into_iter().filter_map(planned).collect();
    let has_motion = finest.exact.is_some() && finest.refine.axis != Axis::Particles;
    let smaller = has_motion.then(|| with_amplitude(session.source, SMALLER).ok()).flatten();
    let plan = smaller.as_ref().and_then(Suite::convergence);
    changed.extend(plan.map(|plan| {
        let plan = only(plan, session.case, &finest.refine.levels);
        let size = size_factor(finest, &plan);
        (&AMPLITUDE, plan, size)
    }));
    changed
}

/// Returns the size of the judged quantity in `smaller`, a plan with a smaller motion, over that in
/// `plan`. Each size is divided by the divisor of the errors.
fn size_factor(plan: &ConvergencePlan, smaller: &ConvergencePlan) -> f64 {
    let divisor = |plan: &ConvergencePlan| plan.scale.unwrap_or(1.0);
    let sizes = match (&plan.sum, &smaller.sum, plan.of) {
        (Some(before), Some(after), _) => after.size() / before.size(),
        (_, _, Quantity::Temperature) => 1.0,
        _ => SMALLER,
    };
    sizes * divisor(plan) / divisor(smaller)
}

fn check_remedy(session: &Session<'_>, finest: &ConvergencePlan, diagnosis: &mut Diagnosis) {
    let Some(change) = diagnosis.found().map(|(run, _)| run.change.clone()) else { return };
    let kind = PROBES.into_iter().find(|kind| kind.change == change);
    let Some(plan) = kind.and_then(|kind| (kind.apply)(finest)) else { return };
    let refusal = refusal(session.source, finest, &plan);
    if let Some(run) = diagnosis.runs.iter_mut().find(|run| run.change == change) {
        run.refusal = refusal;
    }
}

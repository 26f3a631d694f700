//! Checks for time steps that are longer than the stable step on some or all levels.

use super::session::{Known, accepts_step, finding, only};
use crate::study::exact_motion::Extremes;
use crate::suite::grammar::StepSpec;
use crate::suite::model::ConvergencePlan;
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::yaml::NumberText;
use crate::verify::{Axis, KnownCause, KnownCauseKind, LevelOutcome, StepKind};

/// Fraction of the predicted stable step that is used when levels run again.
const OF_PREDICTED: f64 = 0.5;

/// Steps above this fraction of the time in which a wave crosses a cell are doubtful, if no stable
/// step is predicted.
const IN_QUESTION: f64 = 0.5;

/// Step of repeated levels if no stable step is predicted, as a fraction of the time in which a
/// wave crosses a cell.
const CAUTIOUS: f64 = 0.2;

/// Maximum ratio of the errors with a stable and with the original step, for which the original
/// step is the cause. In a stable run, reducing the step to 2/5 (`CAUTIOUS / IN_QUESTION`) reduces
/// the error of a method of order 2 in time only to 1/6.
const MENDED: f64 = 0.03;

/// A level whose step exceeds a limit (s), and its repetition with a stable step.
struct Mended<'a> {
    index: usize,
    before: &'a LevelOutcome,
    after: LevelOutcome,
    limit: f64,
}

/// Checks whether the error of some levels becomes small or finite with stable steps.
pub(super) fn check(known: &Known<'_>) -> Option<KnownCause> {
    let (session, plan) = (known.session, known.plan);
    let mended = mended(known)?;
    let worst = mended.iter().max_by(|a, b| a.times().total_cmp(&b.times()))?;
    let last = mended.last()?;
    let name = |level: &Mended<'_>| level.before.name(plan.refine.axis);
    let names: Vec<String> = mended.iter().map(name).collect();
    let place = if mended.len() == known.levels.len() {
        "on all levels".to_owned()
    } else {
        format!("on the levels with {}", names.join(", "))
    };
    let stable = known.levels.iter().enumerate().map(|(k, level)| {
        mended.iter().find(|mended| mended.index == k).map_or(level, |mended| &mended.after)
    });
    let order = session.judge(stable, plan.refine.axis).order;
    let (dt, limit, times) = (worst.before.dt, worst.limit, worst.times());
    let measure = if worst.before.stable_time_step.is_some() {
        format!("{times:.2} times the stable step of {limit:.3e} s")
    } else {
        let crossing = limit / IN_QUESTION;
        format!("{:.2} times the {crossing:.3e} s in which a wave crosses a cell", dt / crossing)
    };
    let before = match &last.before.run.failure {
        Some(reason) => format!("the run fails: {reason}"),
        None if last.before.error.is_finite() => format!("{:.3e}", last.before.error),
        None => "not finite".to_owned(),
    };
    let shown = order.map_or("not determined".to_owned(), |order| order.shown());
    let evidence = format!(
        "With {} the step of {dt:.3e} s is {measure}. With stable steps the error with {} is {:.3e} \
         (before: {before}), and the order over all levels is {shown}.",
        name(worst),
        name(last),
        last.after.error
    );
    let cause = format!("the step is longer than the stable step, {place}");
    let remedy = remedy(known);
    Some(KnownCause { order, ..finding(KnownCauseKind::UnstableStep, cause, evidence, remedy) })
}

impl Mended<'_> {
    fn times(&self) -> f64 {
        self.before.dt / self.limit
    }
}

/// Returns the levels that have a small error only with stable steps; `None` if there are none.
fn mended<'a>(known: &Known<'a>) -> Option<Vec<Mended<'a>>> {
    let (plan, levels) = (known.plan, known.levels);
    let limits: Vec<(usize, f64)> = levels
        .iter()
        .enumerate()
        .filter_map(|(k, level)| Some((k, limit(plan, level)?)))
        .filter(|(k, limit)| levels[*k].dt > *limit)
        .collect();
    let stable = |(k, limit): &(usize, f64)| {
        let is_predicted = levels[*k].stable_time_step.is_some();
        let share = if is_predicted { OF_PREDICTED } else { CAUTIOUS / IN_QUESTION };
        LevelPlan { dt: share * limit, ..plan.refine.levels[*k] }
    };
    let stepped: Vec<LevelPlan> = limits.iter().map(stable).collect();
    if stepped.is_empty() {
        return None;
    }
    let mut changed = only(plan, known.session.case, &stepped);
    changed.refine.rule = plan.refine.rule.map(|_| OF_PREDICTED);
    let found = known.session.changed("stable time steps", &changed)?;
    let is_sound = |level: &LevelOutcome| level.run.failure.is_none() && level.error.is_finite();
    let mut mended = Vec::new();
    for ((index, limit), after) in limits.into_iter().zip(found.levels) {
        let before = &levels[index];
        if is_sound(&after) && (!is_sound(before) || after.error <= MENDED * before.error) {
            mended.push(Mended { index, before, after, limit });
        }
    }
    Some(mended).filter(|mended| !mended.is_empty())
}

/// Returns the time step (s) above which the step of a level is doubtful.
fn limit(plan: &ConvergencePlan, level: &LevelOutcome) -> Option<f64> {
    if plan.steps == StepKind::Load {
        return None;
    }
    // Steps of the built-in MPM are stable, except if a prediction shows that they are too long.
    if level.stable_time_step.is_some() || matches!(plan.cases[0].method, Method::Mpm(_)) {
        return level.stable_time_step;
    }
    let speed = plan.exact.as_ref().map_or(0.0, |exact| Extremes::of(exact).speed);
    let crossing = level.h / (plan.scene.fastest_wave() + speed);
    crossing.is_finite().then_some(IN_QUESTION * crossing)
}

fn remedy(known: &Known<'_>) -> String {
    let source = known.session.source;
    if known.plan.refine.axis == Axis::Time {
        return "leave out the levels with these steps".to_owned();
    }
    if accepts_step(source, StepSpec::Courant(NumberText::Number(OF_PREDICTED))) {
        return "`dt: {courant: 0.5}`, half of the stable step on every level".to_owned();
    }
    let formula = format!("{CAUTIOUS}*h/{:e}", known.plan.scene.fastest_wave());
    let step = StepSpec::Length(NumberText::Formula(formula.clone()));
    if accepts_step(source, step) {
        return format!("`dt: \"{formula}\"`, which follows the cells");
    }
    "shorter steps on these levels".to_owned()
}

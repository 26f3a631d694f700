//! Findings about coarse levels, lack of damping, and errors as large as the solution.

use super::regularity::sizes;
use super::session::{Known, finding};
use crate::study::convergence::judge_plan::largest_exact;
use crate::study::exact_motion::Extremes;
use crate::study::preflight::undamped;
use crate::suite::model::method::Method;
use crate::verify::{
    Axis, FEWEST_LEVELS, Interval, KnownCause, KnownCauseKind, LevelOutcome, OrderHypothesis,
    Verdict, observed_order,
};

/// Maximum share of the difference from the theoretical order that remains without coarse levels,
/// if these are the cause.
const CLOSER: f64 = 0.5;

/// Maximum difference between the order of the finest two levels and the theoretical order, if
/// coarse levels are the cause.
const NEAR: f64 = 2.0 * OrderHypothesis::TOLERANCE;

/// Minimum error that counts as large as the solution, as a fraction of the largest exact value.
const WHOLE: f64 = 0.1;

/// Maximum ratio of the largest to the smallest error that counts as constant.
const CONSTANT: f64 = 1.5;

/// Maximum cell size of a level that resolves the solution, as a fraction of its length scale.
const COARSE: f64 = 0.5;

/// Checks whether coarse levels do not resolve the exact solution: the order without them is much
/// closer to theory, or the orders between neighbouring levels rise to the theoretical order.
pub(super) fn coarse(known: &Known<'_>) -> Option<KnownCause> {
    let (session, axis) = (known.session, known.plan.refine.axis);
    let p = session.formal_order;
    let levels: Vec<&LevelOutcome> = known.levels.iter().filter(|level| level.usable).collect();
    let judge = |levels: &[&LevelOutcome]| session.judge(levels.iter().copied(), axis);
    let observed = judge(&levels).order;
    let off = |order: Option<Interval>| order.map_or(f64::INFINITY, |o| (o.value - p).abs());
    let last_cut = levels.len().checked_sub(FEWEST_LEVELS)?;
    let resolution = resolution(known);
    let cut = (1..=last_cut).map(|cut| (cut, judge(&levels[cut..]))).find(|(_, judgement)| {
        let is_closer = off(judgement.order) <= CLOSER * off(observed);
        judgement.verdict == Verdict::Converging && is_closer
    });
    let shown = |order: Option<Interval>| order.map_or("not determined".to_owned(), |o| o.shown());
    let (count, order, evidence) = if let Some((cut, judgement)) = cut {
        let evidence = format!(
            "Without {}, the order is {} (with all levels: {}).",
            names(&levels[..cut], axis),
            shown(judgement.order),
            shown(observed)
        );
        (cut, judgement.order, evidence)
    } else {
        let (first, last) = rise(&levels, p)?;
        resolution.as_ref().filter(|(share, _)| *share > COARSE)?;
        let evidence = format!(
            "The order between neighbouring levels rises from {first:.2} to {last:.2} (over all \
             levels: {}).",
            shown(observed)
        );
        (1, None, evidence)
    };
    let mut remedy = format!("leave out {}", names(&levels[..count], axis));
    if order.is_none() {
        remedy += ", and add finer levels";
    }
    let evidence = evidence + &resolution.map_or(String::new(), |(_, text)| text);
    let cause = "the first levels are too coarse";
    Some(KnownCause { order, ..finding(KnownCauseKind::CoarseLevels, cause, evidence, remedy) })
}

fn rise(levels: &[&LevelOutcome], p: f64) -> Option<(f64, f64)> {
    let order = |pair: &[&LevelOutcome]| {
        let [coarse, fine] = pair else { return None };
        observed_order(&coarse.to_level(), &fine.to_level())
    };
    let first = order(levels.get(..2)?)?;
    let last = order(&levels[levels.len() - 2..])?;
    ((last - p).abs() <= NEAR && first < p - NEAR).then_some((first, last))
}

/// Returns the coarsest cell size, relative to the length scale of the solution, and a sentence
/// with both numbers.
fn resolution(known: &Known<'_>) -> Option<(f64, String)> {
    let length = sizes(known.plan.exact.as_ref()?, known.session.case.until).length();
    let coarsest = known.levels.first()?.h;
    let share = coarsest / length;
    let text = format!(
        " The exact solution changes over a length of {length:.2e} m (its shortest wavelength \
         divided by 2 pi), and a cell of the first level measures {coarsest:.2e} m, {share:.2} times \
         this length."
    );
    share.is_finite().then_some((share, text))
}

fn names(levels: &[&LevelOutcome], axis: Axis) -> String {
    let names: Vec<String> = levels.iter().map(|level| level.name(axis)).collect();
    let noun = if names.len() == 1 { "level" } else { "levels" };
    format!("the {noun} with {}", names.join(", "))
}

pub(super) fn undamped(known: &Known<'_>) -> Option<KnownCause> {
    let (plan, case) = (known.plan, known.session.case);
    undamped::oscillates(plan, case).then_some(())?;
    let finest = known.levels.last()?;
    let size = Extremes::of(plan.exact.as_ref()?).largest_displacement();
    let speed = finest.run.residual_speed.filter(|speed| speed.is_finite());
    let speed = speed.map_or(String::new(), |speed| {
        format!(" Near the end of the run, the largest speed is {speed:.1e} times the wave speed.")
    });
    let is_external = matches!(case.method, Method::External { .. });
    let unless = if is_external { ", unless the solver itself does" } else { "" };
    let cause =
        format!("nothing removes energy{unless}; the body oscillates about its equilibrium");
    let evidence = format!(
        "The largest displacement of the equilibrium is {size:.3e} m, and the error on the finest \
         level is {:.3e}.{speed}",
        finest.error
    );
    Some(finding(KnownCauseKind::NoDamping, cause, evidence, undamped::HELP))
}

pub(super) fn another_problem(known: &Known<'_>) -> Option<KnownCause> {
    let (plan, case) = (known.plan, known.session.case);
    if !matches!(case.method, Method::External { .. }) || known.levels.len() < FEWEST_LEVELS {
        return None;
    }
    let scale = plan.scale.unwrap_or(1.0);
    let errors = || known.levels.iter().map(|level| level.error * scale);
    let (least, most) = (errors().fold(f64::INFINITY, f64::min), errors().fold(0.0_f64, f64::max));
    let size = largest_exact(plan, case, plan.exact.as_ref()?);
    let are_errors = errors().all(f64::is_finite);
    let is_whole = are_errors && least >= WHOLE * size && most <= CONSTANT * least && size > 0.0;
    is_whole.then_some(())?;
    let cause = "the solver solves another problem: its errors are as large as the solution on all \
                 levels";
    let evidence = format!(
        "The errors lie between {least:.3e} and {most:.3e} on all levels, and the largest exact \
         value is {size:.3e}. Discretisation errors would fall with the cell size."
    );
    let remedy = "`mpm-verify doctor` with the same `--solver`, which looks for such faults: signs \
                  and factors of loads, mass, volume and stiffness, and boundary conditions";
    Some(finding(KnownCauseKind::AnotherProblem, cause, evidence, remedy))
}

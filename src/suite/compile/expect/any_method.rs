//! The accuracy that any method can reach on the problem of a suite.

use super::because::because;
use crate::exact::Problem;
use crate::subject::HIGHEST_ORDER;
use crate::suite::evaluator::{Evaluator, shown};
use crate::suite::grammar::AnyMethodSpec;
use crate::suite::model::ConvergencePlan;
use crate::suite::model::external_method::AnyMethod;
use crate::suite::yaml::{Diagnostic, Path};

/// Places along each axis, and instants, at which a motion is checked to be a translation.
const PLACES: usize = 5;

/// Largest entry of the displacement gradient of a translation, of formulas that round.
const UNDEFORMED: f64 = 1e-14;

/// The key `any_method` of a suite, checked.
pub(crate) fn any_method(
    evaluator: &Evaluator<'_>,
    spec: &AnyMethodSpec,
    plan: &ConvergencePlan,
) -> Result<AnyMethod, Diagnostic> {
    let path = Path::top("any_method");
    let because = because(evaluator, &path, "the accuracy of any method", &spec.because)?;
    let order = spec.order.as_ref().map(|text| {
        let path = path.then("order");
        let order = evaluator.positive(&path, text, "the order")?;
        if order <= HIGHEST_ORDER {
            return Ok(order);
        }
        let message = format!("the order is {}", shown(order));
        let label = format!("expected an order up to {HIGHEST_ORDER}");
        Err(evaluator.diagnostic(&path, &message).with_label(&label))
    });
    let error_below = spec
        .error_below
        .as_ref()
        .map(|text| evaluator.positive(&path.then("error_below"), text, "the bound on errors"));
    let (order, error_below) = (order.transpose()?, error_below.transpose()?);
    let gated = spec.gated.unwrap_or(true);
    let has_bounds = order.is_some() || error_below.is_some();
    if gated && !has_bounds && !spec.any_law {
        let diagnostic = evaluator.diagnostic(&path, "this states nothing that a method can reach");
        let help = "add `order: 1`, `error_below: 1e-12`, `any_law: true` or `gated: false`";
        return Err(diagnostic.with_help(help));
    }
    if !gated && has_bounds {
        let message = "a suite that is not gated has no order and no bound for other methods";
        let diagnostic = evaluator.diagnostic_at_key(&path.then("gated"), message);
        return Err(diagnostic.with_help("remove `gated`, or `order` and `error_below`"));
    }
    if spec.any_law && !plan.exact.as_ref().is_some_and(is_translation) {
        let message = "the law matters, because the solution is not a translation";
        let diagnostic = evaluator.diagnostic(&path.then("any_law"), message);
        return Err(diagnostic.with_help("remove `any_law`"));
    }
    Ok(AnyMethod { order, error_below, any_law: spec.any_law, gated, because })
}

/// Whether the motion neither strains nor rotates the body, which starts without stress.
fn is_translation(problem: &Problem) -> bool {
    let d = problem.dimension();
    let along = |axis: usize, k: usize| {
        let length = problem.to[axis] - problem.from[axis];
        problem.from[axis] + length * (k as f64 + 0.5) / PLACES as f64
    };
    let place = |point: usize| -> Vec<f64> {
        (0..d).map(|axis| along(axis, point / PLACES.pow(axis as u32) % PLACES)).collect()
    };
    let undeformed = |label: &[f64], t: f64| {
        let gradient = problem.motion.derivatives(label, t).grad;
        gradient.iter().flatten().all(|entry| entry.abs() <= UNDEFORMED)
    };
    let times = || (0..=PLACES).map(|k| problem.until * k as f64 / PLACES as f64);
    problem.initial_stress.is_none()
        && (0..PLACES.pow(d as u32)).map(place).all(|label| times().all(|t| undeformed(&label, t)))
}

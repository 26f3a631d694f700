//! Whether what a suite judges is there to be compared: in every subject, and in every truth.

use crate::suite::evaluator::Evaluator;
use crate::suite::grammar::ConvergenceSpec;
use crate::suite::model::ConvergencePlan;
use crate::suite::model::method::Method;
use crate::suite::yaml::{Diagnostic, Path};
use crate::verify::Limits;

/// Refuses to judge a quantity that the reference FEM does not give.
pub(crate) fn refuse_quantity_unknown_to_fem(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
    plan: &ConvergencePlan,
) -> Result<(), Diagnostic> {
    if !plan.of.is_optional() {
        return Ok(());
    }
    let name = plan.of.words();
    let help = "judge the displacement or the velocity";
    if plan.reference.is_some() || plan.same_method.is_some() {
        let message = format!("a reference has no {name} to compare with, which this suite judges");
        return Err(evaluator.diagnostic_at_key(&Path::top("reference"), &message).with_help(help));
    }
    match spec.fem_method() {
        Some(i) => {
            let message = format!("the reference FEM gives no {name}, which this suite judges");
            let diagnostic = evaluator.diagnostic(&Path::top("methods").then(i), &message);
            Err(diagnostic.with_help(help))
        }
        None => Ok(()),
    }
}

/// Refuses to bound the drift of sums that the reference FEM does not give; `path` is that of the
/// expectation.
pub(crate) fn check_drift(
    evaluator: &Evaluator<'_>,
    path: &Path,
    limits: &Limits,
    method: Method,
) -> Result<(), Diagnostic> {
    let key = if limits.energy_rate.is_some() { "energy_rate" } else { "drift" };
    let asks = !limits.drift.is_empty() || limits.energy_rate.is_some();
    if !asks || matches!(method, Method::Mpm { .. } | Method::External { .. }) {
        return Ok(());
    }
    let message = match method {
        Method::Heat { .. } => "a body at rest has no motion whose sums could drift",
        _ => "the reference FEM does not give the sums whose drift is bound here",
    };
    let diagnostic = evaluator.diagnostic_at_key(&path.then(key), message);
    Err(diagnostic.with_help("let this expectation speak of MPM cases only"))
}

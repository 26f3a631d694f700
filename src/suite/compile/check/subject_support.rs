//! Whether what a suite judges is there to be compared: in every subject, and in every truth.

use crate::{
    suite::{
        compile::{evaluator::Binder, path::Path},
        grammar::ConvergenceWords,
        model::{ConvergencePlan, method::Method},
        yaml::Complaint,
    },
    verify::Limits,
};

/// Refuses to judge a quantity that the reference FEM does not give.
pub(crate) fn check(
    binder: &Binder<'_>,
    words: &ConvergenceWords,
    plan: &ConvergencePlan,
) -> Result<(), Complaint> {
    if !plan.of.is_optional() {
        return Ok(());
    }
    let name = plan.of.words();
    let help = "judge the displacement or the velocity";
    if plan.reference.is_some() {
        let message = format!("a reference has no {name} to compare with, which this suite judges");
        return Err(binder.complain_key(&Path::top("reference"), &message).with_help(help));
    }
    match words.fem_method() {
        Some(i) => {
            let message = format!("the reference FEM gives no {name}, which this suite judges");
            let complaint = binder.complain(&Path::top("methods").then(i), &message);
            Err(complaint.with_help(help))
        }
        None => Ok(()),
    }
}

/// Refuses the reference FEM, as method or as reference, for a scene with an effect that it lacks.
pub(crate) fn fem_lacks(
    binder: &Binder<'_>,
    words: &ConvergenceWords,
    effect: &str,
) -> Result<(), Complaint> {
    let message = format!("the reference FEM has no {effect}, and the scene has");
    if words.has_fem_reference() {
        return Err(binder.complain_key(&Path::top("reference"), &message));
    }
    match words.fem_method() {
        Some(i) => Err(binder.complain(&Path::top("methods").then(i), &message)),
        None => Ok(()),
    }
}

/// Refuses to bound the drift of sums that the reference FEM does not give; `path` is that of the
/// expectation.
pub(crate) fn check_drift(
    binder: &Binder<'_>,
    path: &Path,
    limits: &Limits,
    method: Method,
) -> Result<(), Complaint> {
    let key = if limits.energy_rate.is_some() { "energy_rate" } else { "drift" };
    let asks = !limits.drift.is_empty() || limits.energy_rate.is_some();
    if !asks || matches!(method, Method::Mpm { .. }) {
        return Ok(());
    }
    let message = match method {
        Method::Heat { .. } => "a body at rest has no motion whose sums could drift",
        _ => "the reference FEM does not give the sums whose drift is bound here",
    };
    let complaint = binder.complain_key(&path.then(key), message);
    Err(complaint.with_help("let this expectation speak of MPM cases only"))
}

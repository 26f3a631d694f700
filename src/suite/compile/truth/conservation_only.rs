//! Suites without exact solution or reference: there are no errors, and expectations only bound
//! conserved quantities.

use crate::exact::Truth;
use crate::suite::evaluator::Evaluator;
use crate::suite::grammar::{ConvergenceSpec, ExpectSpec};
use crate::suite::model::{ConvergencePlan, SameMethod};
use crate::suite::yaml::{Diagnostic, Path};

/// Placeholder for a suite without exact solution: only conserved sums are judged.
pub(crate) struct Unknown;

impl Truth for Unknown {
    fn displacement(&self, _: &[f64], _: f64, into: &mut [f64]) {
        into.fill(f64::NAN);
    }

    fn velocity(&self, _: &[f64], _: f64, into: &mut [f64]) {
        into.fill(f64::NAN);
    }
}

/// Whether a suite has no exact solution and no reference.
pub(crate) fn is_truthless(plan: &ConvergencePlan) -> bool {
    !plan.has_formulas() && plan.reference.is_none() && !is_truth(plan.same_method)
}

/// Whether the same method can be the only reference of a suite. With shorter steps it only
/// measures the error of the time step, and needs an exact solution in addition.
pub(crate) fn is_truth(same_method: Option<SameMethod>) -> bool {
    matches!(same_method, Some(SameMethod::FineGrid(_)))
}

/// Refuses a suite without exact solution or reference that uses a key which needs one.
pub(crate) fn refuse_need_of_truth(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
    plan: &ConvergencePlan,
) -> Result<(), Diagnostic> {
    if !is_truthless(plan) {
        return Ok(());
    }
    let asked = |spec: &ExpectSpec| {
        let ExpectSpec { order, verdict, finest_pair, floor, drift, energy_rate, .. } = spec;
        let judged = order.is_some() || verdict.is_some() || finest_pair.is_some();
        let kept = drift.is_some() || energy_rate.is_some();
        judged || floor.is_some() || !spec.bounds().is_empty() || !kept
    };
    let full = |spec: &ExpectSpec| spec.full.as_deref().is_some_and(asked);
    if spec.expect.iter().any(|spec| asked(spec) || full(spec)) {
        let message = "no truth: a convergence study needs `exact`, `manufactured`, `equilibrium` or \
                       `reference`";
        let diagnostic = evaluator.diagnostic_at_key(&Path::top("suite"), message);
        return Err(diagnostic
            .with_help("without one, expectations may bound a `drift` or an `energy_rate` only"));
    }
    if spec.observe.is_some() {
        let message = "a place is observed against a truth, and the suite has none";
        return Err(evaluator.diagnostic_at_key(&Path::top("observe"), message));
    }
    Ok(())
}

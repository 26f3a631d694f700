//! Bounds on figures, from an entry of `expect`.

use crate::subject::PlaneState;
use crate::suite::compile::check::energy;
use crate::suite::compile::interval::interval;
use crate::suite::evaluator::Evaluator;
use crate::suite::grammar::{DriftSpec, ExpectSpec};
use crate::suite::model::ConvergencePlan;
use crate::suite::yaml::{Diagnostic, NumberText, Path};
use crate::verify::{Conserved, Limits};

/// The limits of the expectation at `path`.
pub(crate) fn limits(
    evaluator: &Evaluator<'_>,
    path: &Path,
    spec: &ExpectSpec,
    plan: &ConvergencePlan,
) -> Result<Limits, Diagnostic> {
    let bound = |key: &str, text: &Option<NumberText>| {
        text.as_ref().map(|text| evaluator.positive(&path.then(key), text, "a bound")).transpose()
    };
    let limits = Limits {
        error_below: bound("error_below", &spec.error_below)?,
        error_above: bound("error_above", &spec.error_above)?,
        observed_within: bound("observed_within", &spec.observed_within)?,
        rest_below: bound("rest_below", &spec.rest_below)?,
        drift: match &spec.drift {
            Some(spec) => drifts(evaluator, &path.then("drift"), spec, plan)?,
            None => Vec::new(),
        },
        energy_rate: match &spec.energy_rate {
            Some(spec) => {
                let path = path.then("energy_rate");
                energy::refuse_law_without_energy(evaluator, &path, plan)?;
                Some(interval(evaluator, &path, spec)?)
            }
            None => None,
        },
    };
    if let (Some(most), Some(least)) = (limits.error_below, limits.error_above)
        && most < least
    {
        let message = format!("no error is below {most:e} and above {least:e}");
        return Err(evaluator.diagnostic(&path.then("error_above"), &message));
    }
    if limits.observed_within.is_some() && plan.observe.is_none() {
        let diagnostic =
            evaluator.diagnostic_at_key(&path.then("observed_within"), "nothing is observed");
        return Err(diagnostic.with_help("add `observe: {at: [...]}` to the suite"));
    }
    if limits.rest_below.is_some() && !plan.exact.as_ref().is_some_and(|truth| truth.at_rest) {
        let message = "the truth is no state of rest";
        let diagnostic = evaluator.diagnostic_at_key(&path.then("rest_below"), message);
        return Err(diagnostic.with_help("state it under `equilibrium`"));
    }
    Ok(limits)
}

fn drifts(
    evaluator: &Evaluator<'_>,
    path: &Path,
    spec: &DriftSpec,
    plan: &ConvergencePlan,
) -> Result<Vec<(Conserved, f64)>, Diagnostic> {
    let mut drifts = Vec::new();
    for &sum in Conserved::ALL {
        let text = match sum {
            Conserved::Mass => &spec.mass,
            Conserved::Momentum => &spec.momentum,
            Conserved::AngularMomentum => &spec.angular_momentum,
            Conserved::KineticEnergy => &spec.kinetic_energy,
            Conserved::KineticEnergyGain => &spec.kinetic_energy_gain,
            Conserved::Energy => &spec.energy,
        };
        let Some(text) = text else { continue };
        let path = path.then(sum.name());
        if sum == Conserved::AngularMomentum && plan.scene.dimension() == 1 {
            let message = "there is no angular momentum in 1-D";
            return Err(evaluator.diagnostic_at_key(&path, message));
        }
        let is_revolved = plan.scene.plane == PlaneState::Axisymmetric;
        if is_revolved && matches!(sum, Conserved::Momentum | Conserved::AngularMomentum) {
            let message = "a sum over the meridian plane, which a body of revolution does not keep";
            let diagnostic = evaluator.diagnostic_at_key(&path, message);
            return Err(diagnostic.with_help("bound the drift of `mass` or of an energy"));
        }
        if sum == Conserved::Energy {
            energy::refuse_law_without_energy(evaluator, &path, plan)?;
        }
        drifts.push((sum, evaluator.positive(&path, text, "a bound")?));
    }
    if drifts.is_empty() {
        let names: Vec<&str> = Conserved::ALL.iter().map(|sum| sum.name()).collect();
        let diagnostic = evaluator.diagnostic(path, "this bounds no drift");
        return Err(diagnostic.with_help(&format!("name some of: {}", names.join(", "))));
    }
    Ok(drifts)
}

//! Time steps by rule: a share of the stable time step.

use crate::suite::evaluator::Evaluator;
use crate::suite::grammar::{MethodSpec, StepSpec};
use crate::suite::model::Scene;
use crate::suite::yaml::{Diagnostic, NumberText, Path};

/// The share that `auto` takes.
const AUTO: f64 = 0.5;

/// The share of the stable time step that `spec` at `path` asks for, if it is a rule.
pub(crate) fn share(
    evaluator: &Evaluator<'_>,
    path: &Path,
    spec: &StepSpec,
) -> Result<Option<f64>, Diagnostic> {
    match spec {
        StepSpec::Length(_) => Ok(None),
        StepSpec::Auto => Ok(Some(AUTO)),
        StepSpec::Courant(text) => evaluator
            .positive(&path.then("courant"), text, "the share of the stable step")
            .map(Some),
    }
}

/// The step (s) as a formula of h: as stated, or, for a rule, its value before any particle is
/// known.
pub(crate) fn formula_text(
    evaluator: &Evaluator<'_>,
    path: &Path,
    spec: &StepSpec,
    scene: &Scene,
) -> Result<NumberText, Diagnostic> {
    let share = match (spec, share(evaluator, path, spec)?) {
        (StepSpec::Length(text), _) => return Ok(text.clone()),
        (_, share) => share.unwrap_or(AUTO),
    };
    let speed = scene.fastest_wave();
    if speed > 0.0 && speed.is_finite() {
        let [share, speed] = [share, speed].map(NumberText::Number);
        return Ok(NumberText::Formula(format!("{share}*h/{speed}")));
    }
    let message = "a time step is chosen by the speed of waves, and this body has none";
    Err(evaluator.diagnostic(path, message).with_label("expected a number"))
}

/// Refuses methods whose steps no rule can choose.
pub(crate) fn refuse_methods_without_rule(
    evaluator: &Evaluator<'_>,
    methods: &[MethodSpec],
    rule: Option<f64>,
) -> Result<(), Diagnostic> {
    let steps = |method: &MethodSpec| {
        matches!(method, MethodSpec::Mpm { .. } | MethodSpec::External { .. })
    };
    let other = methods.iter().position(|method| !steps(method));
    let (Some(i), Some(_)) = (other, rule) else { return Ok(()) };
    let message = "the time step is chosen by a rule, which is one for the steps of MPM in motion";
    let diagnostic = evaluator.diagnostic(&Path::top("methods").then(i), message);
    Err(diagnostic
        .with_help("state `dt` as a number or a formula of h, or put this into a suite of its own"))
}

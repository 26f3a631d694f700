//! Damping, and what it asks of a suite.

use crate::{
    exact::formula::Formula,
    suite::{
        compile::{
            check::subject_support::fem_lacks, evaluator::Evaluator, path::Path, wording::shown,
        },
        grammar::{ConvergenceSpec, LoadSpec},
        model::Scene,
        yaml::{Diagnostic, NumberText},
    },
};

/// Times of a run at which the rate is looked at.
const TIMES: u32 = 1000;

/// Refuses a rate that is negative at some time up to `until` (s), the FEM, which has no damping,
/// and a manufactured force beside a local damping, which would oppose it too.
pub(crate) fn check(
    evaluator: &Evaluator<'_>,
    words: &ConvergenceSpec,
    scene: &Scene,
    until: f64,
) -> Result<(), Diagnostic> {
    if scene.local_damping.is_some() && words.manufactured.is_some() {
        let message = "local damping opposes the whole force, and a part of it is manufactured";
        let diagnostic = evaluator.diagnostic_at_key(&Path::top("manufactured"), message);
        return Err(diagnostic.with_help("state the motion under `exact`, or use `damping`"));
    }
    if let Some(rate) = &scene.damping {
        never_negative(evaluator, words, rate, until)?;
    } else if scene.local_damping.is_none() {
        return Ok(());
    }
    fem_lacks(evaluator, words, "damping")
}

fn never_negative(
    evaluator: &Evaluator<'_>,
    words: &ConvergenceSpec,
    rate: &Formula,
    until: f64,
) -> Result<(), Diagnostic> {
    let load = words.scene.loads.iter().position(|load| matches!(load, LoadSpec::Damping(_)));
    let path = Path::top("scene").then("loads").then(load.unwrap_or(0)).then("damping");
    for k in 0..=TIMES {
        let t = until * f64::from(k) / f64::from(TIMES);
        let alpha = rate.eval(&[t]);
        if !(alpha >= 0.0 && alpha.is_finite()) {
            let message = format!("the rate of damping is {} at t = {}", shown(alpha), shown(t));
            let label = "expected zero or a positive number (1/s)";
            return Err(evaluator.diagnostic(&path, &message).with_label(label));
        }
    }
    Ok(())
}

/// Gives the scene a local damping, a share of the force out of balance.
pub(crate) fn add_local(
    evaluator: &Evaluator<'_>,
    path: &Path,
    text: &NumberText,
    scene: &mut Scene,
) -> Result<(), Diagnostic> {
    if scene.local_damping.is_some() {
        return Err(evaluator.diagnostic(path, "local damping appears twice"));
    }
    let share = evaluator.number(path, text)?;
    if !(0.0..1.0).contains(&share) {
        let message = format!("the share of local damping is {}", shown(share));
        let label = "expected zero or a number below 1";
        return Err(evaluator.diagnostic(path, &message).with_label(label));
    }
    scene.local_damping = Some(share);
    Ok(())
}

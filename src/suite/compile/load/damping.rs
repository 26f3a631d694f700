//! Damping, and what it asks of a suite.

use crate::{
    exact::formula::Formula,
    suite::{
        compile::{
            check::subject_support::fem_lacks, evaluator::Binder, path::Path, wording::shown,
        },
        grammar::{ConvergenceWords, LoadWords},
        model::Scene,
        yaml::{Complaint, NumberText},
    },
};

/// Times of a run at which the rate is looked at.
const TIMES: u32 = 1000;

/// Refuses a rate that is negative at some time up to `until` (s), the FEM, which has no damping,
/// and a manufactured force beside a local damping, which would oppose it too.
pub(crate) fn check(
    binder: &Binder<'_>,
    words: &ConvergenceWords,
    scene: &Scene,
    until: f64,
) -> Result<(), Complaint> {
    if scene.local_damping.is_some() && words.manufactured.is_some() {
        let message = "local damping opposes the whole force, and a part of it is manufactured";
        let complaint = binder.complain_key(&Path::top("manufactured"), message);
        return Err(complaint.with_help("state the motion under `exact`, or use `damping`"));
    }
    if let Some(rate) = &scene.damping {
        never_negative(binder, words, rate, until)?;
    } else if scene.local_damping.is_none() {
        return Ok(());
    }
    fem_lacks(binder, words, "damping")
}

fn never_negative(
    binder: &Binder<'_>,
    words: &ConvergenceWords,
    rate: &Formula,
    until: f64,
) -> Result<(), Complaint> {
    let load = words.scene.loads.iter().position(|load| matches!(load, LoadWords::Damping(_)));
    let path = Path::top("scene").then("loads").then(load.unwrap_or(0)).then("damping");
    for k in 0..=TIMES {
        let t = until * f64::from(k) / f64::from(TIMES);
        let alpha = rate.eval(&[t]);
        if !(alpha >= 0.0 && alpha.is_finite()) {
            let message = format!("the rate of damping is {} at t = {}", shown(alpha), shown(t));
            let label = "expected zero or a positive number (1/s)";
            return Err(binder.complain(&path, &message).with_label(label));
        }
    }
    Ok(())
}

/// Gives the scene a local damping, a share of the force out of balance.
pub(crate) fn add_local(
    binder: &Binder<'_>,
    path: &Path,
    text: &NumberText,
    scene: &mut Scene,
) -> Result<(), Complaint> {
    if scene.local_damping.is_some() {
        return Err(binder.complain(path, "local damping appears twice"));
    }
    let share = binder.number(path, text)?;
    if !(0.0..1.0).contains(&share) {
        let message = format!("the share of local damping is {}", shown(share));
        let label = "expected zero or a number below 1";
        return Err(binder.complain(path, &message).with_label(label));
    }
    scene.local_damping = Some(share);
    Ok(())
}

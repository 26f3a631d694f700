//! What damping asks of a suite.

use super::{
    binder::Binder,
    model::Scene,
    path::Path,
    wording::shown,
    words::{ConvergenceWords, LoadWords},
    yaml::Complaint,
};

/// Times of a run at which the rate is looked at.
const TIMES: u32 = 1000;

/// Refuses a rate that is negative at some time up to `until` (s), and the FEM, which has no
/// damping.
pub(super) fn check(
    binder: &Binder<'_>,
    words: &ConvergenceWords,
    scene: &Scene,
    until: f64,
) -> Result<(), Complaint> {
    let Some(rate) = &scene.damping else { return Ok(()) };
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
    if words.has_fem_reference() {
        let message = "the reference FEM has no damping, and the scene has";
        return Err(binder.complain_key(&Path::top("reference"), message));
    }
    match words.fem_method() {
        Some(i) => {
            let message = "the reference FEM has no damping, and the scene has";
            Err(binder.complain(&Path::top("methods").then(i), message))
        }
        None => Ok(()),
    }
}

//! Numbers of single precision of a solver that is not of this crate.

use super::floor;
use super::subject::Preflight;
use crate::suite::model::method::Method;
use crate::suite::yaml::Diagnostic;
use crate::verify::Axis;

/// Half a unit in the last place of a number of 24 bits next to one.
const ROUND_OFF: f64 = 1.0 / (1 << 24) as f64;

/// Says how large the error is that a position of single precision has, before any step adds to it,
/// and from which level on it shows.
pub(crate) fn check(preflight: &Preflight<'_>) -> Vec<Diagnostic> {
    let single = Method::is_single_precision;
    let is_single = preflight.of_an_order().any(|case| single(&case.method));
    let (Some(motion), true) = (&preflight.extremes, is_single) else { return Vec::new() };
    if preflight.plan.refine.axis != Axis::Space {
        return Vec::new();
    }
    let farthest = motion.reach.iter().flat_map(|(low, high)| [low.abs(), high.abs()]);
    let error = ROUND_OFF * farthest.filter(|x| x.is_finite()).fold(0.0, f64::max);
    let origin = "the solver computes in single precision, and positions are rounded:";
    let help = "a larger amplitude raises the errors of the cells above it";
    floor::finding(preflight, error, origin, help).into_iter().collect()
}

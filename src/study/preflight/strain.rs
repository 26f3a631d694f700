//! A solution of small strain or of a linearised law beside a solver that has neither.

use super::floor;
use super::subject::Preflight;
use crate::study::exact_motion::Linearisation;
use crate::suite::model::method::Method;
use crate::suite::model::{Against, Case};
use crate::suite::yaml::Diagnostic;
use crate::verify::Axis;

/// The error of a solution that is not one of the solver's problem.
struct ModelError {
    /// Its size (m).
    size: f64,
    /// Where it comes from.
    origin: String,
    /// Another solution, without it.
    remedy: &'static str,
}

/// That of `case`, if it has one: measured of a linearised solution, and estimated of one of small
/// strain, for the law in rate form that MPM has there is none of the truth's.
fn model_error(preflight: &Preflight<'_>, case: &Case) -> Option<ModelError> {
    let problem = preflight.plan.exact.as_ref()?;
    let motion = preflight.extremes.as_ref()?;
    let norm = preflight.plan.norm;
    if let Some(Linearisation { residual, error }) =
        Linearisation::of(problem, motion, case.until, norm)
    {
        let origin = format!(
            "the truth is linearised: of the terms of its equations {residual:.1e} is left"
        );
        let remedy = "or state a solution of the law itself";
        return Some(ModelError { size: error, origin: origin + ", and", remedy });
    }
    let strain = motion.gradient;
    let is_small = !problem.equation.is_finite() && strain > 0.0;
    if !is_small || !matches!(case.method, Method::Mpm { .. }) {
        return None;
    }
    // The neglected forces are of the order of the strain e: they accelerate by e u_tt, which in a
    // time t comes to e u_tt t^2/2, and over a long run to no more than about e u.
    // In more than one dimension a body turns, and its initial stress with it.
    let turning = if problem.dimension() > 1 { motion.initial_stress } else { 0.0 };
    let neglected = strain + turning / problem.equation.modulus();
    let early = 0.5 * motion.acceleration * case.until * case.until;
    let early = if problem.at_rest { f64::INFINITY } else { early };
    let origin = format!(
        "the truth is one of small strain, and MPM has finite strains: at a strain of {strain:.1e}"
    );
    let remedy = "or state a finite-strain truth";
    Some(ModelError { size: neglected * motion.largest_displacement().min(early), origin, remedy })
}

/// Says how large the error is, and from which level on it shows: a warning, if that is one of the
/// suite's, and a note, if it is soon to come.
pub(crate) fn check(preflight: &Preflight<'_>) -> Vec<Diagnostic> {
    let plan = preflight.plan;
    if plan.refine.axis != Axis::Space || plan.manufactured().is_some() {
        return Vec::new();
    }
    let mut exact = preflight.of_an_order().filter(|case| case.against == Against::Exact);
    let Some(error) = exact.find_map(|case| model_error(preflight, case)) else {
        return Vec::new();
    };
    let ModelError { size, origin, remedy } = error;
    let help = format!("a tenth of the amplitude leaves a hundredth of it; {remedy}");
    floor::finding(preflight, size, &origin, &help).into_iter().collect()
}

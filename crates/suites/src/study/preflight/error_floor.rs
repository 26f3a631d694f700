//! Reports errors that refinement does not lower, and the first level on which they are visible.

use super::subject::Preflight;
use crate::study::exact_motion::{Extremes, Linearisation};
use crate::suite::compile::truth::tolerance::TOLERANCE;
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{Against, Case};
use crate::suite::yaml::{Diagnostic, Severity};
use crate::verify::{Axis, Quantity, rounding_bound, single_precision_spacing};

/// Another error changes the observed order if it exceeds this fraction of the error due to cells.
const SEEN: f64 = 0.3;

/// Fraction of the discretisation error above which another error becomes visible after a few
/// refinements.
const SOON: f64 = 0.003;

/// Estimates the interpolation error (m) of linear functions: h^2/8 times the second derivative.
fn of_cells(preflight: &Preflight<'_>, h: f64) -> f64 {
    let curvature = preflight.extremes.as_ref().map_or(0.0, |motion| motion.curvature);
    0.125 * h * h * curvature
}

/// Reports an error (m): a warning if it is visible on a level of the suite, and a note if it would
/// be visible on one of the next finer levels.
fn floor_finding(
    preflight: &Preflight<'_>,
    size: f64,
    origin: &str,
    help: &str,
) -> Option<Diagnostic> {
    let of_cells = |h: f64| of_cells(preflight, h);
    let shows = preflight.levels().iter().find(|level| size > SEEN * of_cells(level.h));
    let (severity, level) = match (shows, preflight.levels().last()) {
        (Some(level), _) => {
            (Severity::Warning, format!("becomes visible from about {} cells on", level.cells))
        }
        (None, Some(finest)) if size > SOON * of_cells(finest.h) => {
            let times = (SEEN * of_cells(finest.h) / size).sqrt();
            let cells = format!("{:.0e}", times * finest.cells as f64);
            let cells: f64 = cells.parse().unwrap_or(f64::NAN);
            (Severity::Note, format!("would become visible from about {cells} cells on"))
        }
        _ => return None,
    };
    let message = format!("{origin} an error of about {size:.1e} m remains, which {level}");
    let found = preflight.finding(severity, &preflight.motion(), &message);
    Some(if severity == Severity::Warning { found.with_help(help) } else { found })
}

/// Error of a solution that does not solve the problem of the solver exactly.
struct ModelError {
    /// Size of the error (m).
    size: f64,
    origin: String,
    /// Advice to use a solution without this error.
    remedy: &'static str,
}

/// Determines the model error of `case`, if there is one. The error of a linearised solution is
/// computed from the residual. The error of a small-strain solution is estimated, because the law
/// in rate form that MPM uses differs from the law of the solution.
fn model_error(preflight: &Preflight<'_>, case: &Case) -> Option<ModelError> {
    let problem = preflight.plan.exact.as_ref()?;
    let motion = preflight.extremes.as_ref()?;
    let norm = preflight.plan.norm;
    if let Some(Linearisation { residual, error }) =
        Linearisation::of(problem, motion, case.until, norm)
    {
        let origin = format!(
            "the exact solution is linearised, with a residual of {residual:.1e} of the terms of \
             its equations:"
        );
        let remedy = "or state an exact solution of the law itself";
        return Some(ModelError { size: error, origin, remedy });
    }
    let strain = motion.gradient;
    let is_small = !problem.equation.is_finite() && strain > 0.0;
    if !is_small || !matches!(case.method, Method::Mpm(_)) {
        return None;
    }
    // The neglected forces are of the order of the strain e. They cause an acceleration e u_tt, and
    // so a displacement e u_tt t^2/2 after a time t, at most about e u over a long run. In more
    // than one dimension, the initial stress rotates with the body, which the small-strain solution
    // neglects.
    let turning = if problem.dimension() > 1 { motion.initial_stress } else { 0.0 };
    let neglected = strain + turning / problem.modulus();
    let early = 0.5 * motion.acceleration * case.until * case.until;
    let early = if problem.at_rest { f64::INFINITY } else { early };
    let origin = format!(
        "the exact solution assumes small strains, but MPM computes finite strains: at a strain of \
         {strain:.1e}"
    );
    let remedy = "or state a finite-strain solution";
    Some(ModelError { size: neglected * motion.largest_displacement().min(early), origin, remedy })
}

/// Reports the model error of an exact solution that is linearised or assumes small strains.
pub(crate) fn small_strain(preflight: &Preflight<'_>) -> Vec<Diagnostic> {
    let plan = preflight.plan;
    if plan.refine.axis != Axis::Space || plan.manufactured().is_some() {
        return Vec::new();
    }
    let mut exact = preflight.of_an_order().filter(|case| case.against == Against::Exact);
    let Some(error) = exact.find_map(|case| model_error(preflight, case)) else {
        return Vec::new();
    };
    let ModelError { size, origin, remedy } = error;
    let help = format!("a tenth of the amplitude reduces this error to a hundredth; {remedy}");
    floor_finding(preflight, size, &origin, &help).into_iter().collect()
}

/// Minimum number of levels whose error must be larger than the rounding bound.
const LEVELS: usize = 4;

/// A level with its predicted errors (m).
struct LevelPrediction {
    cells: u64,
    /// Error due to cells, estimated as the interpolation error of linear functions.
    discretisation: f64,
    /// Bound on the rounding errors of positions.
    rounding: f64,
}

/// Reports the first level whose predicted error is below the rounding bound: a warning if fewer
/// than [`LEVELS`] levels are above the bound, otherwise a note.
pub(crate) fn single_precision(preflight: &Preflight<'_>) -> Vec<Diagnostic> {
    let plan = preflight.plan;
    let case = preflight.of_an_order().find(|case| case.method.is_single_precision());
    let (Some(motion), Some(case)) = (&preflight.extremes, case) else { return Vec::new() };
    if plan.refine.axis != Axis::Space || plan.of != Quantity::Displacement {
        return Vec::new();
    }
    let Some(spacing) = single_precision_spacing(motion.largest_coordinate()) else {
        return Vec::new();
    };
    let prediction = |level: &LevelPlan| {
        let steps = case.clock(plan, level.dt)?.steps;
        Some(LevelPrediction {
            cells: level.cells,
            discretisation: of_cells(preflight, level.h),
            rounding: rounding_bound(steps, spacing, plan.norm),
        })
    };
    let levels: Vec<LevelPrediction> = preflight.levels().iter().filter_map(prediction).collect();
    let is_above = |level: &&LevelPrediction| level.discretisation > level.rounding;
    let Some(first) = levels.iter().find(|level| !is_above(level)) else { return Vec::new() };
    let above = levels.iter().filter(is_above).count();
    let message = format!(
        "the solver computes in single precision: from {} cells on, the discretisation error, \
         about {:.1e} m, is below the rounding bound of {:.1e} m, so these levels do not count",
        first.cells, first.discretisation, first.rounding
    );
    let severity = if above < LEVELS { Severity::Warning } else { Severity::Note };
    let found = preflight.finding(severity, &preflight.motion(), &message);
    let Some(fourth) = levels.get(LEVELS - 1).filter(|_| above < LEVELS) else {
        return vec![found];
    };
    let amplitude = two_digits(fourth.rounding / fourth.discretisation);
    let help = format!(
        "an amplitude {amplitude} times as large leaves {LEVELS} levels above the bound, as long \
         as particles stay in their cells"
    );
    let help = match nearer_origin(motion, spacing) {
        Some(factor) => {
            help + &format!(
                "; a body that is centred at the origin has a bound {factor} times smaller"
            )
        }
        None => help,
    };
    vec![found.with_help(&help)]
}

/// Returns the factor by which rounding errors decrease if the body is centred at the origin;
/// `None` if they do not decrease.
fn nearer_origin(motion: &Extremes, spacing: f64) -> Option<f64> {
    let lengths = motion.reach.iter().map(|(low, high)| high - low);
    let half = 0.5 * lengths.filter(|length| length.is_finite()).fold(0.0, f64::max);
    let factor = spacing / single_precision_spacing(half)?;
    (factor > 1.0).then_some(factor)
}

fn two_digits(factor: f64) -> f64 {
    let text = format!("{:.1e}", 1.05 * factor);
    text.parse().unwrap_or(factor)
}

/// Maximum ratio of tolerance to residual. A larger tolerance could accept a wrong solution.
const MOST: f64 = 100.0;

/// Reports, as a note, a tolerance that exceeds the residual by orders of magnitude.
pub(crate) fn loose_tolerance(preflight: &Preflight<'_>) -> Vec<Diagnostic> {
    let Some(problem) = &preflight.plan.exact else { return Vec::new() };
    let Some(stated) = &problem.linearised else { return Vec::new() };
    let (left, allowed) = (problem.residual(), stated.tolerance);
    let help = if left <= TOLERANCE {
        "the residual is only rounding: remove `linearised`".to_owned()
    } else if allowed > MOST * left {
        let enough: f64 = format!("{:.0e}", 2.0 * left).parse().unwrap_or(left);
        format!("{enough:e} is sufficient, and accepts fewer wrong solutions")
    } else {
        return Vec::new();
    };
    let message = format!(
        "the stated `tolerance` is {allowed:.1e}, but the residual of the solution is only \
         {left:.1e}"
    );
    let path = preflight.truth().then("linearised").then("tolerance");
    vec![preflight.finding(Severity::Note, &path, &message).with_help(&help)]
}

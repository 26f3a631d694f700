//! A truth of small strain beside a solver of finite strain.

use super::subject::Preflight;
use crate::suite::model::method::Method;
use crate::suite::model::{Against, Case};
use crate::suite::yaml::{Diagnostic, Severity};
use crate::verify::Axis;

/// Share of the error of the cells from which on another one bends its order.
const SEEN: f64 = 0.3;

/// Share from which on a few refinements more will show it.
const SOON: f64 = 0.003;

/// Estimated error (m) of a truth of small strain, and the largest strain.
///
/// The neglected forces are of the order of the strain e: they accelerate by e u_tt, which in a
/// time t comes to e u_tt t^2/2, and over a long run to no more than about e u.
pub(crate) fn small_strain_error(preflight: &Preflight<'_>, until: f64) -> Option<(f64, f64)> {
    let problem = preflight.plan.exact.as_ref()?;
    let motion = preflight.extremes.as_ref()?;
    let strain = motion.gradient;
    let is_small = !problem.equation.is_finite() && !problem.at_rest && strain > 0.0;
    let early = 0.5 * motion.acceleration * until * until;
    is_small.then(|| (strain * motion.largest_displacement().min(early), strain))
}

/// Says how large the error is that a truth of small strain leaves, and from which level on it
/// shows: a warning, if that is one of the suite's, and a note, if it is soon to come.
pub(crate) fn check(preflight: &Preflight<'_>) -> Vec<Diagnostic> {
    let finite =
        |case: &&Case| matches!(case.method, Method::Mpm { .. }) && case.against == Against::Exact;
    let Some(case) = preflight.of_an_order().find(finite) else { return Vec::new() };
    let Some((left, strain)) = small_strain_error(preflight, case.until) else {
        return Vec::new();
    };
    let plan = preflight.plan;
    if plan.refine.axis != Axis::Space || plan.manufactured().is_some() {
        return Vec::new();
    }
    let curvature = preflight.extremes.as_ref().map_or(0.0, |motion| motion.curvature);
    // Interpolation by linear functions: h^2/8 times the second derivative.
    let of_cells = |h: f64| 0.125 * h * h * curvature;
    let shows = preflight.levels().iter().find(|level| left > SEEN * of_cells(level.h));
    let (severity, level) = match (shows, preflight.levels().last()) {
        (Some(level), _) => {
            (Severity::Warning, format!("shows from about {} cells on", level.cells))
        }
        (None, Some(finest)) if left > SOON * of_cells(finest.h) => {
            let times = (SEEN * of_cells(finest.h) / left).sqrt();
            let cells = format!("{:.0e}", times * finest.cells as f64);
            let cells: f64 = cells.parse().unwrap_or(f64::NAN);
            (Severity::Note, format!("will show from about {cells} cells on"))
        }
        _ => return Vec::new(),
    };
    let message = format!(
        "the truth is one of small strain, and MPM has finite strains: at a strain of {strain:.1e} \
         this leaves an error of about {left:.1e} m, which {level}"
    );
    let found = preflight.finding(severity, &preflight.motion(), &message);
    let help = "a tenth of the amplitude leaves a hundredth of it; or state a finite-strain truth";
    vec![if severity == Severity::Warning { found.with_help(help) } else { found }]
}

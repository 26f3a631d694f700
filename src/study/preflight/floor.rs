//! An error that no refinement lowers, and the level from which on it shows.

use super::subject::Preflight;
use crate::suite::yaml::{Diagnostic, Severity};

/// Share of the error of the cells from which on another one bends its order.
const SEEN: f64 = 0.3;

/// Share from which on a few refinements more will show it.
const SOON: f64 = 0.003;

/// The finding about an error of `size` (m) that comes from `origin`: a warning with `help`, if one
/// of the suite's levels shows it, a note, if one soon to come will, and none otherwise.
pub(crate) fn finding(
    preflight: &Preflight<'_>,
    size: f64,
    origin: &str,
    help: &str,
) -> Option<Diagnostic> {
    let curvature = preflight.extremes.as_ref().map_or(0.0, |motion| motion.curvature);
    // Interpolation by linear functions: h^2/8 times the second derivative.
    let of_cells = |h: f64| 0.125 * h * h * curvature;
    let shows = preflight.levels().iter().find(|level| size > SEEN * of_cells(level.h));
    let (severity, level) = match (shows, preflight.levels().last()) {
        (Some(level), _) => {
            (Severity::Warning, format!("shows from about {} cells on", level.cells))
        }
        (None, Some(finest)) if size > SOON * of_cells(finest.h) => {
            let times = (SEEN * of_cells(finest.h) / size).sqrt();
            let cells = format!("{:.0e}", times * finest.cells as f64);
            let cells: f64 = cells.parse().unwrap_or(f64::NAN);
            (Severity::Note, format!("will show from about {cells} cells on"))
        }
        _ => return None,
    };
    let message = format!("{origin} this leaves an error of about {size:.1e} m, which {level}");
    let found = preflight.finding(severity, &preflight.motion(), &message);
    Some(if severity == Severity::Warning { found.with_help(help) } else { found })
}

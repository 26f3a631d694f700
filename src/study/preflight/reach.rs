//! A motion that leaves the grid.

use super::subject::{Preflight, moves_on_grid};
use crate::suite::scene::grid_size::grid_axis;
use crate::suite::yaml::{Diagnostic, Severity};

/// Distance beyond the grid that is rounding, in cells.
const ROUNDING: f64 = 1e-6;

/// Warns of an exact motion that carries the body beyond the grid of some level.
pub(crate) fn check(preflight: &Preflight<'_>) -> Vec<Diagnostic> {
    let plan = preflight.plan;
    let (Some(motion), true) = (&preflight.extremes, plan.cases.iter().any(moves_on_grid)) else {
        return Vec::new();
    };
    let scene = &plan.scene;
    let is_periodic =
        |axis: usize| scene.faces.iter().any(|face| face.axis == axis && face.hold.is_periodic());
    for level in preflight.levels() {
        for axis in (0..scene.dimension()).filter(|axis| !is_periodic(*axis)) {
            let (start, cells) = grid_axis(scene, axis, level.h);
            let end = start + cells * level.h;
            let (low, high) = motion.reach[axis];
            let room = ROUNDING * level.h;
            if low >= start - room && high <= end + room {
                continue;
            }
            let name = ["x", "y", "z"][axis];
            let message = format!(
                "the motion takes {name} from {low:.4} to {high:.4} m, and with {} cells the grid \
                 goes from {start:.4} to {end:.4} m",
                level.cells
            );
            let found = preflight.finding(Severity::Warning, &preflight.motion(), &message);
            let help = "state a larger `grid` in `scene`, or a smaller motion";
            return vec![found.with_help(help)];
        }
    }
    Vec::new()
}

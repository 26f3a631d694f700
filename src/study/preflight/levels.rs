//! Levels that can count for an order.

use super::subject::{Preflight, moves_on_grid};
use crate::study::exact_motion::Extremes;
use crate::suite::grammar::CrossingLevels;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::scene::grid_size::per_axis;
use crate::suite::yaml::{Diagnostic, Severity};
use crate::verify::FEWEST_LEVELS;

/// Warns of a claimed order that too few levels can support.
pub(crate) fn check(preflight: &Preflight<'_>) -> Vec<Diagnostic> {
    let levels = preflight.levels();
    let excluded = preflight.plan.crossing_levels == CrossingLevels::Excluded;
    let Some(case) = preflight.of_an_order().next() else { return Vec::new() };
    if levels.len() < FEWEST_LEVELS {
        let message = format!("{} levels support no order", levels.len());
        let label = format!("expected at least {FEWEST_LEVELS}");
        let found = preflight.finding(Severity::Warning, &preflight.sizes(), &message);
        return vec![found.with_label(&label)];
    }
    let counting = levels.iter().filter(|level| !crosses(preflight, level)).count();
    let moves = preflight.of_an_order().any(moves_on_grid);
    if !excluded || !moves || counting >= FEWEST_LEVELS {
        return Vec::new();
    }
    let message = format!(
        "particles change their cell on {} of {} levels, which then do not count",
        levels.len() - counting,
        levels.len()
    );
    let label = format!("expected at least {FEWEST_LEVELS} levels that count");
    let help = format!("a smaller motion or coarser levels: case `{}` claims an order", case.name);
    let found = preflight.finding(Severity::Warning, &preflight.sizes(), &message);
    vec![found.with_label(&label).with_help(&help)]
}

/// Whether the exact motion carries a particle into another cell. Particles of an aligned body are
/// half of their spacing away from the faces of a cell.
fn crosses(preflight: &Preflight<'_>, level: &LevelPlan) -> bool {
    let dimension = preflight.plan.scene.dimension();
    let per_axis = level.ppc.and_then(|ppc| per_axis(ppc, dimension)).unwrap_or(1);
    let room = 0.5 * level.h / per_axis as f64;
    let largest = preflight.extremes.as_ref().map_or(0.0, Extremes::largest_displacement);
    largest > room
}

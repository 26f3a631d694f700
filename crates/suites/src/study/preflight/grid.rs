//! Checks the number of levels that count for an order, and the positions of particles in the grid.

use super::subject::{Preflight, moves_on_grid};
use crate::mpm::BasisName;
use crate::mpm::input::MpmMethod;
use crate::study::exact_motion::Extremes;
use crate::suite::grammar::CrossingLevels;
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{ConvergencePlan, SceneFace};
use crate::suite::scene::{grid_axis, per_axis};
use crate::suite::yaml::locate::Path;
use crate::suite::yaml::{Diagnostic, Severity};
use crate::verify::FEWEST_LEVELS;

pub(crate) fn few_levels(preflight: &Preflight<'_>) -> Vec<Diagnostic> {
    let levels = preflight.levels();
    let excluded = preflight.plan.crossing_levels == CrossingLevels::Excluded;
    let Some(case) = preflight.of_an_order().next() else { return Vec::new() };
    if levels.len() < FEWEST_LEVELS {
        let message = format!("{} levels are too few for an order", levels.len());
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
        "particles change their cell on {} of {} levels, which therefore do not count",
        levels.len() - counting,
        levels.len()
    );
    let label = format!("expected at least {FEWEST_LEVELS} levels that count");
    let help = format!(
        "use a smaller motion or coarser levels, because case `{}` claims an order",
        case.name
    );
    let found = preflight.finding(Severity::Warning, &preflight.sizes(), &message);
    vec![found.with_label(&label).with_help(&help)]
}

/// Whether the exact motion moves a particle by more than half of the particle spacing, the
/// distance of the particles of an aligned body from the cell faces.
fn crosses(preflight: &Preflight<'_>, level: &LevelPlan) -> bool {
    let dimension = preflight.plan.scene.dimension();
    let per_axis = level.ppc.and_then(|ppc| per_axis(ppc, dimension)).unwrap_or(1);
    let room = 0.5 * level.h / per_axis as f64;
    let largest = preflight.extremes.as_ref().map_or(0.0, Extremes::largest_displacement);
    largest > room
}

/// Maximum distance (cells) outside the grid that counts as rounding error.
const ROUNDING: f64 = 1e-6;

pub(crate) fn leaves_grid(preflight: &Preflight<'_>) -> Vec<Diagnostic> {
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
                "the motion extends in {name} from {low:.4} to {high:.4} m, but with {} cells the \
                 grid extends from {start:.4} to {end:.4} m",
                level.cells
            );
            let found = preflight.finding(Severity::Warning, &preflight.motion(), &message);
            // A body with a condition on a face must end where the grid ends.
            let is_beyond = |face: &SceneFace| {
                face.axis == axis && if face.high { high > end + room } else { low < start - room }
            };
            let is_held = scene.faces.iter().any(|face| is_beyond(face) && !face.hold.is_free());
            let help = if is_held {
                "state a smaller motion: the grid must end at a face that has a condition"
            } else {
                "state a larger `grid` in `scene`, or a smaller motion"
            };
            return vec![found.with_help(help)];
        }
    }
    Vec::new()
}

/// Warns of a box whose last row of particles lies on nodes other than the last nodes of the grid.
/// A particle on a node belongs to the next cell, whose far node then has no mass: conditions and
/// forces on this node have no effect with linear functions.
pub(crate) fn end_on_node(preflight: &Preflight<'_>) -> Vec<Diagnostic> {
    let plan = preflight.plan;
    let is_linear = |method| {
        use BasisName::Linear;
        matches!(
            method,
            Method::Mpm(MpmMethod { basis: Linear, .. })
                | Method::QuasiStatic { basis: Linear, .. }
        )
    };
    let is_box = plan.scene.outline.is_none() && plan.scene.bodies.is_empty();
    let stays = plan.scene.initial_displacement.is_empty() && plan.scatter.perturb == 0.0;
    if !is_box || !stays || !plan.cases.iter().any(|case| is_linear(case.method)) {
        return Vec::new();
    }
    let axes = 0..plan.scene.dimension();
    let mut all = axes.flat_map(|axis| preflight.levels().iter().map(move |level| (axis, level)));
    let found = all.find_map(|(axis, level)| {
        let x = last_on_node(plan, axis, level)?;
        let (cells, name) = (level.cells, plan.scene.faces.get(2 * axis + 1)?.name);
        let message = format!(
            "with {cells} cells the {name} row of particles starts on nodes, at {x} m: the nodes beyond \
             have no mass, so linear functions lose velocity and force there"
        );
        let found = preflight.finding(Severity::Warning, &Path::top("refine"), &message);
        Some(found.with_help(
            "use another number of particles per cell, or `particles: {shift: [...]}`",
        ))
    });
    found.into_iter().collect()
}

/// Returns the position (m) of the last particles along `axis`, if they lie on inner nodes.
fn last_on_node(plan: &ConvergencePlan, axis: usize, level: &LevelPlan) -> Option<f64> {
    let scene = &plan.scene;
    if !scene.faces.get(2 * axis + 1)?.hold.is_free() {
        return None;
    }
    let per_axis = per_axis(level.ppc?, scene.dimension())? as f64;
    let length = scene.to[axis] - scene.from[axis];
    let count = libm::round(length * per_axis / level.h).max(1.0);
    let shift = plan.scatter.shift.get(axis).copied().unwrap_or(0.0);
    let x = scene.from[axis] + length * (count - 0.5) / count + shift * (length / count);
    let (origin, cells) = grid_axis(scene, axis, level.h);
    let place = (x - origin) * (1.0 / level.h);
    (place == libm::floor(place) && place < cells).then_some(x)
}

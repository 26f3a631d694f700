//! Boxes whose last particles start exactly on nodes, beside linear functions.
//!
//! A particle on a node belongs to the cell above, and the node at the far end of that cell has no
//! mass: it keeps neither velocity nor force.

use super::subject::Preflight;
use crate::mpm::BasisName;
use crate::suite::model::ConvergencePlan;
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::scene::grid_size::{grid_axis, per_axis};
use crate::suite::yaml::locate::Path;
use crate::suite::yaml::{Diagnostic, Severity};

/// Warns of a box that ends with a row of particles on nodes before the last ones of the grid.
pub(crate) fn check(preflight: &Preflight<'_>) -> Vec<Diagnostic> {
    let plan = preflight.plan;
    let is_linear = |method| matches!(method, Method::Mpm { basis: BasisName::Linear, .. });
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
            "with {cells} cells the {name} row of particles starts on nodes, at {x} m: the nodes ahead \
             have no mass, where linear functions lose the velocity and the force"
        );
        let found = preflight.finding(Severity::Warning, &Path::top("refine"), &message);
        Some(found.with_help(
            "take another number of particles in a cell, or `particles: {shift: [...]}`",
        ))
    });
    found.into_iter().collect()
}

/// The place (m) of the last particles along `axis`, as the solver has it, if they lie on nodes
/// with another node ahead.
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

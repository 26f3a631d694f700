//! Checks that every level fits into memory, that fixed faces have grid nodes, and that the body
//! and the sets contain particles.

use crate::suite::evaluator::{Evaluator, shown};
use crate::suite::grammar::{ConvergenceSpec, MethodSpec};
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{ConvergencePlan, Scene};
use crate::suite::scene::lattice::{any_particle, is_vacant};
use crate::suite::scene::{cell_size, grid_axis, per_axis};
use crate::suite::yaml::{Diagnostic, Path};

/// Maximum number of particles per level, and of nodes per level.
const MOST: f64 = 5e7;

/// Maximum distance (cells) between a fixed face of the body and the grid face next to it.
const ROUNDING: f64 = 1e-6;

pub(crate) struct LevelPaths {
    pub(crate) size: Path,
    pub(crate) dt: Path,
}

/// Refuses a level that is too large, has no nodes on a fixed face, or has no particle in a set or
/// a small body.
pub(crate) fn refuse_unfit_levels(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
    plan: &ConvergencePlan,
    places: &[LevelPaths],
) -> Result<(), Diagnostic> {
    reference(evaluator, plan)?;
    if spec.methods.iter().all(|method| matches!(method, MethodSpec::Fem { .. })) {
        return Ok(());
    }
    for (level, place) in plan.refine.levels.iter().zip(places) {
        fits(evaluator, &place.size, &plan.scene, *level)?;
    }
    Ok(())
}

fn fits(
    evaluator: &Evaluator<'_>,
    path: &Path,
    scene: &Scene,
    level: LevelPlan,
) -> Result<(), Diagnostic> {
    if let Some((what, amount)) = too_large(scene, level) {
        let cells = level.cells;
        let message = format!("with {cells} cells along the first axis, {amount:.1e} {what}");
        let diagnostic = evaluator.diagnostic(path, &message);
        return Err(diagnostic.with_label(&format!("expected at most {MOST:e} {what}")));
    }
    vacant(evaluator, path, scene, level)?;
    held_faces(evaluator, path, scene, level.cells)?;
    sets(evaluator, path, scene, level)
}

/// Refuses a reference run on an invalid fine grid, or with too many particles to store at all
/// instants.
pub(crate) fn fine_grid(
    evaluator: &Evaluator<'_>,
    path: &Path,
    scene: &Scene,
    level: LevelPlan,
    instants: u64,
) -> Result<(), Diagnostic> {
    fits(evaluator, path, scene, level)?;
    let particles = particles(scene, level);
    if particles * instants as f64 <= MOST {
        return Ok(());
    }
    let message = format!("{particles:.1e} particles at {instants} instants are too many to store");
    let label = format!("expected at most {MOST:e} particles times instants");
    Err(evaluator.diagnostic(path, &message).with_label(&label))
}

/// Refuses a round or polygonal body that is smaller than one particle volume.
fn vacant(
    evaluator: &Evaluator<'_>,
    path: &Path,
    scene: &Scene,
    level: LevelPlan,
) -> Result<(), Diagnostic> {
    let per_axis = level.ppc.and_then(|ppc| per_axis(ppc, scene.dimension()));
    if !per_axis.is_some_and(|n| is_vacant(scene, level.h, n)) {
        return Ok(());
    }
    let cells = level.cells;
    let message =
        format!("with {cells} cells along the first axis the body is smaller than a particle");
    let label = "expected cells small enough that the body contains a particle";
    Err(evaluator.diagnostic(path, &message).with_label(label))
}

/// If there are more nodes or particles than [`MOST`], returns the word `nodes` or `particles` and
/// their number.
pub(crate) fn too_large(scene: &Scene, level: LevelPlan) -> Option<(&'static str, f64)> {
    let amounts = [("nodes", nodes(scene, level.h)), ("particles", particles(scene, level))];
    amounts.into_iter().find(|(_, amount)| *amount > MOST || amount.is_nan())
}

pub(crate) fn nodes(scene: &Scene, h: f64) -> f64 {
    (0..scene.dimension()).map(|axis| grid_axis(scene, axis, h).1 + 1.0).product()
}

pub(crate) fn particles(scene: &Scene, level: LevelPlan) -> f64 {
    (0..scene.dimension()).map(|axis| along(scene, axis, level).max(1.0)).product()
}

/// Returns the number of particles along an axis, before rounding.
fn along(scene: &Scene, axis: usize, level: LevelPlan) -> f64 {
    let per_axis = level.ppc.and_then(|ppc| per_axis(ppc, scene.dimension())).unwrap_or(1) as f64;
    (scene.to[axis] - scene.from[axis]) * per_axis / level.h
}

/// Refuses a grid whose high face does not coincide with a fixed face of the body, because the
/// condition applies to the nodes on the grid face. Also refuses a periodic grid whose length is
/// not the stated period.
pub(crate) fn held_faces(
    evaluator: &Evaluator<'_>,
    path: &Path,
    scene: &Scene,
    cells: u64,
) -> Result<(), Diagnostic> {
    let h = cell_size(scene, cells);
    for face in scene.faces.iter().filter(|face| !face.hold.is_free() && face.high) {
        let (origin, along) = grid_axis(scene, face.axis, h);
        let end = origin + along * h;
        let body = match &scene.grid {
            Some((_, to)) if face.hold.is_periodic() => to[face.axis],
            _ => scene.to[face.axis],
        };
        if (end - body).abs() > ROUNDING * h {
            let (name, verb, h, end) = (face.name, face.hold.verb(), shown(h), shown(end));
            let message = format!(
                "with {cells} cells along the first axis the {name} face, which {verb}, is at {}, \
                 but the nearest nodes are at {end}",
                shown(body)
            );
            let label = format!("expected a cell size that divides the length, not {h} m");
            return Err(evaluator.diagnostic(path, &message).with_label(&label));
        }
    }
    Ok(())
}

fn sets(
    evaluator: &Evaluator<'_>,
    path: &Path,
    scene: &Scene,
    level: LevelPlan,
) -> Result<(), Diagnostic> {
    let cells = level.cells;
    let per_axis = level.ppc.and_then(|ppc| per_axis(ppc, scene.dimension()));
    for set in &scene.sets {
        // Particle centres are at from + length (i + 1/2)/count, see `Particles::fill`.
        let some = |axis: usize| {
            let (from, length) = (scene.from[axis], scene.to[axis] - scene.from[axis]);
            let count = libm::round(along(scene, axis, level)).max(1.0);
            let index = libm::ceil((set.from[axis] - from) / length * count - 0.5).max(0.0);
            from + length * (index.min(count - 1.0) + 0.5) / count <= set.to[axis]
        };
        let inside = |x0: &[f64], _| set.holds(x0);
        let is_held = match (&scene.outline, per_axis) {
            (Some(_), Some(n)) if scene.mapped.is_none() => {
                any_particle(scene, scene, level.h, n, inside)
            }
            _ => (0..scene.dimension()).all(some),
        };
        if !is_held {
            let name = &set.name;
            let message = format!(
                "with {cells} cells along the first axis the set `{name}` contains no particle"
            );
            return Err(evaluator.diagnostic(path, &message).with_label("expected more cells"));
        }
    }
    Ok(())
}

/// Refuses an FEM reference whose states at all instants need too much memory.
fn reference(evaluator: &Evaluator<'_>, plan: &ConvergencePlan) -> Result<(), Diagnostic> {
    let Some(fine) = &plan.reference else { return Ok(()) };
    let stored = fine.cells as f64 * plan.instants as f64;
    if stored <= MOST {
        return Ok(());
    }
    let message =
        format!("{} elements at {} instants are too many to store", fine.cells, plan.instants);
    let path = Path::top("reference").then("fem").then("cells");
    let label = format!("expected at most {MOST:e} elements times instants");
    Err(evaluator.diagnostic(&path, &message).with_label(&label))
}

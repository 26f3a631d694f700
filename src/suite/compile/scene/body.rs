//! Boxes, from words, and grids around bodies.

use super::lengths::{LONGEST, SHORTEST};
use crate::suite::compile::evaluator::Evaluator;
use crate::suite::compile::path::Path;
use crate::suite::compile::wording::shown;
use crate::suite::grammar::BoxSpec;
use crate::suite::model::{Scene, SceneFace};
use crate::suite::yaml::Diagnostic;

/// Lowest and highest corner of a box.
///
/// # Errors
/// A complaint about a box that is empty, too small or too large.
pub(crate) fn corners(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &BoxSpec,
    dimension: usize,
) -> Result<(Vec<f64>, Vec<f64>), Diagnostic> {
    let from = evaluator.point(&path.then("from"), &words.from, dimension)?;
    let to = evaluator.point(&path.then("to"), &words.to, dimension)?;
    for axis in 0..dimension {
        if !(from[axis] < to[axis]) {
            let (from, to) = (shown(from[axis]), shown(to[axis]));
            let message = format!("the box ends at {to} and starts at {from}");
            let diagnostic = evaluator.diagnostic(&path.then("to").then(axis), &message);
            return Err(diagnostic.with_label("expected a number above that of `from`"));
        }
        // Squares of lengths appear in second derivatives, cubes in volumes.
        let length = to[axis] - from[axis];
        if !(SHORTEST..=LONGEST).contains(&length) {
            let message = format!("the box is {} m long", shown(length));
            let diagnostic = evaluator.diagnostic(&path.then("to").then(axis), &message);
            let label = format!("expected a length from {SHORTEST:e} to {LONGEST:e}");
            return Err(diagnostic.with_label(&label));
        }
    }
    Ok((from, to))
}

/// The grid must reach over the body, and a face that is held must lie on the grid's own face: its
/// nodes are what is held, and a periodic axis ends there. Where the body may start deformed, the
/// period is that of its motion, which is checked against the grid's.
pub(crate) fn on_grid(
    evaluator: &Evaluator<'_>,
    path: &Path,
    scene: &Scene,
) -> Result<(), Diagnostic> {
    let Some((from, to)) = &scene.grid else { return Ok(()) };
    let deforms = scene.material.properties().depends_on_deformation_alone().is_ok();
    let given = |face: &&SceneFace| !(deforms && face.hold.is_periodic());
    for face in scene.faces.iter().filter(given) {
        let (body, grid, key) = if face.high {
            (scene.to[face.axis], to[face.axis], "to")
        } else {
            (scene.from[face.axis], from[face.axis], "from")
        };
        let outside = if face.high { grid < body } else { grid > body };
        let apart = !face.hold.is_free() && grid != body;
        if outside || apart {
            let name = face.name;
            let message = if outside {
                format!(
                    "the body's {name} face at {body} is outside the grid, which ends at {grid}"
                )
            } else {
                let verb = face.hold.verb();
                format!("the {name} face at {body} {verb}, but the grid ends at {grid}")
            };
            let at = path.then("grid").then(key).then(face.axis);
            let beyond = if face.high { "at least" } else { "at most" };
            let label = if apart { "exactly" } else { beyond };
            let label = format!("expected {label} {}", shown(body));
            return Err(evaluator.diagnostic(&at, &message).with_label(&label));
        }
    }
    Ok(())
}

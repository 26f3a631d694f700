//! The scene as a whole: its bodies, and how they lie to each other and on the grid.

use super::{bodies, body, outline, sets, together};
use crate::suite::evaluator::{Evaluator, shown};
use crate::suite::grammar::SceneSpec;
use crate::suite::model::{Scene, SceneFace};
use crate::suite::yaml::{Diagnostic, Path};

/// Checks the scene of a suite.
pub(crate) fn scene(evaluator: &Evaluator<'_>, words: &SceneSpec) -> Result<Scene, Diagnostic> {
    let path = Path::top("scene");
    let listed = bodies::listed(evaluator, &path, words)?;
    let contact = bodies::contact(evaluator, &path, words)?;
    let each = listed.iter().map(|listed| body::body(evaluator, listed, words));
    let each = each.collect::<Result<Vec<Scene>, _>>()?;
    let scene = together::together(evaluator, &path, each, words.bodies.is_some(), contact)?;
    sets::refuse_idle(evaluator, &path, &scene)?;
    on_grid(evaluator, &path, &scene)?;
    let with_rims = scene.each().iter().filter(|body| body.mapped.is_none());
    for outline in with_rims.filter_map(|body| body.outline.as_deref()) {
        outline::fits(evaluator, &path, outline, scene.grid.as_ref())?;
    }
    Ok(scene)
}

/// The grid must reach over the body, and a face that is held must lie on the grid's own face: its
/// nodes are what is held, and a periodic axis ends there. Where the body may start deformed, the
/// period is that of its motion, which is checked against the grid's.
fn on_grid(evaluator: &Evaluator<'_>, path: &Path, scene: &Scene) -> Result<(), Diagnostic> {
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

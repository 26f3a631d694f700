//! One body, and what acts on it, from words, and the grid around it.

use super::bodies::Listed;
use super::material::material;
use super::outline::BodyShape;
use super::outline::quadrilateral::faces_are_sides;
use super::scene_words::SceneWords;
use super::{boundary, boxes, initial, outline, plane, rest, sets};
use crate::suite::compile::evaluator::Evaluator;
use crate::suite::compile::load::listed;
use crate::suite::compile::path::Path;
use crate::suite::compile::wording::shown;
use crate::suite::model::{Scene, SceneFace};
use crate::suite::yaml::{Diagnostic, NumberText};

/// One body, and what acts on it.
pub(crate) fn body(
    evaluator: &Evaluator<'_>,
    own: &Listed<'_>,
    words: &SceneWords<'_>,
) -> Result<Scene, Diagnostic> {
    let path = Path::top("scene");
    let dimension = dimension(evaluator, &path, &words.dimension)?;
    let at = own.at.then("body");
    let (mut outline, mut mapped) = (None, None);
    let (from, to) = match outline::shape(evaluator, &at, own.body, dimension)? {
        BodyShape::Box(words) => boxes::corners(evaluator, &at.then("box"), words, dimension)?,
        BodyShape::Free(found) => {
            if words.bodies.is_none() {
                outline::rims_are_free(evaluator, &path, words, found.as_ref())?;
            }
            outline.insert(found).ends()
        }
        BodyShape::Mapped(found, panel) => {
            faces_are_sides(evaluator, &path, words, &panel)?;
            mapped = Some(panel);
            outline.insert(found).ends()
        }
    };
    let is_free = outline.is_some() && mapped.is_none();
    let grid = words
        .grid
        .as_ref()
        .map(|grid| boxes::corners(evaluator, &path.then("grid"), grid, dimension))
        .transpose()?;
    let sets = sets::declared(evaluator, &path, words, (&from, &to), outline.as_deref())?;
    let at = own.at.then("material");
    let (material, density) = material(evaluator, &at, own.material)?;
    let plane = plane::plane(evaluator, &path, words, dimension)?;
    plane::knows(evaluator, &at, &material, plane)?;
    let mut scene = Scene {
        from,
        to,
        grid,
        plane,
        initial_stress: initial::stress(evaluator, own, dimension, &material)?,
        initial_displacement: initial::displacement(evaluator, own, dimension, &material)?,
        material,
        density,
        faces: if is_free && words.bodies.is_none() {
            Vec::new()
        } else {
            boundary::faces(evaluator, &path, words, dimension)?
        },
        outline,
        mapped,
        sets,
        loads: Vec::new(),
        initial_velocity: initial::velocity(evaluator, own, dimension)?,
        bodies: Vec::new(),
        contact: None,
    };
    listed::refuse_incomplete(evaluator, &words.loads)?;
    plane::revolves(evaluator, &path, &scene)?;
    if scene.is_at_rest() {
        rest::settle(evaluator, &own.at, words, &mut scene.faces)?;
    }
    listed::add(evaluator, &words.loads, &mut scene)?;
    Ok(scene)
}

fn dimension(
    evaluator: &Evaluator<'_>,
    path: &Path,
    text: &NumberText,
) -> Result<usize, Diagnostic> {
    let path = path.then("dimension");
    let dimension = evaluator.number(&path, text)?;
    match [1.0, 2.0, 3.0].iter().position(|d| *d == dimension) {
        Some(index) => Ok(index + 1),
        None => Err(evaluator
            .diagnostic(&path, &format!("a scene of dimension {}", shown(dimension)))
            .with_label("expected 1, 2 or 3")),
    }
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

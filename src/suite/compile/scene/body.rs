//! One body, and what acts on it, from words, and the grid around it.

use super::bodies::Listed;
use super::material::material;
use super::outline::BodyShape;
use super::outline::quadrilateral::faces_are_sides;
use super::{boundary, boxes, initial, outline, plane, rest, revolution, sets};
use crate::suite::evaluator::{Evaluator, shown};
use crate::suite::grammar::SceneSpec;
use crate::suite::model::Scene;
use crate::suite::scene::load;
use crate::suite::yaml::{Diagnostic, NumberText, Path};

/// One body, and what acts on it.
pub(crate) fn body(
    evaluator: &Evaluator<'_>,
    own: &Listed<'_>,
    words: &SceneSpec,
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
    revolution::revolves(evaluator, &path, &scene)?;
    if scene.is_at_rest() {
        rest::settle(evaluator, &own.at, words, &mut scene.faces)?;
    }
    load::add(evaluator, &words.loads, &mut scene)?;
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

//! The body and what acts on it, from words.

use super::bodies::Listed;
use super::material::material;
use super::outline::BodyShape;
use super::outline::quadrilateral::faces_are_sides;
use super::{bodies, body, boundary, initial, outline, plane, rest, sets};
use crate::exact::{Outline, Region};
use crate::suite::compile::evaluator::Evaluator;
use crate::suite::compile::load::{LoadEntry, LoadSpec};
use crate::suite::compile::path::Path;
use crate::suite::compile::scene::scene_words::SceneWords;
use crate::suite::compile::wording::shown;
use crate::suite::grammar::{SceneSpec, SetSpec};
use crate::suite::model::load::{EffectName, ListedLoad};
use crate::suite::model::scene::FACES;
use crate::suite::model::{Scene, SceneFace};
use crate::suite::yaml::{Diagnostic, NumberText};

/// Checks the scene of a suite.
pub(crate) fn scene(
    evaluator: &Evaluator<'_>,
    words: &SceneWords<'_>,
) -> Result<Scene, Diagnostic> {
    let path = Path::top("scene");
    let listed = bodies::listed(evaluator, &path, words)?;
    let contact = bodies::contact(evaluator, &path, words)?;
    let each = listed.iter().map(|listed| body(evaluator, listed, words));
    let each = each.collect::<Result<Vec<Scene>, _>>()?;
    let scene = bodies::together(evaluator, &path, each, words.bodies.is_some(), contact)?;
    sets::refuse_idle(evaluator, &path, &scene)?;
    body::on_grid(evaluator, &path, &scene)?;
    let with_rims = scene.each().iter().filter(|body| body.mapped.is_none());
    for outline in with_rims.filter_map(|body| body.outline.as_deref()) {
        outline::fits(evaluator, &path, outline, scene.grid.as_ref())?;
    }
    Ok(scene)
}

/// One body, and what acts on it.
fn body(
    evaluator: &Evaluator<'_>,
    own: &Listed<'_>,
    words: &SceneWords<'_>,
) -> Result<Scene, Diagnostic> {
    let path = Path::top("scene");
    let dimension = dimension(evaluator, &path, &words.dimension)?;
    let at = own.at.then("body");
    let (mut outline, mut mapped) = (None, None);
    let (from, to) = match outline::shape(evaluator, &at, own.body, dimension)? {
        BodyShape::Box(words) => body::corners(evaluator, &at.then("box"), words, dimension)?,
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
        .map(|grid| body::corners(evaluator, &path.then("grid"), grid, dimension))
        .transpose()?;
    let sets = declared_sets(evaluator, &path, words, (&from, &to), outline.as_deref())?;
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
            faces(evaluator, &path, words, dimension)?
        },
        outline,
        mapped,
        sets,
        loads: Vec::new(),
        initial_velocity: initial::velocity(evaluator, own, dimension)?,
        bodies: Vec::new(),
        contact: None,
    };
    combined(evaluator, &words.loads)?;
    plane::revolves(evaluator, &path, &scene)?;
    if scene.is_at_rest() {
        rest::settle(evaluator, &own.at, words, &mut scene.faces)?;
    }
    add_loads(evaluator, &words.loads, &mut scene)?;
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

fn faces(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &SceneWords<'_>,
    dimension: usize,
) -> Result<Vec<SceneFace>, Diagnostic> {
    let holds = boundary::holds(evaluator, path, words, dimension)?;
    let build = |(i, hold)| SceneFace { name: FACES[i], axis: i / 2, high: i % 2 == 1, hold };
    Ok(holds.into_iter().enumerate().map(build).collect())
}

/// The sets of particles, on which nothing acts yet.
fn declared_sets(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &SceneSpec,
    corners: (&[f64], &[f64]),
    outline: Option<&dyn Outline>,
) -> Result<Vec<Region>, Diagnostic> {
    let declare = |(name, SetSpec::Box(words)): &(String, SetSpec)| {
        let at = path.then("sets").then(name.as_str());
        sets::refuse_face_name(evaluator, &at, name)?;
        let at = at.then("box");
        let (from, to) = body::corners(evaluator, &at, words, corners.0.len())?;
        let set = Region { name: name.clone(), from, to };
        sets::refuse_outside(evaluator, &at, &set, corners)?;
        if let Some(outline) = outline {
            sets::refuse_beside(evaluator, &at, &set, outline)?;
        }
        Ok(set)
    };
    words.sets.as_slice().iter().map(declare).collect()
}

/// Adds the loads to a scene that has none, in the order in which solvers apply them.
fn add_loads(
    evaluator: &Evaluator<'_>,
    words: &[LoadSpec],
    scene: &mut Scene,
) -> Result<(), Diagnostic> {
    for (i, load) in words.iter().enumerate() {
        let effect = load.effect();
        let entry = LoadEntry { evaluator, effect, path: load.path(i), scene };
        let load = load.words().compile(&entry)?;
        scene.loads.push(ListedLoad { effect, load });
    }
    scene.loads.sort_by_key(|load| (load.target(), load.effect));
    Ok(())
}

/// Refuses effects without those that they need.
fn combined(evaluator: &Evaluator<'_>, loads: &[LoadSpec]) -> Result<(), Diagnostic> {
    let listed: Vec<EffectName> = loads.iter().map(LoadSpec::effect).collect();
    EffectName::combine(&listed).map_err(|(effect, message)| {
        let at = listed.iter().position(|listed| *listed == effect).unwrap_or(0);
        evaluator.diagnostic_at_key(&loads[at].path(at), &message)
    })
}

//! Compiles one body: faces, plane state, axis of revolution, and bodies at rest.

use super::material;
use super::outline::{self, Shape};
use super::sets;
use crate::subject::PlaneState;
use crate::suite::evaluator::{SuitePath, shown};
use crate::suite::grammar::{OneBodySpec, SceneSpec};
use crate::suite::model::{Scene, SceneFace};
use crate::suite::scene::boundary::{BoundaryCondition, FaceAtRest, FaceEntry, FreeFace};
use crate::suite::scene::face::{FACES, face};
use crate::suite::scene::load;
use crate::suite::scene::load::LoadSpec;
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Compiles the body `own`, whose keys are in the map at `path`.
pub(crate) fn body(
    path: &SuitePath<'_>,
    own: &OneBodySpec,
    spec: &SceneSpec,
) -> Result<Scene, Diagnostic> {
    let top = path.evaluator.top("scene");
    let dimension = dimension(&top, &spec.dimension)?;
    let plane = plane(&top, spec, dimension)?;
    let at = path.then("body");
    let shape = outline::shape(&at, &own.body, spec, dimension, plane)?;
    let grid = spec.grid.as_ref();
    let at = top.then("grid");
    let grid = grid.map(|grid| outline::corners(&at, grid, dimension)).transpose()?;
    let sets = sets::declared(&top, spec, &shape)?;
    let at = path.then("material");
    let material = material::material(&at, &own.material)?;
    material::refuse_plane(&at, &material, plane)?;
    let at = at.then(own.material.name()).then("density");
    let density = material::density(&at, own.material.density(), &material, &shape, &spec.loads)?;
    let at = path.then("initial_stress");
    let initial_stress = material::stress(&at, own.initial_stress.as_ref(), dimension, &material)?;
    material::refuse_outside_yield_surface(&at, &initial_stress, &material, &shape)?;
    let initial_displacement = material::displacement(path, own, dimension, &material)?;
    let at = path.then("initial_velocity");
    let velocity = |texts: &Vec<NumberText>| at.fields(texts, dimension);
    let initial_velocity = own.initial_velocity.as_ref().map(velocity).transpose()?;
    let is_free = shape.outline.is_some() && shape.mapped.is_none();
    let has_faces = !is_free || spec.bodies.is_some();
    let faces = if has_faces { faces(&top, spec, dimension)? } else { Vec::new() };
    let Shape { from, to, outline, mapped, plane } = shape;
    let mut scene = Scene {
        from,
        to,
        grid,
        plane,
        outline,
        mapped,
        material,
        density,
        faces,
        sets,
        loads: Vec::new(),
        bodies: Vec::new(),
        contact: None,
        initial_stress,
        initial_displacement,
        initial_velocity: initial_velocity.unwrap_or_default(),
    };
    revolves(&top, &scene)?;
    if scene.is_at_rest() {
        settle(path, spec, &mut scene.faces)?;
    }
    load::add(path.evaluator, &spec.loads, &mut scene)?;
    Ok(scene)
}

fn dimension(path: &SuitePath<'_>, text: &NumberText) -> Result<usize, Diagnostic> {
    let path = path.then("dimension");
    let dimension = path.number(text)?;
    match [1.0, 2.0, 3.0].iter().position(|d| *d == dimension) {
        Some(index) => Ok(index + 1),
        None => path.expected("1, 2 or 3", &format!("a scene of dimension {}", shown(dimension))),
    }
}

fn faces(
    path: &SuitePath<'_>,
    spec: &SceneSpec,
    dimension: usize,
) -> Result<Vec<SceneFace>, Diagnostic> {
    let holds = holds(path, spec, dimension)?;
    let build = |(i, hold)| SceneFace { name: FACES[i], axis: i / 2, high: i % 2 == 1, hold };
    Ok(holds.into_iter().enumerate().map(build).collect())
}

fn holds(
    path: &SuitePath<'_>,
    spec: &SceneSpec,
    dimension: usize,
) -> Result<Vec<Arc<dyn BoundaryCondition>>, Diagnostic> {
    let path = path.then("boundary");
    let free: Arc<dyn BoundaryCondition> = Arc::new(FreeFace);
    let mut holds = vec![free; 2 * dimension];
    for (name, spec) in spec.boundary.as_slice() {
        let at = path.then(name.as_str());
        let face = face(&at, name, dimension, true)?;
        let (condition, spec) = spec.named();
        let entry = FaceEntry { path: at.then(condition), dimension };
        holds[face] = spec.compile(&entry)?;
    }
    both_ends(&path, &holds)?;
    Ok(holds)
}

fn both_ends(path: &SuitePath<'_>, holds: &[Arc<dyn BoundaryCondition>]) -> Result<(), Diagnostic> {
    for (i, hold) in holds.iter().enumerate() {
        let (name, other) = (FACES[i], FACES[i ^ 1]);
        if hold.is_periodic() && !holds[i ^ 1].is_periodic() {
            let verb = holds[i ^ 1].kind().verb;
            let message = format!("the {name} face is periodic, but the {other} face {verb}");
            return path.then(name).expected(&format!("`{other}: periodic` as well"), &message);
        }
    }
    Ok(())
}

/// Sets free faces of a rigid body to [`FaceAtRest`]. Refuses keys that hold, load or move it.
fn settle(
    path: &SuitePath<'_>,
    spec: &SceneSpec,
    faces: &mut [SceneFace],
) -> Result<(), Diagnostic> {
    let idle = |at: &SuitePath<'_>, message: &str| {
        let diagnostic = at.diagnostic_at_key(message);
        Err(diagnostic
            .with_help("a `rigid` body does not move: remove this, or choose another material"))
    };
    if spec.bodies.is_some() {
        return idle(&path.then("material"), "a `rigid` body cannot be in a list of bodies");
    }
    for face in faces {
        if face.hold.is_free() {
            face.hold = Arc::new(FaceAtRest);
        } else if !face.hold.is_periodic() {
            let (name, verb) = (face.name, face.hold.kind().verb);
            let message = format!("the {name} face {verb}, but a `rigid` body does not move");
            return idle(&path.then("boundary").then(face.name), &message);
        }
    }
    for (key, stated) in [
        ("initial_stress", spec.initial_stress.is_some()),
        ("initial_displacement", spec.initial_displacement.is_some()),
        ("initial_velocity", spec.initial_velocity.is_some()),
        ("sets", !spec.sets.as_slice().is_empty()),
    ] {
        if stated {
            return idle(&path.then(key), &format!("`{key}` is not supported for a `rigid` body"));
        }
    }
    let moves = |load: &LoadSpec| !load.keys().acts_at_rest();
    match spec.loads.iter().position(moves) {
        Some(i) => {
            idle(&path.then("loads").then(i), "this load is not supported for a `rigid` body")
        }
        None => Ok(()),
    }
}

fn plane(
    path: &SuitePath<'_>,
    spec: &SceneSpec,
    dimension: usize,
) -> Result<PlaneState, Diagnostic> {
    let Some(plane) = spec.plane else { return Ok(PlaneState::Strain) };
    if dimension != 2 {
        let message = format!("`plane` needs a 2-D scene, but this scene is {dimension}-D");
        return path.then("plane").expected("in a scene of `dimension: 2`", &message);
    }
    if plane == PlaneState::Axisymmetric && spec.bodies.is_some() {
        let message = "`plane: axisymmetric` is not supported for several bodies";
        return Err(path.then("bodies").diagnostic_at_key(message));
    }
    for (i, load) in spec.loads.iter().enumerate() {
        if let Some(reason) = load.keys().against_plane(plane) {
            let (plane, name) = (plane.name(), load.effect().name());
            let message = format!("`plane: {plane}` is not supported with `{name}`: {reason}");
            return Err(load.path(path.evaluator, i).diagnostic_at_key(&message));
        }
    }
    Ok(plane)
}

fn revolves(path: &SuitePath<'_>, scene: &Scene) -> Result<(), Diagnostic> {
    if scene.plane != PlaneState::Axisymmetric {
        return Ok(());
    }
    let help = "the first coordinate of the meridian plane is the radius";
    let body = path.then("body");
    if scene.mapped.is_some() {
        let message = "`plane: axisymmetric` is not supported for a quadrilateral";
        return Err(body.diagnostic_at_key(message));
    }
    if !scene.initial_stress.is_none() {
        let message = "`plane: axisymmetric` is not supported with an initial stress, which has no \
                       key for the hoop stress";
        return Err(path.then("initial_stress").diagnostic_at_key(message));
    }
    if scene.from[0] < 0.0 {
        let message = format!("the body starts at the negative radius {}", shown(scene.from[0]));
        return body.refuse_key(&message, help);
    }
    if scene.outline.is_some() && scene.from[0] == 0.0 {
        let message = "the free rim of the body touches the axis, where a roller is needed";
        return body.refuse_key(message, "move it to larger radii, or use a `box`");
    }
    let mut faces = scene.faces.iter().filter(|face| face.axis == 0);
    if let Some(face) = faces.clone().find(|face| face.hold.is_periodic()) {
        let message =
            format!("the face `{}` cannot be periodic, because a radius has no period", face.name);
        let at = path.then("boundary").then(face.name);
        return at.refuse_key(&message, help);
    }
    let is_axis = |face: &SceneFace| !face.high && scene.from[0] == 0.0;
    if let Some(face) = faces.find(|face| is_axis(face) && face.hold.kind().name != "roller") {
        let message =
            format!("the {} face lies on the axis, but {}", face.name, face.hold.kind().verb);
        let diagnostic = path.then("boundary").diagnostic_at_key(&message);
        return Err(diagnostic.with_help("state `left: roller`: nothing crosses the axis"));
    }
    Ok(())
}

//! Loads on the faces of a box: tractions and pressures, from words and to the solver.

use crate::{
    exact::formula::Formula,
    mpm::{Effect, Particles, Placement, Pressure, PressureField, Traction},
    study::build::conditions::{of_place_and_time, side, with_time},
    suite::{
        compile::{
            evaluator::Evaluator,
            path::Path,
            scene::{boundary::face, sets},
        },
        grammar::LoadSpec,
        model::{Scene, SceneFace},
        yaml::Diagnostic,
    },
};

/// Gives a face of the scene the load at `path`, if that is one on a surface: formulas of `variables`.
///
/// # Errors
/// A complaint about a face that is not there, or not free, or has a load already.
pub(crate) fn add(
    evaluator: &Evaluator<'_>,
    path: &Path,
    load: &LoadSpec,
    variables: &[&str],
    scene: &mut Scene,
) -> Result<(), Diagnostic> {
    match load {
        LoadSpec::Traction { on, value, at } => {
            let path = path.then("traction");
            let number = free(evaluator, &path.then("on"), "traction", on, scene)?;
            let value =
                evaluator.vector(&path.then("value"), value, scene.dimension(), variables)?;
            let face = &mut scene.faces[number];
            (face.traction, face.placement) = (Some(value), at.unwrap_or_default());
        }
        LoadSpec::Pressure { on, value, at } => {
            let path = path.then("pressure");
            let number = free(evaluator, &path.then("on"), "pressure", on, scene)?;
            let value = evaluator.formula(&path.then("value"), value, variables)?;
            let face = &mut scene.faces[number];
            (face.pressure, face.placement) = (Some(value), at.unwrap_or_default());
        }
        _ => {}
    }
    Ok(())
}

/// Number of the face called `name`, if it can carry a load.
fn free(
    evaluator: &Evaluator<'_>,
    path: &Path,
    load: &str,
    name: &str,
    scene: &Scene,
) -> Result<usize, Diagnostic> {
    sets::refuse_surface_load(evaluator, path, load, name, &scene.sets)?;
    let number = face(evaluator, path, name, scene.dimension(), false)?;
    let face = &scene.faces[number];
    let has = match (&face.traction, &face.pressure) {
        _ if !face.hold.is_free() => face.hold.verb(),
        (Some(_), _) => "has a traction already",
        (None, Some(_)) => "has a pressure already",
        (None, None) => return Ok(number),
    };
    Err(evaluator.diagnostic(path, &format!("the face `{name}` {has}")))
}

/// What acts on the faces of the body.
pub(crate) fn on_faces<const D: usize>(
    scene: &Scene,
    particles: &Particles<D>,
) -> Vec<Box<dyn Effect<D>>> {
    let mut effects: Vec<Box<dyn Effect<D>>> = Vec::new();
    for face in &scene.faces {
        let (axis, side, placement) = (face.axis, side(face), face.placement);
        if let Some(value) = &face.traction {
            let value = of_place_and_time(value);
            effects.push(Box::new(Traction::at(particles, axis, side, placement, value)));
        }
        if let Some(value) = &face.pressure {
            let value = scalar(value);
            effects.push(Box::new(Pressure::at(particles, axis, side, placement, value)));
        }
    }
    effects
}

/// A formula of the coordinates and t.
fn scalar<const D: usize>(formula: &Formula) -> PressureField<D> {
    let formula = formula.clone();
    Box::new(move |x, t| formula.eval(&with_time(x, t)[..=D]))
}

/// The load on a face, for reports.
pub(crate) fn described(face: &SceneFace) -> Option<String> {
    let load = match (&face.traction, &face.pressure) {
        (Some(value), _) => {
            let sources: Vec<&str> = value.iter().map(Formula::source).collect();
            format!("traction {} Pa", sources.join(", "))
        }
        (None, Some(value)) => format!("pressure {} Pa, which follows the face", value.source()),
        (None, None) => return None,
    };
    Some(match face.placement {
        Placement::Particles => load,
        Placement::Surface => load + ", put at the surface",
    })
}

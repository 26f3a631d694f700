//! Bodies of revolution.

use crate::subject::PlaneState;
use crate::suite::evaluator::{Evaluator, shown};
use crate::suite::model::{Scene, SceneFace};
use crate::suite::yaml::{Diagnostic, Path};

/// Refuses a body that cannot be turned about the axis, where the first coordinate is zero.
pub(crate) fn revolves(
    evaluator: &Evaluator<'_>,
    path: &Path,
    scene: &Scene,
) -> Result<(), Diagnostic> {
    if scene.plane != PlaneState::Axisymmetric {
        return Ok(());
    }
    let help = "the first coordinate of the meridian plane is the radius";
    let body = path.then("body");
    if scene.mapped.is_some() {
        let message = "`plane: axisymmetric`, and quadrilaterals are not known to be of revolution";
        return Err(evaluator.diagnostic_at_key(&body, message));
    }
    if !scene.initial_stress.is_none() {
        let message = "`plane: axisymmetric`, and an initial stress has no word for its hoops";
        return Err(evaluator.diagnostic_at_key(&path.then("initial_stress"), message));
    }
    if scene.from[0] < 0.0 {
        let message = format!("the body begins at a radius of {}", shown(scene.from[0]));
        return Err(evaluator.diagnostic_at_key(&body, &message).with_help(help));
    }
    if scene.outline.is_some() && scene.from[0] == 0.0 {
        let message = "the rim of the body is free, and reaches the axis, which nothing leaves";
        let diagnostic = evaluator.diagnostic_at_key(&body, message);
        return Err(diagnostic.with_help("move it to larger radii, or take a `box`"));
    }
    let mut faces = scene.faces.iter().filter(|face| face.axis == 0);
    if let Some(face) = faces.clone().find(|face| face.hold.is_periodic()) {
        let message = format!("a radius has no period, and the face `{}` is periodic", face.name);
        let at = path.then("boundary").then(face.name);
        return Err(evaluator.diagnostic_at_key(&at, &message).with_help(help));
    }
    let is_axis = |face: &SceneFace| !face.high && scene.from[0] == 0.0;
    if let Some(face) = faces.find(|face| is_axis(face) && face.hold.name() != "roller") {
        let message = format!("the {} face is the axis, and {}", face.name, face.hold.verb());
        let diagnostic = evaluator.diagnostic_at_key(&path.then("boundary"), &message);
        return Err(diagnostic.with_help("state `left: roller`: nothing leaves the axis"));
    }
    Ok(())
}

use super::polygon::corners;
use crate::exact::{Outline, Polygon};
use crate::mpm::{Quadrilateral, Vector};
use crate::suite::evaluator::Evaluator;
use crate::suite::grammar::{QuadrilateralSpec, SceneSpec};
use crate::suite::scene::face::FACES;
use crate::suite::yaml::{Diagnostic, Path};
use std::sync::Arc;

/// Compiles the quadrilateral in `spec` at `path`, and its outline.
pub(super) fn quadrilateral(
    evaluator: &Evaluator<'_>,
    path: &Path,
    spec: &QuadrilateralSpec,
) -> Result<(Arc<dyn Outline>, Quadrilateral), Diagnostic> {
    let path = path.then("corners");
    if spec.corners.len() != 4 {
        let message = format!("a quadrilateral of {} corners", spec.corners.len());
        return Err(evaluator.diagnostic(&path, &message).with_label("expected four"));
    }
    let corners = corners(evaluator, &path, &spec.corners)?;
    let to_the_right = |i: usize| {
        let message = format!("at corner {} the sides do not turn to the left", i + 1);
        let diagnostic = evaluator.diagnostic(&path.then(i), &message);
        diagnostic.with_label("expected the corners of a convex panel, counter-clockwise")
    };
    let places = std::array::from_fn(|i| Vector::from(corners[i]));
    let panel = Quadrilateral::new(places).map_err(to_the_right)?;
    let corners = panel.corners().map(|c| [c[0], c[1]]);
    let outline = Polygon::new("quadrilateral", &corners);
    Ok((Arc::new(outline.map_err(|(_, side)| to_the_right(side))?), panel))
}

/// Refuses conditions and loads on a face of the bounding box that contains no side of the
/// quadrilateral.
pub(crate) fn faces_are_sides(
    evaluator: &Evaluator<'_>,
    path: &Path,
    spec: &SceneSpec,
    panel: &Quadrilateral,
) -> Result<(), Diagnostic> {
    let is_side = |name: &str| {
        let number = FACES.iter().position(|face| *face == name);
        // Faces that do not exist in two dimensions are reported by a later check.
        number.is_none_or(|i| i >= 4 || panel.has_side_at(i / 2, i % 2 == 1))
    };
    let no_side = |at: &Path, face: &str, is_key: bool| {
        let message = format!("no side of the quadrilateral lies on its `{face}` face");
        let diagnostic = if is_key {
            evaluator.diagnostic_at_key(at, &message)
        } else {
            evaluator.diagnostic(at, &message)
        };
        diagnostic.with_help("a face can be held or loaded where a whole side lies on it")
    };
    for (face, hold) in spec.boundary.as_slice() {
        let at = path.then("boundary").then(face.as_str());
        if hold.named().1.is_periodic() {
            return Err(
                evaluator.diagnostic_at_key(&at, "a quadrilateral cannot have periodic faces")
            );
        }
        if !is_side(face) {
            return Err(no_side(&at, face, true));
        }
    }
    for (i, load) in spec.loads.iter().enumerate() {
        let Some(on) = load.keys().face() else { continue };
        if !is_side(on) {
            return Err(no_side(&load.path(i).then("on"), on, false));
        }
    }
    Ok(())
}

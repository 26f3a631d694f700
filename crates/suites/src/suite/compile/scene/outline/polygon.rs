//! Compiles polygons and quadrilaterals.

use crate::exact::{Outline, Polygon};
use crate::mpm::{Quadrilateral, Vector};
use crate::suite::evaluator::{SuitePath, shown};
use crate::suite::grammar::{QuadrilateralSpec, SceneSpec};
use crate::suite::scene::boundary::BoundarySpec;
use crate::suite::scene::face::FACES;
use crate::suite::scene::{LONGEST, SHORTEST};
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Maximum number of corners, because every side is intersected with every lattice cell.
const MOST: usize = 100;

pub(super) fn polygon(
    path: &SuitePath<'_>,
    texts: &[Vec<NumberText>],
) -> Result<Arc<dyn Outline>, Diagnostic> {
    if texts.len() < 3 || texts.len() > MOST {
        let message = format!("a polygon of {} corners", texts.len());
        return path.expected(&format!("3 to {MOST}"), &message);
    }
    let corners = corners(path, texts)?;
    let polygon = Polygon::new("polygon", &corners).map_err(|(first, second)| {
        let name = |side: usize| format!("{} to {}", side + 1, (side + 1) % corners.len() + 1);
        let (one, other) = (name(first), name(second));
        let message = format!("the sides from corner {one} and from {other} cross or touch");
        let diagnostic = path.then(second).diagnostic(&message);
        diagnostic
            .with_label("expected a side that is apart from all others")
            .with_help("list the corners in their order around the body, either way round")
    })?;
    Ok(Arc::new(polygon))
}

fn corners(path: &SuitePath<'_>, texts: &[Vec<NumberText>]) -> Result<Vec<[f64; 2]>, Diagnostic> {
    let mut corners: Vec<[f64; 2]> = Vec::with_capacity(texts.len());
    for (i, texts) in texts.iter().enumerate() {
        let at = path.then(i);
        let place = at.point(texts, 2)?;
        let corner = [place[0], place[1]];
        for (k, other) in corners.iter().enumerate() {
            let length = libm::hypot(corner[0] - other[0], corner[1] - other[1]);
            let (first, second) = (k + 1, i + 1);
            let message = format!("corners {first} and {second} are {} m apart", shown(length));
            in_range(&at, length, "distance", &message)?;
        }
        corners.push(corner);
    }
    Ok(corners)
}

pub(super) fn quadrilateral(
    path: &SuitePath<'_>,
    spec: &QuadrilateralSpec,
) -> Result<(Arc<dyn Outline>, Quadrilateral), Diagnostic> {
    let path = path.then("corners");
    if spec.corners.len() != 4 {
        let message = format!("a quadrilateral of {} corners", spec.corners.len());
        return path.expected("four", &message);
    }
    let corners = corners(&path, &spec.corners)?;
    let to_the_right = |i: usize| {
        let message = format!("at corner {} the sides do not turn to the left", i + 1);
        let diagnostic = path.then(i).diagnostic(&message);
        diagnostic.with_label("expected the corners of a convex panel, counter-clockwise")
    };
    let places = std::array::from_fn(|i| Vector::from(corners[i]));
    let panel = Quadrilateral::new(places).map_err(to_the_right)?;
    let corners = panel.corners().map(|c| [c[0], c[1]]);
    let outline = Polygon::new("quadrilateral", &corners);
    Ok((Arc::new(outline.map_err(|(_, side)| to_the_right(side))?), panel))
}

pub(super) fn faces_are_sides(
    path: &SuitePath<'_>,
    spec: &SceneSpec,
    panel: &Quadrilateral,
) -> Result<(), Diagnostic> {
    let is_side = |name: &str| {
        let number = FACES.iter().position(|face| *face == name);
        // Faces that do not exist in two dimensions are reported by a later check.
        number.is_none_or(|i| i >= 4 || panel.has_side_at(i / 2, i % 2 == 1))
    };
    let no_side = |at: &SuitePath<'_>, face: &str, is_key: bool| {
        let message = format!("no side of the quadrilateral lies on its `{face}` face");
        let diagnostic =
            if is_key { at.diagnostic_at_key(&message) } else { at.diagnostic(&message) };
        diagnostic.with_help("a face can be held or loaded where a whole side lies on it")
    };
    for (face, hold) in spec.boundary.as_slice() {
        let at = path.then("boundary").then(face.as_str());
        if matches!(hold, BoundarySpec::Periodic) {
            return Err(at.diagnostic_at_key("a quadrilateral cannot have periodic faces"));
        }
        if !is_side(face) {
            return Err(no_side(&at, face, true));
        }
    }
    for (i, load) in spec.loads.iter().enumerate() {
        let Some(on) = load.keys().face() else { continue };
        if !is_side(on) {
            return Err(no_side(&load.path(path.evaluator, i).then("on"), on, false));
        }
    }
    Ok(())
}

/// Refuses a length (m) whose powers underflow or overflow.
pub(super) fn in_range(
    path: &SuitePath<'_>,
    length: f64,
    what: &str,
    message: &str,
) -> Result<(), Diagnostic> {
    if (SHORTEST..=LONGEST).contains(&length) {
        return Ok(());
    }
    path.expected(&format!("a {what} from {SHORTEST:e} to {LONGEST:e}"), message)
}

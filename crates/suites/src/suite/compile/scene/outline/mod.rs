//! Compiles the shape of a body: a box or another shape.

mod polygon;

use crate::exact::{Outline, Round};
use crate::mpm::Quadrilateral;
use crate::subject::PlaneState;
use crate::suite::evaluator::{SuitePath, shown};
use crate::suite::grammar::{AnnulusSpec, BodySpec, BoxSpec, RoundSpec, SceneSpec};
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

pub(crate) struct Shape {
    /// Lowest corner of the bounding box (m).
    pub(crate) from: Vec<f64>,
    /// Highest corner of the bounding box (m).
    pub(crate) to: Vec<f64>,
    pub(crate) outline: Option<Arc<dyn Outline>>,
    pub(crate) mapped: Option<Quadrilateral>,
    pub(crate) plane: PlaneState,
}

/// Compiles the shape at `path`. Refuses conditions and loads on faces that it does not have.
pub(crate) fn shape(
    path: &SuitePath<'_>,
    spec: &BodySpec,
    scene: &SceneSpec,
    dimension: usize,
    plane: PlaneState,
) -> Result<Shape, Diagnostic> {
    let at_scene = path.evaluator.top("scene");
    let of_kind = |kind: &str, flat: usize| {
        let at = path.then(kind);
        if dimension == flat {
            return Ok(at);
        }
        let message = format!("the scene is {dimension}-D, but `{kind}` is a body in {flat}-D");
        let flat = "`box`, `annulus`, `disk`, `polygon` or `quadrilateral`";
        let help = format!(
            "in {dimension}-D a body is a {}",
            ["`box`", flat, "`box` or `ball`"][dimension - 1]
        );
        at.refuse_key(&message, &help)
    };
    let outline = match spec {
        BodySpec::Box(spec) => {
            let (from, to) = corners(&path.then("box"), spec, dimension)?;
            return Ok(Shape { from, to, outline: None, mapped: None, plane });
        }
        BodySpec::Quadrilateral(spec) => {
            let at = of_kind("quadrilateral", 2)?;
            let (outline, panel) = polygon::quadrilateral(&at, spec)?;
            polygon::faces_are_sides(&at_scene, scene, &panel)?;
            let (from, to) = outline.ends();
            return Ok(Shape { from, to, outline: Some(outline), mapped: Some(panel), plane });
        }
        BodySpec::Annulus(spec) => annulus(&of_kind("annulus", 2)?, spec)?,
        BodySpec::Disk(spec) => filled(&of_kind("disk", 2)?, spec, 2)?,
        BodySpec::Ball(spec) => filled(&of_kind("ball", 3)?, spec, 3)?,
        BodySpec::Polygon(corners) => polygon::polygon(&of_kind("polygon", 2)?, corners)?,
    };
    if scene.bodies.is_none() {
        rims_are_free(&at_scene, scene, outline.as_ref())?;
    }
    let (from, to) = outline.ends();
    Ok(Shape { from, to, outline: Some(outline), mapped: None, plane })
}

fn rims_are_free(
    path: &SuitePath<'_>,
    spec: &SceneSpec,
    outline: &dyn Outline,
) -> Result<(), Diagnostic> {
    let kind = outline.kind();
    let held = spec.boundary.as_slice().first().map(|(face, _)| {
        let message =
            format!("`{face}` cannot be held: a body of kind `{kind}` has free rims only");
        path.then("boundary").then(face.as_str()).diagnostic_at_key(&message)
    });
    let loaded = spec.loads.iter().enumerate().find_map(|(i, load)| {
        let on = load.keys().face()?;
        if load.keys().acts_on_rims() && !outline.circles().is_empty() {
            return None;
        }
        let message =
            format!("`{on}` cannot be loaded: a body of kind `{kind}` has free rims only");
        Some(load.path(path.evaluator, i).then("on").diagnostic(&message))
    });
    match held.or(loaded) {
        Some(diagnostic) => Err(diagnostic.with_help(
            "only the faces of a `box` can be held or loaded, and a `pressure` acts on the `inner` \
             or `outer` rim of an annulus or a disk",
        )),
        None => Ok(()),
    }
}

pub(crate) fn fits(
    path: &SuitePath<'_>,
    outline: &dyn Outline,
    grid: Option<&(Vec<f64>, Vec<f64>)>,
) -> Result<(), Diagnostic> {
    let Some(grid) = grid else { return Ok(()) };
    let body = outline.ends();
    for axis in 0..body.0.len() {
        for (key, word, inside, body, end) in [
            ("from", "most", grid.0[axis] > body.0[axis], body.0[axis], grid.0[axis]),
            ("to", "least", grid.1[axis] < body.1[axis], body.1[axis], grid.1[axis]),
        ] {
            if inside {
                let (kind, reach, end) = (outline.kind(), shown(body), shown(end));
                let message = format!("the {kind} extends to {reach}, but the grid ends at {end}");
                let diagnostic = path.then("grid").then(key).then(axis).diagnostic(&message);
                return Err(diagnostic.with_label(&format!("expected at {word} {reach}")));
            }
        }
    }
    Ok(())
}

pub(crate) fn corners(
    path: &SuitePath<'_>,
    spec: &BoxSpec,
    dimension: usize,
) -> Result<(Vec<f64>, Vec<f64>), Diagnostic> {
    let from = path.then("from").point(&spec.from, dimension)?;
    let to = path.then("to").point(&spec.to, dimension)?;
    for axis in 0..dimension {
        if !(from[axis] < to[axis]) {
            let (from, to) = (shown(from[axis]), shown(to[axis]));
            let message = format!("the box ends at {to} and starts at {from}");
            return path.then("to").then(axis).expected("a number above that of `from`", &message);
        }
        // Second derivatives contain the square of the length, and volumes its cube.
        let length = to[axis] - from[axis];
        let message = format!("the box is {} m long", shown(length));
        polygon::in_range(&path.then("to").then(axis), length, "length", &message)?;
    }
    Ok((from, to))
}

fn annulus(
    path: &SuitePath<'_>,
    AnnulusSpec { centre, inner, outer }: &AnnulusSpec,
) -> Result<Arc<dyn Outline>, Diagnostic> {
    let centre = path.then("centre").point(centre, 2)?;
    let inner = radius(&path.then("inner"), inner)?;
    let outer = radius(&path.then("outer"), outer)?;
    if inner < outer {
        return Ok(Arc::new(Round { centre, inner, outer }));
    }
    let message = format!("the outer radius is {}, the inner {}", shown(outer), shown(inner));
    path.then("outer").expected("a number above `inner`", &message)
}

fn filled(
    path: &SuitePath<'_>,
    spec: &RoundSpec,
    dimension: usize,
) -> Result<Arc<dyn Outline>, Diagnostic> {
    let centre = path.then("centre").point(&spec.centre, dimension)?;
    let outer = radius(&path.then("radius"), &spec.radius)?;
    Ok(Arc::new(Round { centre, inner: 0.0, outer }))
}

fn radius(path: &SuitePath<'_>, text: &NumberText) -> Result<f64, Diagnostic> {
    let radius = path.positive(text, "the radius")?;
    let message = format!("the radius is {} m", shown(radius));
    polygon::in_range(path, radius, "length", &message).map(|()| radius)
}

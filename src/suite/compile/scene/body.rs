//! Boxes and bodies that are not boxes, from words.

use super::lengths::{LONGEST, SHORTEST};
use super::quadrilateral::quadrilateral;
use crate::exact::Round;
use crate::mpm::Quadrilateral;
use crate::suite::compile::evaluator::Evaluator;
use crate::suite::compile::path::Path;
use crate::suite::compile::scene::scene_words::SceneWords;
use crate::suite::compile::wording::shown;
use crate::suite::grammar::{AnnulusSpec, BodySpec, BoxSpec, RoundSpec};
use crate::suite::model::{Scene, SceneFace};
use crate::suite::yaml::{Diagnostic, NumberText};

/// Shape of a body.
pub(crate) enum BodyShape<'a> {
    /// A box, whose words are read by [`corners`].
    Box(&'a BoxSpec),
    /// A round body.
    Round(Round),
    /// A panel.
    Quadrilateral(Quadrilateral),
}

/// The shape that `words` describe.
///
/// # Errors
/// A complaint about a body that makes no sense in `dimension` dimensions.
pub(crate) fn shape<'a>(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &'a BodySpec,
    dimension: usize,
) -> Result<BodyShape<'a>, Diagnostic> {
    let of_kind = |kind: &str, flat: usize| {
        let at = path.then(kind);
        if dimension == flat {
            return Ok(at);
        }
        let message = format!("the scene is {dimension}-D, and `{kind}` a body in {flat}-D");
        let others = ["`box`", "`box`, `annulus`, `disk` or `quadrilateral`", "`box` or `ball`"];
        let help = format!("in {dimension}-D a body is a {}", others[dimension - 1]);
        Err(evaluator.diagnostic_at_key(&at, &message).with_help(&help))
    };
    let (at, centre, radii) = match words {
        BodySpec::Box(words) => return Ok(BodyShape::Box(words)),
        BodySpec::Quadrilateral(words) => {
            let at = of_kind("quadrilateral", 2)?;
            return quadrilateral(evaluator, &at, words, dimension).map(BodyShape::Quadrilateral);
        }
        BodySpec::Annulus(AnnulusSpec { centre, inner, outer }) => {
            let radii = [Some(("inner", inner)), Some(("outer", outer))];
            (of_kind("annulus", 2)?, centre, radii)
        }
        BodySpec::Disk(RoundSpec { centre, radius }) => {
            (of_kind("disk", 2)?, centre, [None, Some(("radius", radius))])
        }
        BodySpec::Ball(RoundSpec { centre, radius }) => {
            (of_kind("ball", 3)?, centre, [None, Some(("radius", radius))])
        }
    };
    round(evaluator, &at, centre, radii, dimension).map(BodyShape::Round)
}

/// The round body at `path`, with an inner radius if it has one.
fn round(
    evaluator: &Evaluator<'_>,
    path: &Path,
    centre: &[NumberText],
    radii: [Option<(&str, &NumberText)>; 2],
    dimension: usize,
) -> Result<Round, Diagnostic> {
    let centre = evaluator.point(&path.then("centre"), centre, dimension)?;
    let mut lengths = [0.0; 2];
    for (length, given) in lengths.iter_mut().zip(radii) {
        if let Some((key, text)) = given {
            *length = radius(evaluator, &path.then(key), text)?;
        }
    }
    let [inner, outer] = lengths;
    if inner < outer {
        return Ok(Round { centre, inner, outer });
    }
    let message = format!("the outer radius is {}, the inner {}", shown(outer), shown(inner));
    let diagnostic = evaluator.diagnostic(&path.then("outer"), &message);
    Err(diagnostic.with_label("expected a number above `inner`"))
}

/// Lowest and highest corner of a box.
///
/// # Errors
/// A complaint about a box that is empty, too small or too large.
pub(crate) fn corners(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &BoxSpec,
    dimension: usize,
) -> Result<(Vec<f64>, Vec<f64>), Diagnostic> {
    let from = evaluator.point(&path.then("from"), &words.from, dimension)?;
    let to = evaluator.point(&path.then("to"), &words.to, dimension)?;
    for axis in 0..dimension {
        if !(from[axis] < to[axis]) {
            let (from, to) = (shown(from[axis]), shown(to[axis]));
            let message = format!("the box ends at {to} and starts at {from}");
            let diagnostic = evaluator.diagnostic(&path.then("to").then(axis), &message);
            return Err(diagnostic.with_label("expected a number above that of `from`"));
        }
        // Squares of lengths appear in second derivatives, cubes in volumes.
        let length = to[axis] - from[axis];
        if !(SHORTEST..=LONGEST).contains(&length) {
            let message = format!("the box is {} m long", shown(length));
            let diagnostic = evaluator.diagnostic(&path.then("to").then(axis), &message);
            let label = format!("expected a length from {SHORTEST:e} to {LONGEST:e}");
            return Err(diagnostic.with_label(&label));
        }
    }
    Ok((from, to))
}

fn radius(evaluator: &Evaluator<'_>, path: &Path, text: &NumberText) -> Result<f64, Diagnostic> {
    let radius = evaluator.positive(path, text, "the radius")?;
    if (SHORTEST..=LONGEST).contains(&radius) {
        return Ok(radius);
    }
    let message = format!("the radius is {} m", shown(radius));
    let label = format!("expected a length from {SHORTEST:e} to {LONGEST:e}");
    Err(evaluator.diagnostic(path, &message).with_label(&label))
}

/// Rims are free: a scene can neither hold nor load them.
///
/// # Errors
/// A complaint about the first word that says something else.
pub(crate) fn rims_are_free(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &SceneWords<'_>,
    round: &Round,
) -> Result<(), Diagnostic> {
    let kind = round.name();
    let held = words.boundary.as_slice().first().map(|(face, _)| {
        let message = format!("the rims of a body of kind `{kind}` are free, not `{face}`");
        evaluator.diagnostic_at_key(&path.then("boundary").then(face.as_str()), &message)
    });
    let loaded = words.loads.iter().enumerate().find_map(|(i, load)| {
        let on = load.words().face()?;
        let message = format!("the rims of a body of kind `{kind}` are free, `{on}` has no load");
        Some(evaluator.diagnostic(&load.path(i).then("on"), &message))
    });
    match held.or(loaded) {
        Some(diagnostic) => {
            Err(diagnostic.with_help("only the faces of a `box` can be held or loaded"))
        }
        None => Ok(()),
    }
}

/// A grid that the suite asks for must reach over the whole body.
///
/// # Errors
/// A complaint about the end of the grid that lies inside.
pub(crate) fn fits(
    evaluator: &Evaluator<'_>,
    path: &Path,
    round: &Round,
    grid: Option<&(Vec<f64>, Vec<f64>)>,
) -> Result<(), Diagnostic> {
    let Some(grid) = grid else { return Ok(()) };
    let body = round.corners();
    for axis in 0..body.0.len() {
        for (key, word, inside, body, end) in [
            ("from", "most", grid.0[axis] > body.0[axis], body.0[axis], grid.0[axis]),
            ("to", "least", grid.1[axis] < body.1[axis], body.1[axis], grid.1[axis]),
        ] {
            if inside {
                let (kind, reach, end) = (round.name(), shown(body), shown(end));
                let message = format!("the {kind} reaches to {reach}, and the grid ends at {end}");
                let diagnostic =
                    evaluator.diagnostic(&path.then("grid").then(key).then(axis), &message);
                return Err(diagnostic.with_label(&format!("expected at {word} {reach}")));
            }
        }
    }
    Ok(())
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

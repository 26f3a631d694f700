//! Boxes and bodies that are not boxes, from words.

use super::{
    boundary::Hold,
    lengths::{LONGEST, SHORTEST},
    quadrilateral::quadrilateral,
};
use crate::{
    exact::Round,
    mpm::Quadrilateral,
    suite::{
        compile::{evaluator::Binder, path::Path, truth::law, wording::shown},
        grammar::{AnnulusWords, BodyWords, BoxWords, LoadWords, RoundWords, SceneWords},
        model::{Scene, SceneFace},
        yaml::{Complaint, NumberText},
    },
};

/// What a body is.
pub(crate) enum Shape<'a> {
    /// A box, whose words are read by [`corners`].
    Box(&'a BoxWords),
    /// A round body.
    Round(Round),
    /// A panel.
    Quadrilateral(Quadrilateral),
}

/// What kind of body `words` describe.
///
/// # Errors
/// A complaint about a body that makes no sense in `dimension` dimensions.
pub(crate) fn shape<'a>(
    binder: &Binder<'_>,
    path: &Path,
    words: &'a BodyWords,
    dimension: usize,
) -> Result<Shape<'a>, Complaint> {
    let of_kind = |kind: &str, flat: usize| {
        let at = path.then(kind);
        if dimension == flat {
            return Ok(at);
        }
        let message = format!("the scene is {dimension}-D, and `{kind}` a body in {flat}-D");
        let others = ["`box`", "`box`, `annulus`, `disk` or `quadrilateral`", "`box` or `ball`"];
        let help = format!("in {dimension}-D a body is a {}", others[dimension - 1]);
        Err(binder.complain_key(&at, &message).with_help(&help))
    };
    let (at, centre, radii) = match words {
        BodyWords::Box(words) => return Ok(Shape::Box(words)),
        BodyWords::Quadrilateral(words) => {
            let at = of_kind("quadrilateral", 2)?;
            return quadrilateral(binder, &at, words, dimension).map(Shape::Quadrilateral);
        }
        BodyWords::Annulus(AnnulusWords { centre, inner, outer }) => {
            let radii = [Some(("inner", inner)), Some(("outer", outer))];
            (of_kind("annulus", 2)?, centre, radii)
        }
        BodyWords::Disk(RoundWords { centre, radius }) => {
            (of_kind("disk", 2)?, centre, [None, Some(("radius", radius))])
        }
        BodyWords::Ball(RoundWords { centre, radius }) => {
            (of_kind("ball", 3)?, centre, [None, Some(("radius", radius))])
        }
    };
    round(binder, &at, centre, radii, dimension).map(Shape::Round)
}

/// The round body at `path`, with an inner radius if it has one.
fn round(
    binder: &Binder<'_>,
    path: &Path,
    centre: &[NumberText],
    radii: [Option<(&str, &NumberText)>; 2],
    dimension: usize,
) -> Result<Round, Complaint> {
    let centre = binder.point(&path.then("centre"), centre, dimension)?;
    let mut lengths = [0.0; 2];
    for (length, given) in lengths.iter_mut().zip(radii) {
        if let Some((key, text)) = given {
            *length = radius(binder, &path.then(key), text)?;
        }
    }
    let [inner, outer] = lengths;
    if inner < outer {
        return Ok(Round { centre, inner, outer });
    }
    let message = format!("the outer radius is {}, the inner {}", shown(outer), shown(inner));
    let complaint = binder.complain(&path.then("outer"), &message);
    Err(complaint.with_label("expected a number above `inner`"))
}

/// Lowest and highest corner of a box.
///
/// # Errors
/// A complaint about a box that is empty, too small or too large.
pub(crate) fn corners(
    binder: &Binder<'_>,
    path: &Path,
    words: &BoxWords,
    dimension: usize,
) -> Result<(Vec<f64>, Vec<f64>), Complaint> {
    let from = binder.point(&path.then("from"), &words.from, dimension)?;
    let to = binder.point(&path.then("to"), &words.to, dimension)?;
    for axis in 0..dimension {
        if !(from[axis] < to[axis]) {
            let (from, to) = (shown(from[axis]), shown(to[axis]));
            let message = format!("the box ends at {to} and starts at {from}");
            let complaint = binder.complain(&path.then("to").then(axis), &message);
            return Err(complaint.with_label("expected a number above that of `from`"));
        }
        // Squares of lengths appear in second derivatives, cubes in volumes.
        let length = to[axis] - from[axis];
        if !(SHORTEST..=LONGEST).contains(&length) {
            let message = format!("the box is {} m long", shown(length));
            let complaint = binder.complain(&path.then("to").then(axis), &message);
            let label = format!("expected a length from {SHORTEST:e} to {LONGEST:e}");
            return Err(complaint.with_label(&label));
        }
    }
    Ok((from, to))
}

fn radius(binder: &Binder<'_>, path: &Path, text: &NumberText) -> Result<f64, Complaint> {
    let radius = binder.positive(path, text, "the radius")?;
    if (SHORTEST..=LONGEST).contains(&radius) {
        return Ok(radius);
    }
    let message = format!("the radius is {} m", shown(radius));
    let label = format!("expected a length from {SHORTEST:e} to {LONGEST:e}");
    Err(binder.complain(path, &message).with_label(&label))
}

/// Rims are free: a scene can neither hold nor load them.
///
/// # Errors
/// A complaint about the first word that says something else.
pub(crate) fn rims_are_free(
    binder: &Binder<'_>,
    path: &Path,
    words: &SceneWords,
    round: &Round,
) -> Result<(), Complaint> {
    let kind = round.name();
    let held = words.boundary.as_slice().first().map(|(face, _)| {
        let message = format!("the rims of a body of kind `{kind}` are free, not `{face}`");
        binder.complain_key(&path.then("boundary").then(face.as_str()), &message)
    });
    let loaded = words.loads.iter().enumerate().find_map(|(i, load)| {
        let (key, on) = match load {
            LoadWords::Traction { on, .. } => ("traction", on),
            LoadWords::Pressure { on, .. } => ("pressure", on),
            _ => return None,
        };
        let message = format!("the rims of a body of kind `{kind}` are free, `{on}` has no load");
        Some(binder.complain(&path.then("loads").then(i).then(key).then("on"), &message))
    });
    match held.or(loaded) {
        Some(complaint) => {
            Err(complaint.with_help("only the faces of a `box` can be held or loaded"))
        }
        None => Ok(()),
    }
}

/// A grid that the suite asks for must reach over the whole body.
///
/// # Errors
/// A complaint about the end of the grid that lies inside.
pub(crate) fn fits(
    binder: &Binder<'_>,
    path: &Path,
    round: &Round,
    grid: Option<&(Vec<f64>, Vec<f64>)>,
) -> Result<(), Complaint> {
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
                let complaint = binder.complain(&path.then("grid").then(key).then(axis), &message);
                return Err(complaint.with_label(&format!("expected at {word} {reach}")));
            }
        }
    }
    Ok(())
}

/// The grid must reach over the body, and a face that is held must lie on the grid's own face: its
/// nodes are what is held, and a periodic axis ends there. Where the body may start deformed, the
/// period is that of its motion, which is checked against the grid's.
pub(crate) fn on_grid(binder: &Binder<'_>, path: &Path, scene: &Scene) -> Result<(), Complaint> {
    let Some((from, to)) = &scene.grid else { return Ok(()) };
    let deforms = law::manufactured(&scene.material).is_ok();
    let given = |face: &&SceneFace| !(deforms && matches!(face.hold, Hold::Periodic));
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
            return Err(binder.complain(&at, &message).with_label(&label));
        }
    }
    Ok(())
}

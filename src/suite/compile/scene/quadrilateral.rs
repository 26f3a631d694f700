//! Panels with four straight sides, from words.

use super::{
    boundary::FACES,
    lengths::{LONGEST, SHORTEST},
};
use crate::{
    mpm::{Quadrilateral, Vector},
    suite::{
        compile::{evaluator::Binder, path::Path, wording::shown},
        grammar::{BoundaryWords, ConvergenceWords, LoadWords, QuadrilateralWords, SceneWords},
        yaml::Complaint,
    },
};

/// The panel that `words` at `path` describe.
///
/// # Errors
/// A complaint about corners that are not those of a convex panel in the plane.
pub(crate) fn quadrilateral(
    binder: &Binder<'_>,
    path: &Path,
    words: &QuadrilateralWords,
    dimension: usize,
) -> Result<Quadrilateral, Complaint> {
    let path = path.then("corners");
    let [a, b, c, d] = &words.corners[..] else {
        let message = format!("a quadrilateral of {} corners", words.corners.len());
        return Err(binder.complain(&path, &message).with_label("expected four"));
    };
    let mut corners = [Vector::<2>::zeros(); 4];
    for (i, texts) in [a, b, c, d].into_iter().enumerate() {
        let at = path.then(i);
        corners[i] = Vector::from_column_slice(&binder.point(&at, texts, dimension)?);
        for k in 0..i {
            let length = (corners[i] - corners[k]).norm();
            if !(SHORTEST..=LONGEST).contains(&length) {
                let (first, second, length) = (k + 1, i + 1, shown(length));
                let message = format!("corners {first} and {second} are {length} m apart");
                let label = format!("expected a distance from {SHORTEST:e} to {LONGEST:e}");
                return Err(binder.complain(&at, &message).with_label(&label));
            }
        }
    }
    Quadrilateral::new(corners).map_err(|i| {
        let message = format!("at corner {} the sides do not turn to the left", i + 1);
        let complaint = binder.complain(&path.then(i), &message);
        complaint.with_label("expected the corners of a convex panel, counter-clockwise")
    })
}

/// A face can be held or loaded where a whole side lies on it.
///
/// # Errors
/// A complaint about the first word that says something of another face.
pub(crate) fn faces_are_sides(
    binder: &Binder<'_>,
    path: &Path,
    words: &SceneWords,
    panel: &Quadrilateral,
) -> Result<(), Complaint> {
    let is_side = |name: &str| {
        let number = FACES.iter().position(|face| *face == name);
        // Others are no faces at all, of which more is said later.
        number.is_none_or(|i| i >= 4 || panel.has_side_at(i / 2, i % 2 == 1))
    };
    let no_side = |at: &Path, face: &str, is_key: bool| {
        let message = format!("no side of the quadrilateral lies on its `{face}` face");
        let complaint =
            if is_key { binder.complain_key(at, &message) } else { binder.complain(at, &message) };
        complaint.with_help("a face can be held or loaded where a whole side lies on it")
    };
    for (face, hold) in words.boundary.as_slice() {
        let at = path.then("boundary").then(face.as_str());
        if matches!(hold, BoundaryWords::Periodic) {
            return Err(binder.complain_key(&at, "a quadrilateral does not go on periodically"));
        }
        if !is_side(face) {
            return Err(no_side(&at, face, true));
        }
    }
    for (i, load) in words.loads.iter().enumerate() {
        let (key, on) = match load {
            LoadWords::Traction { on, .. } => ("traction", on),
            LoadWords::Pressure { on, .. } => ("pressure", on),
            _ => continue,
        };
        if !is_side(on) {
            return Err(no_side(&path.then("loads").then(i).then(key).then("on"), on, false));
        }
    }
    Ok(())
}

/// Solutions are checked in boxes and round bodies.
///
/// # Errors
/// A complaint about a truth that is stated.
pub(crate) fn refuse_truth(binder: &Binder<'_>, words: &ConvergenceWords) -> Result<(), Complaint> {
    let stated = [
        ("exact", words.exact.is_some()),
        ("equilibrium", words.equilibrium.is_some()),
        ("manufactured", words.manufactured.is_some()),
    ];
    match stated.iter().find(|(_, stated)| *stated) {
        Some((key, _)) => {
            let message = "a solution is checked in a box or a round body, not in a quadrilateral";
            Err(binder.complain_key(&Path::top(key), message))
        }
        None => Ok(()),
    }
}

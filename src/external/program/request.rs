//! Requests of a solver for values at places and times.

use super::column::ColumnText;
use crate::external::fields::{BODY_FIELDS, FieldName};
use crate::external::problem::{ProblemFace, ProblemLoad};
use crate::nearest::nearest;

/// A request for values.
pub(super) struct ValueRequest {
    /// The field that is requested; absent in a request `body_force`.
    pub(super) of: Option<String>,
    /// Time (s).
    pub(super) t: Option<f64>,
    pub(super) reference_position: Option<ColumnText>,
    pub(super) displacement: Option<ColumnText>,
    pub(super) body: Option<usize>,
}

/// Places of a request, in numbers.
pub(super) struct RequestedPlaces {
    pub(super) labels: Vec<f64>,
    pub(super) bodies: Vec<usize>,
    pub(super) displacement: Option<Vec<f64>>,
    /// Whether they are the particles or the points.
    pub(super) are_own: bool,
}

/// The field that a request names.
pub(super) fn field_named(
    name: &str,
    loads: &[ProblemLoad],
    faces: &[ProblemFace],
) -> Result<FieldName, String> {
    if let Some((_, field)) = BODY_FIELDS.iter().find(|(known, _)| *known == name) {
        return Ok(*field);
    }
    let loads = (0..loads.len()).map(|load| (format!("load:{load}"), FieldName::Load(load)));
    let faces = faces.iter().enumerate();
    let faces = faces.map(|(i, face)| (format!("face:{}", face.name), FieldName::Face(i)));
    let known: Vec<(String, FieldName)> = loads.chain(faces).collect();
    if let Some((_, field)) = known.iter().find(|(known, _)| known == name) {
        return Ok(*field);
    }
    let names = BODY_FIELDS.iter().map(|(known, _)| *known);
    let names: Vec<&str> = names.chain(known.iter().map(|(known, _)| known.as_str())).collect();
    Err(match nearest(name, names.iter().copied()) {
        Some(known) => format!("unknown field; did you mean `{known}`?"),
        None => format!("unknown field; known: {}", names.join(", ")),
    })
}

/// The time (s) that a request means.
pub(super) fn time(field: FieldName, t: Option<f64>) -> Result<f64, String> {
    match t {
        None if field.is_initial() => Ok(0.0),
        None => Err("the request has no time `t`".to_owned()),
        Some(t) if field.is_initial() && t != 0.0 => {
            Err(format!("it is known at t = 0 only, not at t = {t}"))
        }
        Some(t) if !t.is_finite() => Err(format!("the time is {t}")),
        Some(t) => Ok(t),
    }
}

//! Faces of a body and their names.

use super::boundary::BoundaryCondition;
use crate::suite::evaluator::{SuitePath, suggestion};
use crate::suite::yaml::Diagnostic;
use std::sync::Arc;

/// Names of the faces in axis order, with the low face of each axis before the high face.
pub(crate) const FACES: [&str; 6] = ["left", "right", "bottom", "top", "back", "front"];

/// One face of the body.
#[derive(Debug, Clone)]
pub struct SceneFace {
    /// Name in suites.
    pub name: &'static str,
    /// Axis of the face normal.
    pub axis: usize,
    /// Whether this is the face with the larger coordinate.
    pub high: bool,
    /// Condition on the motion of the face.
    pub(crate) hold: Arc<dyn BoundaryCondition>,
}

impl SceneFace {
    /// Returns the name of the condition in suites.
    pub fn condition(&self) -> &'static str {
        self.hold.kind().name
    }
}

/// Returns the index in [`FACES`] of a face. An error points to the key or the value at `path`.
pub(crate) fn face(
    path: &SuitePath<'_>,
    name: &str,
    dimension: usize,
    is_key: bool,
) -> Result<usize, Diagnostic> {
    let known = &FACES[..2 * dimension];
    known.iter().position(|face| *face == name).ok_or_else(|| {
        let message = format!("a body of dimension {dimension} has no face `{name}`");
        let diagnostic =
            if is_key { path.diagnostic_at_key(&message) } else { path.diagnostic(&message) };
        diagnostic.with_help(&suggestion("faces", name, known))
    })
}

#[cfg(feature = "schemas")]
pub(crate) fn face_name(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    schemars::json_schema!({"type": "string", "enum": FACES})
}

#[cfg(feature = "schemas")]
pub(crate) fn face_or_rim(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let names: Vec<&str> = FACES.into_iter().chain(["inner", "outer"]).collect();
    schemars::json_schema!({"type": "string", "enum": names})
}

#[cfg(feature = "schemas")]
pub(crate) fn by_face<T: schemars::JsonSchema>(
    all: &mut schemars::SchemaGenerator,
) -> schemars::Schema {
    let one = all.subschema_for::<T>().to_value();
    let faces: serde_json::Map<String, serde_json::Value> =
        FACES.iter().map(|face| ((*face).to_owned(), one.clone())).collect();
    schemars::json_schema!({"type": "object", "properties": faces, "additionalProperties": false})
}

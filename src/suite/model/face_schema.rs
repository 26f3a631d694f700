//! Schemas of the names of faces.

use super::scene::FACES;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Map, Value};

/// The name of a face.
pub(crate) fn face_name(_: &mut SchemaGenerator) -> Schema {
    json_schema!({"type": "string", "enum": FACES})
}

/// A map from names of faces.
pub(crate) fn by_face<T: JsonSchema>(all: &mut SchemaGenerator) -> Schema {
    let one = all.subschema_for::<T>().to_value();
    let faces: Map<String, Value> =
        FACES.iter().map(|face| ((*face).to_owned(), one.clone())).collect();
    json_schema!({"type": "object", "properties": faces, "additionalProperties": false})
}

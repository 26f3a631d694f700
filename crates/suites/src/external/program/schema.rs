//! The JSON Schema (draft 2020-12) of the protocol, generated from the types of its messages.

use super::answer::{Answer, ColumnText};
use super::solver::{PROTOCOL, VERSIONS};
use crate::external::problem::{LevelProblem, ProblemParticles};
use crate::subject::GradientParameter;
use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::{Map, Value, json};

/// Returns the JSON Schema of all messages in both directions, as indented JSON. The definition
/// `answer` describes the messages of the solver, `request` those of the harness.
pub fn protocol_schema() -> String {
    let mut definitions = SchemaSettings::draft2020_12().into_generator();
    let answer = with_bytes(definitions.root_schema_for::<Answer>());
    let request = request(&mut definitions);
    let mut all = definitions.take_definitions(true);
    all.insert("answer".to_owned(), answer);
    all.insert("request".to_owned(), request);
    let schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "mpm-verify solver protocol",
        "description": format!("One message of version {PROTOCOL}: a line of JSON."),
        "anyOf": [{"$ref": "#/$defs/request"}, {"$ref": "#/$defs/answer"}],
        "$defs": all,
    });
    // The schema contains only names and texts, so the conversion to JSON cannot fail.
    serde_json::to_string_pretty(&schema).unwrap_or_default() + "\n"
}

/// Adds the key `bytes` to the schema of a message. This key announces a block of bytes.
fn with_bytes(schema: Schema) -> Value {
    let mut schema = schema.to_value();
    if let Value::Object(message) = &mut schema {
        message.remove("$schema");
        message.remove("$defs");
        let count =
            json!({"type": "integer", "minimum": 0, "description": "Bytes that follow the line."});
        message.insert("properties".to_owned(), json!({"bytes": count}));
    }
    schema
}

fn request(definitions: &mut SchemaGenerator) -> Value {
    let column = definitions.subschema_for::<ColumnText>().to_value();
    let count = json!({"type": "integer", "minimum": 0});
    let number = json!({"type": "number"});
    let particles = ProblemParticles::default();
    let names: Vec<&str> = particles.columns().into_iter().map(|(name, _)| name).collect();
    let all = names.iter().copied().chain(ProblemParticles::OPTIONAL);
    let columns: Map<String, Value> = all.map(|name| (name.to_owned(), column.clone())).collect();
    let particles = json!({"type": "object", "properties": columns, "required": names});
    let problem = with_bytes(LevelProblem::json_schema(definitions));
    let forces = json!({"enum": ["none", "constant", "asked"]});
    let parameters: Vec<&str> = GradientParameter::ALL.iter().map(|one| one.name()).collect();
    json!({"oneOf": [
        message("hello", json!({
            "protocol": {"const": PROTOCOL},
            "versions": {"const": VERSIONS},
            "harness": {"type": "string"},
        })),
        {"allOf": [
            problem,
            message("problem", json!({"particles": particles, "body_force": forces})),
        ]},
        message("advance", json!({"steps": count, "dt": number, "from": number})),
        message("differentiate", json!({
            "of": functional(),
            "with_respect_to": {"type": "array", "items": {"enum": parameters}, "minItems": 1},
            "steps": count,
            "dt": number,
            "from": number,
        })),
        message("body_force", json!({"values": column})),
        {"oneOf": [
            message("values", json!({"of": {"type": "string"}, "values": column})),
            message("values", json!({"of": {"type": "string"}, "error": {"type": "string"}})),
        ]},
        message("bye", json!({})),
    ]})
}

fn functional() -> Value {
    let index = json!({"type": "integer", "minimum": 0});
    let of = |name: &str, keys: &[&str]| {
        let mut properties = json!({"functional": {"const": name}});
        for key in keys {
            properties[*key] = index.clone();
        }
        let required: Vec<&str> = ["functional"].iter().chain(keys).copied().collect();
        json!({"type": "object", "required": required, "properties": properties})
    };
    json!({"oneOf": [
        of("mean_displacement", &["axis"]),
        of("mean_square_displacement", &[]),
        of("kinetic_energy", &[]),
        of("position_of", &["particle", "axis"]),
    ]})
}

fn message(kind: &str, keys: Value) -> Value {
    let mut properties = Map::from_iter([("type".to_owned(), json!({"const": kind}))]);
    if let Value::Object(keys) = keys {
        properties.extend(keys);
    }
    let required: Vec<&String> = properties.keys().collect();
    json!({"type": "object", "required": required, "properties": properties})
}

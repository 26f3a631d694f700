//! JSON Schema (draft 7, which editors support), generated from the types of the grammar.

use crate::suite::grammar::{
    ConvergenceSpec, GradientSpec, InternalForceSpec, SpectrumSpec, StabilitySpec,
};
use schemars::Schema;
use schemars::generate::SchemaSettings;
use schemars::transform::{RecursiveTransform, Transform};
use serde_json::{Value, json};

/// Returns the schema of a suite, as indented JSON.
pub fn suite_schema() -> String {
    let mut all = SchemaSettings::draft07().into_generator();
    let convergence = all.subschema_for::<ConvergenceSpec>();
    let stability = all.subschema_for::<StabilitySpec>();
    let internal_force = all.subschema_for::<InternalForceSpec>();
    let gradient = all.subschema_for::<GradientSpec>();
    let spectrum = all.subschema_for::<SpectrumSpec>();
    let definitions = all.take_definitions(true);
    let of_study =
        |name: &str| json!({"required": ["study"], "properties": {"study": {"const": name}}});
    let mut schema = schemars::json_schema!({
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "mpm-verify suite",
        "description": "A suite of benchmarks: a problem with its exact solution, methods, and \
                        expectations.",
        "type": "object",
        "if": of_study("stability"),
        "then": stability,
        "else": {
            "if": of_study("internal_force"),
            "then": internal_force,
            "else": {
                "if": of_study("gradient"),
                "then": gradient,
                "else": {"if": of_study("spectrum"), "then": spectrum, "else": convergence},
            },
        },
        "definitions": definitions,
    });
    RecursiveTransform(without_links).transform(&mut schema);
    RecursiveTransform(without_null).transform(&mut schema);
    RecursiveTransform(names_in_one_list).transform(&mut schema);
    // The schema contains only names and texts, so the conversion to JSON cannot fail.
    serde_json::to_string_pretty(&schema).unwrap_or_default() + "\n"
}

/// Removes descriptions with links to Rust items, which authors of suites do not need.
fn without_links(schema: &mut Schema) {
    let speaks_of_source = |text: &Value| text.as_str().is_some_and(|text| text.contains("[`"));
    if schema.get("description").is_some_and(speaks_of_source) {
        schema.remove("description");
    }
}

/// Replaces alternative names without description by a single list of names.
fn names_in_one_list(schema: &mut Schema) {
    let bare = |choice: &Value| match choice.as_object() {
        Some(keys) if keys.len() == 2 && keys.get("type") == Some(&"string".into()) => {
            keys.get("const").cloned()
        }
        _ => None,
    };
    let choices = schema.get("oneOf").and_then(Value::as_array);
    let names = choices.and_then(|all| all.iter().map(bare).collect::<Option<Vec<Value>>>());
    if let Some(names) = names {
        schema.remove("oneOf");
        schema.insert("type".to_owned(), "string".into());
        schema.insert("enum".to_owned(), names.into());
    }
}

/// Removes `null` from optional keys: editors should report a key without a value.
fn without_null(schema: &mut Schema) {
    if schema.get("default").is_some_and(Value::is_null) {
        schema.remove("default");
    }
    let is_null = |one: &Value| one.is_null() || *one == "null" || *one == json!({"type": "null"});
    for keyword in ["type", "enum", "anyOf"] {
        let Some(Value::Array(all)) = schema.get_mut(keyword) else { continue };
        all.retain(|one| !is_null(one));
        let ([only], false) = (&mut all[..], keyword == "enum") else { continue };
        match only.take() {
            Value::Object(only) if !only.contains_key("$ref") => {
                schema.remove(keyword);
                for (key, value) in only {
                    schema.ensure_object().entry(key).or_insert(value);
                }
            }
            only @ Value::Object(_) => {
                schema.remove(keyword);
                schema.insert("allOf".to_owned(), json!([only]));
            }
            only => drop(schema.insert(keyword.to_owned(), only)),
        }
    }
}

//! Tests of the printed schemas on valid and invalid suites.

use crate::common::built_in_source;
use crate::common::json_schema::JsonSchema;
use mpm_verify::embedded;
use mpm_verify::suite::yaml::{self, Diagnostic, Source};
use mpm_verify::suite::{Suite, suite_schema};
use serde_json::{Value, json};
use std::collections::HashSet;
use std::sync::LazyLock;

static SUITE: LazyLock<JsonSchema> = LazyLock::new(|| JsonSchema::new(&suite_schema()));

/// Beginnings of diagnostics about shape, keys, types and names, and parts of their labels.
const SHAPE: [(&str, &str); 8] = [
    ("unknown key `", ""),
    ("unknown name `", "no name that is known here"),
    ("missing key `", ""),
    ("expected ", " is expected here"),
    ("`", "` takes no settings"),
    ("`", "` needs settings"),
    ("one name with its settings is expected here", ""),
    ("an empty list selects nothing", ""),
];

/// Parses a text; `None` if it is not a YAML map, or if a key occurs twice.
fn values(text: &str) -> Option<Value> {
    yaml::read(&Source::from_text("suite.yaml", text).ok()?).ok()
}

fn is_of_shape(complaint: &Diagnostic) -> bool {
    let (message, label) = (complaint.message(), complaint.label().unwrap_or_default());
    let both = format!("{message}\n{label}");
    SHAPE.iter().any(|(start, words)| message.starts_with(start) && both.contains(words))
}

/// Asserts that the schema also refuses a suite if its mistake is about keys, types or names.
pub(crate) fn refuses_too(text: &str, complaint: &Diagnostic) {
    let Some(values) = values(text).filter(|_| is_of_shape(complaint)) else { return };
    assert!(SUITE.refusal(&values).is_some(), "the schema accepts: {complaint}");
}

#[test]
fn every_suite_is_built_in_and_conforms_to_the_schema() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("verification");
    let files = Source::files_in(&folder).expect("suites");
    assert_eq!(embedded::names().count(), files.len());
    for name in embedded::names() {
        let source = built_in_source(name);
        let refusal = SUITE.refusal(&values(source.text()).expect("YAML"));
        assert_eq!(refusal, None, "{name}");
    }
}

/// Lists the pointers to all maps of a suite, with their keys.
fn keys(value: &Value, pointer: &str, found: &mut Vec<(String, String)>) {
    let below: Vec<(String, &Value)> = match value {
        Value::Object(map) => {
            found.extend(map.keys().map(|key| (pointer.to_owned(), key.clone())));
            map.iter().map(|(key, value)| (key.replace('/', "~1"), value)).collect()
        }
        Value::Array(list) => {
            list.iter().enumerate().map(|(i, value)| (i.to_string(), value)).collect()
        }
        _ => return,
    };
    for (step, value) in below {
        keys(value, &format!("{pointer}/{step}"), found);
    }
}

/// Replaces each explanation by one word. Explanations are a third of a text and do not matter to a
/// schema.
fn shorten(value: &mut Value) {
    match value {
        Value::Object(map) => {
            for (key, value) in map {
                match value {
                    Value::String(text) if ["about", "because", "source"].contains(&&**key) => {
                        "short".clone_into(text);
                    }
                    _ => shorten(value),
                }
            }
        }
        Value::Array(list) => list.iter_mut().for_each(shorten),
        _ => {}
    }
}

/// Every key of every suite is tested: left out, misspelt, and with a value of another type, one
/// after the other. Neither the schema nor the program may be stricter about keys and types.
#[test]
fn schema_and_program_agree_about_each_key() {
    schema_and_program_agree(1);
}

#[test]
#[ignore = "ci/nightly runs it"]
fn schema_and_program_agree_about_each_type() {
    schema_and_program_agree(5);
}

/// Tests `types` of the five other types for each key.
fn schema_and_program_agree(types: usize) {
    let (mut tried, mut counts) = (HashSet::new(), [0, 0]);
    let read = |name| {
        let source = built_in_source(name);
        let mut suite = values(source.text()).expect("YAML");
        shorten(&mut suite);
        (name, suite)
    };
    let mut suites: Vec<(&str, Value)> = embedded::names().map(read).collect();
    // Checking an exact solution takes longest in 3-D, and other costs grow with the text. Each key
    // is therefore tested in the cheapest suite.
    suites.sort_by_cached_key(|(_, suite)| {
        let dimension = suite.pointer("/scene/dimension").and_then(Value::as_u64);
        (dimension, suite.to_string().len())
    });
    for (name, suite) in suites {
        // The kinds of study share the grammar of nearly all keys.
        let study = suite.get("study").filter(|_| types > 1).map(Value::to_string);
        let mut all = Vec::new();
        keys(&suite, "", &mut all);
        for (pointer, key) in all {
            let place: String = pointer.chars().filter(|c| !c.is_ascii_digit()).collect();
            if !tried.insert((study.clone(), place, key.clone())) {
                continue;
            }
            let mut others = [json!(true), json!({}), json!([]), json!("word"), json!(1)].map(Some);
            others.rotate_left(tried.len() % 5);
            let others = others.into_iter().take(types);
            for (new_key, value) in others.map(|value| (key.clone(), value)).chain([
                (key.clone(), None),
                (format!("{key}s"), suite.pointer(&pointer).map(|map| map[&key].clone())),
            ]) {
                let mut mutant = suite.clone();
                let map = mutant.pointer_mut(&pointer).and_then(Value::as_object_mut);
                let map = map.expect("a map");
                map.remove(&key);
                map.extend(value.map(|value| (new_key, value)));
                let refusal = SUITE.refusal(&mutant);
                let text = Source::from_text("suite.yaml", mutant.to_string()).expect("JSON");
                let loaded = Suite::load(&text.trusted());
                counts[usize::from(refusal.is_some())] += 1;
                // The program accepts a number as a text without quotes: `title: 1984`.
                let unquoted = |refusal: &String| refusal.ends_with("against `type: \"string\"`");
                match (&loaded, &refusal) {
                    (Ok(_), Some(refusal)) if !unquoted(refusal) => {
                        panic!("{name}{pointer}: {key}: loads, and {refusal}")
                    }
                    (Err(complaint), None) if is_of_shape(complaint) => {
                        panic!("{name}{pointer}: {key}: the schema accepts\n{complaint}")
                    }
                    _ => {}
                }
            }
        }
    }
    assert!(counts.iter().all(|count| *count > 150), "accepted and refused: {counts:?}");
}

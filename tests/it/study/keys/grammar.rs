//! The grammar of a suite, from its JSON Schema, which is generated from the types of the grammar.

use mpm_verify::suite::suite_schema;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Kinds of study, with the types that describe them in the schema.
const STUDIES: [(&str, &str); 5] = [
    ("convergence", "ConvergenceSpec"),
    ("stability", "StabilitySpec"),
    ("internal_force", "InternalForceSpec"),
    ("gradient", "GradientSpec"),
    ("spectrum", "SpectrumSpec"),
];

/// Keys of maps that have a key for each face.
const FACES: [&str; 6] = ["left", "right", "bottom", "top", "back", "front"];

/// All allowed values at one path.
#[derive(Debug, Default)]
pub(super) struct Node {
    /// Keys of a map, or names that have settings, each with its node.
    pub(super) keys: BTreeMap<String, Node>,
    /// Allowed names that have no settings.
    pub(super) names: BTreeSet<String>,
    /// Whether the key is required. Both values if this depends on the context.
    pub(super) required: BTreeSet<bool>,
    /// Node of the values of a map whose keys are faces, or chosen by the author.
    pub(super) named: Option<Box<Node>>,
    /// Node of the members of a list.
    pub(super) member: Option<Box<Node>>,
}

/// Returns the grammar of each kind of study.
pub(super) fn studies() -> Vec<(&'static str, Node)> {
    let schema: Value = serde_json::from_str(&suite_schema()).expect("the schema of a suite");
    let of_study = |(study, name): (&'static str, &str)| {
        let mut node = Node::default();
        node.add(&schema["definitions"][name], &schema["definitions"]);
        (study, node)
    };
    STUDIES.map(of_study).into()
}

impl Node {
    /// Adds the values that a schema allows.
    fn add(&mut self, schema: &Value, definitions: &Value) {
        if let Some(reference) = schema["$ref"].as_str() {
            let name = reference.rsplit('/').next().unwrap_or_default();
            return self.add(&definitions[name], definitions);
        }
        let list = |key: &str| schema[key].as_array().into_iter().flatten();
        for alternative in ["allOf", "anyOf", "oneOf"].into_iter().flat_map(list) {
            self.add(alternative, definitions);
        }
        let names = list("enum").chain(schema.get("const")).filter_map(Value::as_str);
        self.names.extend(names.filter(|name| !FACES.contains(name)).map(str::to_owned));
        for (key, below) in [("items", &mut self.member), ("additionalProperties", &mut self.named)]
        {
            if schema[key].is_object() {
                below.get_or_insert_default().add(&schema[key], definitions);
            }
        }
        let required: Vec<&str> = list("required").filter_map(Value::as_str).collect();
        for (key, value) in schema["properties"].as_object().into_iter().flatten() {
            if FACES.contains(&key.as_str()) {
                self.named.get_or_insert_default().add(value, definitions);
                continue;
            }
            let node = self.keys.entry(key.clone()).or_default();
            node.required.insert(required.contains(&key.as_str()));
            // The expectation of a full run has the same keys.
            if key != "full" {
                node.add(value, definitions);
            }
        }
    }
}

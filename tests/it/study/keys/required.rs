//! Determines the required keys from the JSON Schema of a suite.

use super::manual::{joined, key_of};
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

/// For each key, whether it is required. Both values if this depends on the context.
pub(super) type Required = BTreeMap<String, BTreeSet<bool>>;

struct Walk<'a> {
    definitions: &'a Value,
    study: &'a str,
    found: Required,
}

pub(super) fn required() -> Required {
    let schema: Value = serde_json::from_str(&suite_schema()).expect("the schema of a suite");
    let mut all = Required::new();
    for (study, name) in STUDIES {
        let definitions = &schema["definitions"];
        let mut walk = Walk { definitions, study, found: Required::new() };
        walk.below(&definitions[name], "");
        for (key, found) in walk.found {
            all.entry(key).or_default().extend(found);
        }
    }
    all
}

impl Walk<'_> {
    fn below(&mut self, node: &Value, path: &str) {
        if let Some(reference) = node["$ref"].as_str() {
            let name = reference.rsplit('/').next().unwrap_or_default();
            let definitions = self.definitions;
            return self.below(&definitions[name], path);
        }
        for several in ["allOf", "anyOf", "oneOf"] {
            let members = node[several].as_array().into_iter().flatten();
            members.for_each(|member| self.below(member, path));
        }
        for one in ["items", "additionalProperties"] {
            if node[one].is_object() {
                self.below(&node[one], path);
            }
        }
        let must: Vec<&str> =
            node["required"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
        for (key, member) in node["properties"].as_object().into_iter().flatten() {
            if FACES.contains(&key.as_str()) {
                self.below(member, path);
                continue;
            }
            let path = joined(path, key);
            let is_required = must.contains(&key.as_str());
            self.found.entry(key_of(self.study, &path)).or_default().insert(is_required);
            // The expectation of a full run has the same keys.
            if key != "full" {
                self.below(member, &path);
            }
        }
    }
}

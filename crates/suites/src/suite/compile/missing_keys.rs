//! Tests that the error for each missing required key shows a valid sample value.

use crate::suite::grammar::SuiteSpec;
use crate::suite::grammar::sample::SAMPLES;
use crate::suite::yaml;
use crate::suite::yaml::{Diagnostic, Source};
use serde_json::{Map, Value};
use std::collections::BTreeSet;
use std::path::Path;

/// A suite that contains the required keys missing from all suites of the repository.
const MORE: &str = "
suite: more
title: More
source: here
scene: {dimension: 2, body: {quadrilateral: {corners: [[0, 0], [1, 0], [1, 1], [0, 1]]}}}
run: {until: 1, dt: {courant: 0.5}}
refine: {cells: 4}
methods: [{mpm: {basis: linear, transfer: flip, scheme: usl}}, {external: {name: mine}}]
expect: [{verdict: failed, because: none}]
";

fn grammatical(text: &Value) -> Result<(), Diagnostic> {
    let source = Source::from_text("suite.yaml", text.to_string())?;
    SuiteSpec::read(&source).map(drop)
}

/// Appends to `found` every key of `value`, with a JSON pointer to the map that contains the key.
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

fn map<'a>(suite: &'a mut Value, pointer: &str) -> &'a mut Map<String, Value> {
    suite.pointer_mut(pointer).and_then(Value::as_object_mut).expect("a map")
}

#[test]
fn a_missing_key_is_shown_with_a_line_that_can_be_pasted() {
    let more = Source::from_text("more.yaml", MORE).expect("a text");
    let folder = Path::new("../../verification");
    let files = Source::files_in(folder).expect("the suites of the repository");
    let texts = files.iter().map(|file| Source::read(file).expect("a text"));
    let (mut tried, mut missing) = (BTreeSet::new(), BTreeSet::new());
    let gradient = files.iter().find(|file| file.ends_with("gradient-bar.yaml"));
    let gradient = Source::read(gradient.expect("a suite")).expect("a text");
    let of = "position_of: {particle: 0, axis: 0}";
    let gradient = gradient.text().replace("mean_displacement: {axis: 0}", of);
    let gradient = Source::from_text("gradient.yaml", &gradient).expect("a text");
    for source in texts.chain([more, gradient]) {
        let suite: Value = yaml::read(&source).expect("a map");
        grammatical(&suite).unwrap_or_else(|diagnostic| panic!("{diagnostic}"));
        let study = suite.get("study").map(Value::to_string);
        let mut all = Vec::new();
        keys(&suite, "", &mut all);
        for (pointer, key) in all {
            let place: String = pointer.chars().filter(|c| !c.is_ascii_digit()).collect();
            if !tried.insert((study.clone(), place, key.clone())) {
                continue;
            }
            let mut without = suite.clone();
            map(&mut without, &pointer).remove(&key);
            let Err(diagnostic) = grammatical(&without) else { continue };
            if !diagnostic.message().starts_with(&format!("missing key `{key}`")) {
                continue;
            }
            let line = diagnostic.help().and_then(|help| help.strip_prefix("add `"));
            let line = line.and_then(|line| line.split('`').next()).expect("a line");
            assert!(!line.ends_with("VALUE"), "no sample for `{key}` of {pointer}");
            let pasted = Source::from_text("line.yaml", line).expect("a line of YAML");
            let pasted: Map<String, Value> = yaml::read(&pasted).expect("a key and its value");
            map(&mut without, &pointer).extend(pasted);
            if let Err(diagnostic) = grammatical(&without) {
                panic!("`{line}` does not fit {pointer} of {}: {diagnostic}", source.name());
            }
            missing.insert(key);
        }
    }
    let idle = SAMPLES
        .iter()
        .find(|(key, _)| key.rsplit('.').next().is_some_and(|key| !missing.contains(key)));
    assert_eq!(idle, None, "a sample for a key that may be missing, or is in no suite");
}

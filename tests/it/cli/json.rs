//! `--format json`: one document with the documented keys.

use super::{BAD_INPUT, BAR, Folder, SOUND, mistaken};
use crate::common::json_schema::JsonSchema;
use mpm_verify::report::report_schema;
use rstest::rstest;
use serde_json::{Value, json};

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

/// Returns the document of a run. It must have exactly the keys of the schema.
pub(super) fn document(folder: &Folder, targets: &[&str], code: i32) -> Value {
    let run = [&["run", "--format", "json"], targets].concat();
    let document = folder.call(&run).ended(code).json();
    assert_eq!(JsonSchema::new(&report_schema()).refusal(&document), None);
    document
}

#[test]
fn non_finite_numbers_are_strings() {
    // The stability study of the second suite is only compared with the schema.
    let document = document(&Folder::new(), &["steffen-bar", "null-space"], SOUND);
    let cases = list(&document["suites"][0]["cases"]);
    let broken = cases.iter().find(|case| case["verdict"] == "failed").expect("a failure");
    assert_eq!(broken["observed_order"], Value::Null);
    let levels = list(&broken["levels"]);
    let level = levels.iter().find(|level| level["failure"].is_string()).expect("a failed level");
    for norm in ["rms", "l1", "l2", "linf", "max_rms"] {
        assert_eq!(level["errors"][norm], "nan");
    }
}

#[test]
fn document_contains_valid_suites_despite_an_invalid_file() {
    let folder = Folder::with("bad.yaml", mistaken());
    let document = document(&folder, &["bad.yaml", "grid-crossing"], BAD_INPUT);
    let suites = list(&document["suites"]);
    assert_eq!((suites.len(), &suites[0]["suite"]), (1, &"grid-crossing".into()));
}

/// Every command that prints something must have the flag, and must print one document.
#[rstest]
#[case(&["list", "bar.yaml"], "/suites/0/cases/0/particle_steps", &json!(6000.0))]
#[case(&["check", "bar.yaml"], "/suites/0/cases", &json!(2))]
#[case(&["check", "bar.yaml"], "/errors", &json!(0))]
#[case(&["explain", "bar.yaml"], "/suites/0/cases/0/levels/2", &json!({
    "cells": 8, "h": 0.125, "particles": 32.0, "dt": 1e-3, "steps": 50, "courant": 0.08
}))]
#[case(&["explain", "bar.yaml"], "/suites/0/cases/0/profile/particles", &json!(16))]
#[case(
    &["explain", "two-bar-impact", "--without", "contact"],
    "/suites/0/cases/0/without/effects",
    &json!([])
)]
#[case(&["steps", "bar.yaml"], "/suites/0/levels/1", &json!({
    "case": "mpm-linear-flip-musl", "cells": 6, "steps": 50, "dt": 1e-3, "wanted": 1e-3,
    "ratio": 1.0, "instants": 50, "off": false
}))]
#[case(&["propose", "bar.yaml"], "/suites/0/suite", &json!("short-bar"))]
#[case(&["diagnose", "bar.yaml", "--case", "mpm"], "/cases/0/sound", &json!(true))]
#[case(&["problem", "bar.yaml", "--level", "1"], "/suite", &json!("short-bar"))]
#[case(&["cost", "bar.yaml"], "/suites/0/cases/0/levels/0/particle_updates", &json!(16 * 50))]
#[case(&["new", "my-suite"], "/file", &json!("my-suite.yaml"))]
fn every_command_prints_one_document(
    #[case] arguments: &[&str],
    #[case] place: &str,
    #[case] wanted: &Value,
) {
    let folder = Folder::with("bar.yaml", BAR);
    let arguments = [arguments, &["--format", "json"]].concat();
    let document = folder.call(&arguments).ended(SOUND).json();
    assert_eq!(document.pointer(place), Some(wanted), "{document:#}");
}

#[test]
fn document_of_check_contains_the_errors() {
    let folder = Folder::with("bad.yaml", mistaken());
    let found = folder.call(&["check", "bad.yaml", "--format", "json"]);
    assert_eq!((found.code, found.errors.as_str()), (BAD_INPUT, ""));
    let document = found.json();
    let diagnostic = &document["suites"][0]["diagnostics"][0];
    let wanted = json!({
        "severity": "error", "file": "bad.yaml", "line": 9, "column": 3,
        "message": "unknown key `dimensions`", "label": "not a known key",
        "help": "did you mean `dimension`?",
    });
    assert_eq!((diagnostic, &document["errors"]), (&wanted, &json!(1)));
}

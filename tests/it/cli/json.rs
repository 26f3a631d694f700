//! `--format json`: one document with the documented keys.

use super::{BAD_INPUT, BAR, FAILED, Folder, SOUND, ambitious, mistaken};
use crate::common::json_schema::JsonSchema;
use mpm_verify::report::report_schema;
use rstest::rstest;
use serde_json::{Value, json};

fn keys(value: &Value) -> Vec<&str> {
    let mut keys: Vec<&str> =
        value.as_object().expect("a map").keys().map(String::as_str).collect();
    keys.sort_unstable();
    keys
}

fn has(value: &Value, wanted: &[&str]) {
    let mut wanted = wanted.to_vec();
    wanted.sort_unstable();
    assert_eq!(keys(value), wanted);
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

/// Returns the document of a run. It must have exactly the keys of the schema.
fn document(folder: &Folder, targets: &[&str], code: i32) -> Value {
    let found = folder.call(&[&["run", "--format", "json"], targets].concat()).ended(code);
    let document = serde_json::from_str(&found.out).expect("one document");
    assert_eq!(JsonSchema::new(&report_schema()).refusal(&document), None);
    document
}

#[test]
fn a_stability_study_has_rows_and_no_levels() {
    let document = document(&Folder::new(), &["null-space"], SOUND);
    let case = &document["suites"][0]["cases"][0];
    assert!(!list(&case["stability"]["rows"]).is_empty(), "{case:#}");
    assert_eq!(case["levels"], json!([]));
}

#[test]
fn converging_case_has_all_values() {
    let folder = Folder::with("bar.yaml", BAR);
    let document = document(&folder, &["bar.yaml"], SOUND);
    let suite = &document["suites"][0];
    assert_eq!((&suite["suite"], &suite["passed"]), (&"short-bar".into(), &true.into()));
    let case = &suite["cases"][0];
    assert_eq!(case["case"], "mpm-linear-flip-musl");
    assert_eq!((&case["subject"], &case["verdict"]), (&"mpm".into(), &"converging".into()));
    assert_eq!((&case["passed"], &case["unmet"]), (&true.into(), &Value::Array(Vec::new())));
    assert_eq!((&case["formal_order"], &case["forces"]), (&2.0.into(), &Value::Null));
    let order = |key: &str| case["observed_order"][key].as_f64().expect("a number");
    has(&case["observed_order"], &["value", "low", "high"]);
    let judge = json!({"of": "displacement", "norm": "rms", "scale": null, "within": null});
    assert_eq!(case["judge"], judge);
    assert!(order("low") <= order("value") && order("value") <= order("high"));
    let levels = list(&case["levels"]);
    let cells: Vec<u64> = levels.iter().filter_map(|level| level["cells"].as_u64()).collect();
    assert_eq!(cells, [4, 6, 8, 12]);
    assert_eq!((&levels[0]["order"], levels[1]["order"].is_number()), (&Value::Null, true));
    assert_eq!((&levels[0]["ppc"], &levels[0]["particles"]), (&4.into(), &16.into()));
    assert_eq!(levels[0]["judged"], levels[0]["errors"]["rms"]);
    assert_eq!((&levels[0]["crossings"], &levels[0]["failure"]), (&0.into(), &Value::Null));
}

#[test]
fn values_that_fem_lacks_are_null() {
    let folder = Folder::with("bar.yaml", BAR);
    let document = document(&folder, &["bar.yaml"], SOUND);
    let case = &document["suites"][0]["cases"][1];
    assert_eq!(case["subject"], "fem");
    for level in list(&case["levels"]) {
        for key in ["ppc", "particles", "crossings", "left_domain", "drift"] {
            assert_eq!(level[key], Value::Null, "{key}");
        }
        assert!(level["transfers"].is_u64() && level["errors"]["rms"].is_f64());
    }
}

#[test]
fn an_internal_force_study_has_forces_and_no_levels() {
    let document = document(&Folder::new(), &["grid-crossing"], SOUND);
    let case = &document["suites"][0]["cases"][0];
    assert_eq!(list(&case["forces"]).len(), 16);
    assert_eq!((&case["levels"], &case["formal_order"]), (&Value::Array(Vec::new()), &Value::Null));
}

#[test]
fn non_finite_numbers_are_strings() {
    let document = document(&Folder::new(), &["steffen-bar"], SOUND);
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
fn unmet_expectations_are_listed() {
    let folder = Folder::with("bar.yaml", ambitious());
    let document = document(&folder, &["bar.yaml"], FAILED);
    let suite = &document["suites"][0];
    assert_eq!(suite["passed"], false);
    let unmet = list(&suite["cases"][0]["unmet"]);
    assert!(unmet.iter().all(Value::is_string) && !unmet.is_empty());
}

#[test]
fn document_contains_valid_suites_despite_an_invalid_file() {
    let folder = Folder::with("bad.yaml", mistaken());
    let document = document(&folder, &["bad.yaml", "grid-crossing"], BAD_INPUT);
    let suites = list(&document["suites"]);
    assert_eq!((suites.len(), &suites[0]["suite"]), (1, &"grid-crossing".into()));
}

/// The ranking by transfers must have the documented keys.
#[test]
fn methods_are_ranked_by_the_cost_of_accuracy() {
    let folder = Folder::with("bar.yaml", BAR);
    let document = document(&folder, &["bar.yaml", "grid-crossing"], SOUND);
    let [bar, forces] = list(&document["suites"]) else { panic!("two suites") };
    assert!(list(&forces["cost"]).is_empty());
    let [cost] = list(&bar["cost"]) else { panic!("one problem") };
    has(cost, &["problem", "size", "work", "targets", "methods"]);
    assert_eq!((&cost["work"], &cost["targets"][1]), (&"transfers".into(), &1e-3.into()));
    let methods = list(&cost["methods"]);
    assert_eq!(methods.len(), 2);
    for method in methods {
        has(method, &["case", "reached", "best", "not_reached", "pareto_front", "exponent"]);
        has(&method["exponent"], &["value", "low", "high", "theory", "agrees"]);
        assert_eq!(list(&method["reached"]).len(), 3);
        let best = method["best"].as_f64().expect("an error");
        for (target, reached) in [1e-2, 1e-3, 1e-4].iter().zip(list(&method["reached"])) {
            assert_eq!(reached.is_null(), best > *target, "{method}");
        }
    }
    assert_eq!(methods[0]["reached"][0]["times"], 1.0);
}

/// Every command that prints something must have the flag, and must print one document.
#[rstest]
#[case(&["list", "bar.yaml"], "/suites/0/cases/0/case", &json!("mpm-linear-flip-musl"))]
#[case(&["check", "bar.yaml"], "/suites/0/cases", &json!(2))]
#[case(&["check", "bar.yaml"], "/errors", &json!(0))]
#[case(&["explain", "bar.yaml"], "/suites/0/cases/0/levels/3/cells", &json!(12))]
#[case(&["explain", "bar.yaml"], "/suites/0/cases/0/profile/particles", &json!(16))]
#[case(&["steps", "bar.yaml"], "/suites/0/levels/0/steps", &json!(50))]
#[case(&["propose", "bar.yaml"], "/suites/0/suite", &json!("short-bar"))]
#[case(&["diagnose", "bar.yaml", "--case", "mpm"], "/cases/0/sound", &json!(true))]
#[case(&["problem", "bar.yaml", "--level", "1"], "/suite", &json!("short-bar"))]
#[case(&["cost", "bar.yaml"], "/suites/0/suite", &json!("short-bar"))]
#[case(&["new", "my-suite"], "/file", &json!("my-suite.yaml"))]
fn every_command_prints_one_document(
    #[case] arguments: &[&str],
    #[case] place: &str,
    #[case] wanted: &Value,
) {
    let folder = Folder::with("bar.yaml", BAR);
    let found = folder.call(&[arguments, &["--format", "json"]].concat()).ended(SOUND);
    let document: Value = serde_json::from_str(&found.out).expect("one document");
    assert_eq!(document.pointer(place), Some(wanted), "{document:#}");
}

#[test]
fn document_of_check_contains_the_errors() {
    let folder = Folder::with("bad.yaml", mistaken());
    let found = folder.call(&["check", "bad.yaml", "--format", "json"]);
    assert_eq!((found.code, found.errors.as_str()), (BAD_INPUT, ""));
    let document: Value = serde_json::from_str(&found.out).expect("one document");
    let diagnostic = &document["suites"][0]["diagnostics"][0];
    let wanted = json!({
        "severity": "error", "file": "bad.yaml", "line": 9, "column": 3,
        "message": "unknown key `dimensions`", "label": "not a known key",
        "help": "did you mean `dimension`?",
    });
    assert_eq!((diagnostic, &document["errors"]), (&wanted, &json!(1)));
}

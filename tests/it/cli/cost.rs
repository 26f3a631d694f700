//! `cost`: the cost of accuracy on this machine. Times differ from run to run; the tests check only
//! what is the same in all runs.

use super::{BAR, FAILED, Folder, SOUND, ambitious, assert_contains};
use serde_json::Value;

fn document(folder: &Folder, arguments: &[&str]) -> Value {
    let found = folder.call(&[&["cost", "--format", "json"], arguments].concat());
    assert_eq!((found.code, found.errors.as_str()), (SOUND, ""));
    serde_json::from_str(&found.out).expect("one document")
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

#[test]
fn report_has_levels_model_and_both_rankings() {
    let folder = Folder::with("bar.yaml", BAR);
    let out = folder.accepted(&["cost", "bar.yaml"]);
    assert_contains(
        &out,
        &[
            "short-bar: Short bar\n",
            "  machine           ",
            "ns/transfer",
            "cost model, ns",
            "work              seconds, interpolated between neighbouring levels",
            "work              particle-node transfers, interpolated between",
            "work ~ error^k",
        ],
    );
    let rows = |name: &str| out.lines().filter(|line| line.contains(name)).count();
    // Four levels, a model, and two rows in each of two rankings. If other tests run at the same
    // time, a finer level can take less time than a coarser one. Its time then has no exponent.
    assert!((8..=9).contains(&rows("mpm-linear-flip-musl")), "{out}");
}

#[test]
fn every_level_has_its_seconds_and_its_work() {
    let folder = Folder::with("bar.yaml", BAR);
    let document = document(&folder, &["bar.yaml"]);
    let [suite] = list(&document["suites"]) else { panic!("one suite") };
    assert!(suite["machine"]["cores"].as_u64() >= Some(1));
    assert_eq!(list(&suite["cases"]).len(), 2);
    for case in list(&suite["cases"]) {
        let model = &case["model"];
        let parts = ["transfer", "particle", "node", "step"].map(|key| model[key].as_f64());
        assert!(parts.iter().all(|part| *part >= Some(0.0)), "{model}");
        assert!(parts.iter().any(|part| *part > Some(0.0)), "{model}");
        assert_eq!(list(&case["levels"]).len(), 4);
        for level in list(&case["levels"]) {
            let seconds = &level["seconds"];
            let [low, median, high] =
                ["low", "median", "high"].map(|key| seconds[key].as_f64().expect("seconds"));
            assert!(0.0 < low && low <= median && median <= high, "{seconds}");
            assert!(seconds["repeats"].as_u64() >= Some(5), "{seconds}");
            assert!(level["transfers"].as_u64() > Some(0));
        }
    }
    let works: Vec<&Value> = list(&suite["cost"]).iter().map(|one| &one["work"]).collect();
    assert_eq!(works, ["seconds", "transfers"]);
}

/// With twice the stable time step a method fails. Its levels must still be in the table.
#[test]
fn failed_level_has_a_row() {
    let folder = Folder::with(
        "bar.yaml",
        BAR.replace("until: 0.05, dt: 1e-3", "until: 4, dt: \"0.16*h\", instants: 1"),
    );
    let out = folder.accepted(&["cost", "bar.yaml", "--figures", "figures"]);
    let broken = out.lines().filter(|line| line.split_whitespace().any(|w| w == "failed"));
    assert!(broken.count() > 0, "{out}");
    let figure = folder.read("figures/short-bar-work-transfers.svg");
    assert!(figure.contains("failed or not finite"));
    assert!(folder.files("figures").contains(&"short-bar-work-seconds.svg".to_owned()));
}

#[test]
fn budget_gives_a_setting_with_its_measured_result() {
    let folder = Folder::with("bar.yaml", BAR);
    let document = document(&folder, &["bar.yaml", "--budget", "30ms"]);
    let best = &document["suites"][0]["best_candidate"];
    let pair = |key: &str| {
        ["predicted", "measured"].map(|which| best[key][which].as_f64().expect("a number"))
    };
    let ([predicted, measured], errors) = (pair("seconds"), pair("error"));
    assert!(predicted <= 0.03 && measured > 0.0, "{best}");
    assert!(errors.iter().all(|error| *error > 0.0), "{best}");
    let [low, high] = ["low", "high"].map(|end| best["error"][end].as_f64().expect("an end"));
    assert!(low < errors[0] && errors[0] < high && high < 4.0 * low, "{best}");
    assert!(low < errors[1] && errors[1] < high, "{best}");
    // Four levels with up to 12 cells take a fraction of the budget.
    assert!(best["cells"].as_u64() > Some(12) && best["beyond"] == true, "{best}");
    assert_eq!(best["failure"], Value::Null);
    let text = folder.call(&["cost", "bar.yaml", "--budget", "30ms"]).out;
    assert_contains(
        &text,
        &["predicted within 0.03 s", "95 %", "measured", "share of budget", "model  "],
    );
}

/// The order is not the expected one. Therefore no error is predicted for finer levels.
#[test]
fn unpredicted_levels_are_not_chosen_for_a_budget() {
    let folder = Folder::with("bar.yaml", ambitious());
    let out = folder.accepted(&["cost", "bar.yaml", "--budget", "1s"]);
    let why = "nothing finer     no error is predicted: the levels are judged too low";
    assert!(out.contains(why) && out.contains("12 cells"), "{out}");
}

#[test]
fn impossible_budget_is_reported() {
    let folder = Folder::with("bar.yaml", BAR);
    let poor = folder.call(&["cost", "bar.yaml", "--budget", "1e-9s"]);
    assert_eq!(poor.code, FAILED);
    assert_contains(&poor.errors, &["no setting is predicted to run within"]);
    let time = folder.call(&["cost", "heat-temporal-order", "--budget", "1s"]);
    assert_eq!(time.code, FAILED);
    insta::assert_snapshot!(time.errors, @"error: --budget: heat-temporal-order: the suite does not refine its cells");
}

#[test]
fn invalid_arguments_are_refused_with_a_hint() {
    let folder = Folder::with("bar.yaml", BAR);
    for (arguments, words) in [
        (&["--budget", "10"][..], "such as `10s`"),
        (&["--budget=-1s"], "such as `10s`"),
        (&["--budget", "nans"], "such as `10s`"),
        (&["--budget", "1s", "--figures", "x"], "cannot be used with"),
        (&["--figures", "bar.yaml/x"], "--figures bar.yaml/x: "),
    ] {
        let arguments = [&["cost", "bar.yaml"], arguments].concat();
        let errors = folder.refused(&arguments);
        assert_contains(&errors, &[words]);
    }
}

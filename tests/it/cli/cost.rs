//! `cost`: the cost of accuracy on this machine. Times differ from run to run; the tests check only
//! what is the same in all runs.

use super::{BAR, Folder, SOUND, assert_contains};
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
fn report_has_levels_and_both_rankings() {
    let folder = Folder::with("bar.yaml", BAR);
    let out = folder.accepted(&["cost", "--verbose", "bar.yaml"]);
    assert_contains(
        &out,
        &[
            "short-bar: Short bar\n",
            "  machine           ",
            "ns/transfer",
            "work              seconds, interpolated between neighbouring levels",
            "work              particle-node transfers, interpolated between",
            "work ~ error^k",
        ],
    );
    let rows = |name: &str| out.lines().filter(|line| line.contains(name)).count();
    // Four levels in two blocks of columns, and two rows in each of two rankings.
    // If other tests run at the same time, a finer level can take less time than a coarser one. Its
    // time then has no exponent.
    assert!((11..=14).contains(&rows("mpm-linear-flip-musl")), "{out}");
}

#[test]
fn every_level_has_its_seconds_and_its_work() {
    let folder = Folder::with("bar.yaml", BAR);
    let document = document(&folder, &["bar.yaml"]);
    let [suite] = list(&document["suites"]) else { panic!("one suite") };
    assert!(suite["machine"]["cores"].as_u64() >= Some(1));
    assert_eq!(list(&suite["cases"]).len(), 2);
    for case in list(&suite["cases"]) {
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
fn unwritable_folder_is_refused() {
    let folder = Folder::with("bar.yaml", BAR);
    let errors = folder.refused(&["cost", "bar.yaml", "--figures", "bar.yaml/x"]);
    assert_contains(&errors, &["--figures bar.yaml/x: "]);
}

//! Refinement plans: the judged spacing, the cause of a floor, and the effect of `--full`.

use super::json::document;
use super::{BAR, FAILED, Folder, SOUND, assert_contains};
use crate::common::folder::flat;
use serde_json::Value;

/// Creates the bar with another plan and another time step, without expected orders.
fn bar(run: &str, refine: &str, expect: &str) -> String {
    let text = BAR
        .replace("run: {until: 0.05, dt: 1e-3}", run)
        .replace("refine: {cells: [4, 6, 8, 12], ppc: 4}", refine)
        .replace("  - fem: {element: linear, mass: lumped}\n", "")
        .replace("  - order: [1.7, 2.3]\n", expect);
    assert_ne!(text, BAR);
    text
}

const TOO_FEW: &str = "  - verdict: too_few_levels\n";

fn case(text: &str, arguments: &[&str], code: i32) -> Value {
    let folder = Folder::with("bar.yaml", text);
    let targets = [&["bar.yaml"], arguments].concat();
    document(&folder, &targets, code)["suites"][0]["cases"][0].clone()
}

fn column(case: &Value, key: &str) -> Vec<f64> {
    let levels = case["levels"].as_array().expect("a list");
    levels.iter().map(|level| level[key].as_f64().expect("a number")).collect()
}

/// A run has a whole number of steps: a step of 7e-4 s becomes 1/71 of the run. The judge must use
/// this actual step.
#[test]
fn refined_time_steps_are_used() {
    let text =
        bar("run: {until: 0.05}", "refine: {dt: [1e-3, 7e-4, 3e-4], cells: 8, ppc: 4}", TOO_FEW);
    let case = case(&text, &[], SOUND);
    assert_eq!((&case["axis"], &case["formal_order"]), (&"time".into(), &2.0.into()));
    assert_eq!(column(&case, "steps"), [50.0, 71.0, 167.0]);
    for (spacing, steps) in column(&case, "spacing").iter().zip([50.0, 71.0, 167.0]) {
        assert_eq!(*spacing, 0.05 / steps);
    }
    assert_eq!(column(&case, "cells"), [8.0; 3]);
}

#[test]
fn refined_particles_are_judged_by_their_spacing() {
    let text = bar("run: {until: 0.05, dt: 1e-3}", "refine: {ppc: [1, 2, 4], cells: 8}", TOO_FEW);
    let case = case(&text, &[], SOUND);
    assert_eq!((&case["axis"], &case["formal_order"]), (&"particles".into(), &Value::Null));
    assert_eq!(column(&case, "spacing"), [0.125, 0.0625, 0.03125]);
    assert_eq!(column(&case, "particles"), [8.0, 16.0, 32.0]);
}

#[test]
fn cells_and_time_steps_are_paired_by_level() {
    let refine = "refine: {cells: [4, 8, 12], dt: [1e-3, 5e-4, \"0.025*h/10*0.12\"], ppc: 4}";
    let case = case(&bar("run: {until: 0.05}", refine, TOO_FEW), &[], SOUND);
    assert_eq!(case["axis"], "space");
    assert_eq!(column(&case, "cells"), [4.0, 8.0, 12.0]);
    assert_eq!(column(&case, "steps")[..2], [50.0, 100.0]);
}

/// Four cells cause an error that smaller time steps do not reduce. The verdict is a floor, and the
/// probe must find its cause.
#[test]
fn the_axis_that_was_not_refined_is_named() {
    let refine = "refine: {dt: [1e-3, 5e-4, 2.5e-4, 1.25e-4, 6.25e-5], cells: 4, ppc: 4}";
    let expect = "  - verdict: at_floor\n    floor: space\n";
    let text = bar("run: {until: 0.05}", refine, expect);
    let wrong = case(&text.replace("floor: space", "floor: particles"), &[], FAILED);
    assert_eq!(wrong["unmet"][0], "expected the floor of `particles`, got `space`");
    let case = case(&text, &[], SOUND);
    assert_eq!((&case["verdict"], &case["floor"]["cause"]), (&"at floor".into(), &"space".into()));
    let axes: Vec<&Value> =
        case["floor"]["probes"].as_array().expect("a list").iter().map(|p| &p["axis"]).collect();
    assert_eq!(axes, ["particles", "space"]);
    let reason = case["reason"].as_str().expect("words");
    assert_contains(reason, &["the main cause of the error is the cell size"]);
}

const WITH_FULL: &str = "refine: {cells: [4, 6, 8], ppc: 4, full: [12, 16]}";

#[test]
fn finer_levels_run_only_with_full() {
    let expect = "  - verdict: too_few_levels
    full: {order: [1.7, 2.3], because: five levels are enough}\n";
    let text = bar("run: {until: 0.05, dt: 1e-3}", WITH_FULL, expect);
    assert_eq!(column(&case(&text, &[], SOUND), "cells"), [4.0, 6.0, 8.0]);
    let full = case(&text, &["--full"], SOUND);
    assert_eq!(column(&full, "cells"), [4.0, 6.0, 8.0, 12.0, 16.0]);
    assert_eq!(full["verdict"], "converging");
    // The expectation of a full run is the usual one by default.
    let text = bar("run: {until: 0.05, dt: 1e-3}", WITH_FULL, TOO_FEW);
    let unmet = &case(&text, &["--full"], FAILED)["unmet"][0];
    assert_eq!(unmet, "expected the verdict `too few levels`, got `converging`");
}

#[test]
fn reports_name_the_further_levels() {
    let folder = Folder::new();
    let refine = "refine: {dt: [1e-3, 5e-4, 2.5e-4], cells: 8, ppc: 4, full: [1.25e-4]}";
    folder.write("bar.yaml", bar("run: {until: 0.05}", refine, TOO_FEW));
    let found = flat(&folder.call(&["run", "bar.yaml"]).out);
    assert_contains(&found, &["further levels dt = 0.000125 s, with the option --full"]);
}

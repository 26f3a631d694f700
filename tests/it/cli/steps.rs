//! Automatic time steps, and the warning about a step that is too long.

use super::{BAR, FAILED, Folder, SOUND, assert_contains};
use serde_json::{Value, json};

/// Creates the bar without its FEM case, with another time step.
fn bar(dt: &str) -> String {
    BAR.replace("dt: 1e-3", dt)
        .replace("  - fem: {element: linear, mass: lumped}\n", "")
        .replace("order: [1.7, 2.3]", "verdict: failed")
}

#[test]
fn unstable_step_is_used_with_a_warning() {
    // c = 10 m/s: 0.02 s is 0.8 h/c on the coarsest grid and 2.4 h/c on the finest.
    let long = bar("dt: 0.02, instants: 1").replace("until: 0.05", "until: 20");
    let folder = Folder::with("bar.yaml", long.split_once("expect:").expect("an expectation").0);
    let found = folder.call(&["run", "bar.yaml", "--format", "json"]).ended(SOUND);
    let printed = warnings(&found.errors);
    assert_eq!(printed.len(), 3, "{printed:?}");
    let first = "warning: short-bar::mpm-linear-flip-musl, 6 cells: dt = 2.0000e-2 s is ";
    assert!(printed[0].starts_with(first), "{printed:?}");
    let level = &found.json()["suites"][0]["cases"][0]["levels"][3];
    assert!(level["dt"].as_f64() > level["stable_time_step"].as_f64());
    assert!(level["failure"].is_string());
    let text = folder.call(&["run", "bar.yaml"]).out;
    let words = "steps are longer than the stable time step: 6 cells, 8 cells,";
    assert_contains(&text, &[words]);
    // No warning is printed if a suite has an expectation about such steps, and meets it.
    folder.write("bar.yaml", &long);
    folder.accepted(&["run", "bar.yaml"]);
    folder.write("bar.yaml", long.replace("verdict: failed", "order: [1.9, 2.1]"));
    let found = folder.call(&["run", "bar.yaml"]);
    assert_eq!((found.code, warnings(&found.errors).len()), (FAILED, 3), "{}", found.errors);
}

/// The limit from few iterations is larger than this step.
#[test]
fn step_just_above_the_limit_has_a_warning() {
    let bar = |dt: &str| {
        bar(&format!("dt: {dt}, instants: 1"))
            .replace("until: 0.05", "until: 10")
            .replace("basis: linear", "basis: quadratic_bspline")
            .replace("scheme: musl", "scheme: usl")
            .replace("ppc: 4", "ppc: 2")
    };
    let folder = Folder::with("bar.yaml", bar("auto"));
    let document = folder.call(&["steps", "bar.yaml", "--format", "json"]).json();
    let half = document["suites"][0]["levels"][3]["dt"].as_f64().expect("a step");
    folder.write("bar.yaml", bar(&(2.04 * half).to_string()));
    let errors = folder.call(&["run", "bar.yaml"]).errors;
    let [warning] = warnings(&errors)[..] else { panic!("{errors}") };
    assert_contains(warning, &[" 12 cells: dt = ", " s is 1.02 times the stable time step, "]);
}

fn warnings(errors: &str) -> Vec<&str> {
    errors.lines().filter(|line| line.starts_with("warning: ")).collect()
}

#[test]
fn automatic_steps_are_fractions_of_one_stable_step() {
    let steps = |rule: &str| -> Vec<f64> {
        let folder = Folder::new();
        let text = bar(&format!("dt: {rule}, instants: 1")).replace("until: 0.05", "until: 100");
        folder.write("bar.yaml", text.replace("failed", "divergent"));
        let found = folder.call(&["run", "bar.yaml", "--format", "json"]);
        assert!(!found.errors.contains("warning:"), "{}", found.errors);
        let document = found.json();
        let levels = document["suites"][0]["cases"][0]["levels"].as_array().expect("a list");
        let share = |level: &Value| {
            level["dt"].as_f64().expect("dt") / level["stable_time_step"].as_f64().expect("s")
        };
        levels.iter().map(share).collect()
    };
    for (rule, share) in [("auto", 0.5), ("{courant: 0.5}", 0.5), ("{courant: \"1/4\"}", 0.25)] {
        for found in steps(rule) {
            assert!((found / share - 1.0).abs() < 0.01, "{rule}: {found}");
        }
    }
}

#[test]
fn instants_do_not_change_the_step() {
    let folder =
        Folder::with("bar.yaml", bar("dt: {courant: 0.3}").replace("until: 0.05", "until: 5"));
    let out = folder.accepted(&["steps", "bar.yaml"]);
    insta::assert_snapshot!(out, @"
    short-bar
      mpm-linear-flip-musl
        4 cells: 667 steps of 7.4963e-3 s, 0.9996 x 7.4993e-3 s, 50 instants
        6 cells: 1000 steps of 5.0000e-3 s, 1.0001 x 4.9995e-3 s, 50 instants
        8 cells: 1333 steps of 3.7509e-3 s, 1.0004 x 3.7496e-3 s, 50 instants
        12 cells: 2000 steps of 2.5000e-3 s, 1.0001 x 2.4998e-3 s, 50 instants
    4 levels: 0 with a step that differs from the requested step by more than 1 %
    ");
}

#[test]
fn rounded_step_of_a_short_run_is_reported() {
    let folder = Folder::new();
    let text = bar("dt: \"h/100\"").replace("until: 0.05", "until: 0.006");
    folder.write("bar.yaml", text.replace("verdict: failed", "order: [1.5, 2.4]"));
    let found = folder.call(&["steps", "bar.yaml"]).ended(FAILED);
    insta::assert_snapshot!(found.out, @"
    short-bar
      mpm-linear-flip-musl
        4 cells: 2 steps of 3.0000e-3 s, 1.2000 x 2.5000e-3 s, 2 instants  off
        6 cells: 4 steps of 1.5000e-3 s, 0.9000 x 1.6667e-3 s, 4 instants  off
        8 cells: 5 steps of 1.2000e-3 s, 0.9600 x 1.2500e-3 s, 5 instants  off
        12 cells: 7 steps of 8.5714e-4 s, 1.0286 x 8.3333e-4 s, 7 instants  off
    4 levels: 4 with a step that differs from the requested step by more than 1 %
    ");
    let document = folder.call(&["steps", "bar.yaml", "--format", "json"]).ended(FAILED).json();
    let level = &document["suites"][0]["levels"][0];
    assert_eq!((&level["dt"], &level["wanted"]), (&json!(0.003), &json!(0.0025)));
    let errors = folder.call(&["run", "bar.yaml"]).errors;
    let first = "warning: short-bar::mpm-linear-flip-musl, 4 cells: the run takes 2 steps of \
                 3.0000e-3 s, 1.200 times the stated step, because the stated step does not divide \
                 the run\n";
    assert!(errors.starts_with(first) && warnings(&errors).len() == 4, "{errors}");
}

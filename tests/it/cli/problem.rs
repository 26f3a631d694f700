//! `mpm-verify problem`: writes a level of a suite to a file.

use super::{BAR, Folder, refusals};
use serde_json::Value;

fn problem(arguments: &[&str]) -> String {
    let folder = Folder::with("bar.yaml", BAR);
    folder.accepted(&[&["problem", "bar.yaml"], arguments].concat())
}

/// Returns the numbers of one column of a table.
fn column(table: &str, name: &str) -> Vec<f64> {
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next().expect("a head");
    let at = head.iter().position(|known| *known == name).unwrap_or_else(|| panic!("{head:?}"));
    lines.map(|line| line[at].parse().expect("a number")).collect()
}

#[test]
fn a_level_is_a_table_of_its_particles() {
    let table = problem(&["--level", "1"]);
    let x = column(&table, "reference_position_x");
    assert_eq!(x.len(), 16);
    assert_eq!((x[0], x[1]), (0.03125, 0.09375));
    assert_eq!(column(&table, "position_x"), x);
    let v = column(&table, "velocity_x");
    assert!((v[0] - 1e-3 * libm::sin(std::f64::consts::FRAC_PI_2 * x[0])).abs() < 1e-18);
    assert!(column(&table, "mass").iter().all(|mass| *mass == 0.0625));
    assert!(column(&table, "deformation_gradient_xx").iter().all(|f| *f == 1.0));
    // The finest level by default.
    assert_eq!(problem(&[]).lines().count(), 1 + 48);
}

/// The exact state at a later time differs from the initial state.
#[test]
fn exact_state_agrees_with_the_formula() {
    let table = problem(&["--level", "2", "--at", "0.05"]);
    let omega = 5.0 * std::f64::consts::PI;
    let labels = column(&table, "reference_position_x");
    for (p, x) in column(&table, "position_x").iter().enumerate() {
        let k = std::f64::consts::FRAC_PI_2;
        let amplitude = 1e-3 / omega * libm::sin(omega * 0.05);
        let u = amplitude * libm::sin(k * labels[p]);
        assert!((x - labels[p] - u).abs() < 1e-16, "particle {p}");
        let strain = k * amplitude * libm::cos(k * labels[p]);
        assert!((column(&table, "stress_xx")[p] - 100.0 * strain).abs() < 1e-13, "particle {p}");
    }
}

#[test]
fn json_has_the_keys_of_the_protocol() {
    let document: Value = serde_json::from_str(&problem(&["--format", "json"])).expect("JSON");
    assert_eq!(document["grid"]["h"], 1.0 / 12.0);
    assert_eq!(document["faces"][0]["condition"], "fixed");
    assert_eq!(document["materials"][0]["parameters"]["young"], 100.0);
    assert_eq!(document["steps"], 50);
    assert_eq!(document["particles"]["mass"].as_array().map(Vec::len), Some(48));
}

#[test]
fn arrays_for_numpy_are_a_zip_file() {
    let folder = Folder::with("bar.yaml", BAR);
    let mut command = folder.command(&["problem", "bar.yaml", "--format", "npz"]);
    let bytes = command.output().expect("the program starts").stdout;
    assert!(bytes.starts_with(b"PK") && bytes.windows(8).any(|name| name == b"mass.npy"));
}

#[test]
fn unwritable_problem_is_refused() {
    let folder = Folder::with("bar.yaml", BAR);
    let text = refusals(
        &folder,
        &[
            "problem bar.yaml --level 9",
            "problem bar.yaml --level 0",
            "problem bar.yaml --format xls",
            "problem courant-limit",
            "problem heat-step --at 0.1",
        ],
    );
    insta::assert_snapshot!(text, @"
    problem bar.yaml --level 9
    error: short-bar: there is no level 9: expected 1 to 4
    problem bar.yaml --level 0
    error: short-bar: there is no level 0: expected 1 to 4
    problem bar.yaml --format xls
    error: invalid value 'xls' for '--format <FORMAT>': expected one of csv, json, npz, vtu
    problem courant-limit
    error: courant-limit: it is not a convergence study
    problem heat-step --at 0.1
    error: heat-step: the suite states no exact motion
    ");
}

//! `run --vtu`: writes cases as files for ParaView.

use super::{BAR, FAILED, Folder, SOUND, ambitious, assert_contains};
use crate::common::vtk::{attribute, numbers, parts};
use approx::assert_abs_diff_eq;
use serde_json::Value;
use std::fs;

/// Returns the series in the folder `vtu`.
fn series(folder: &Folder) -> Vec<String> {
    let mut names = Vec::new();
    for suite in fs::read_dir(folder.path().join("vtu")).expect("the folder of the series") {
        let suite = suite.expect("an entry").path();
        for entry in fs::read_dir(&suite).expect("the folder of a suite") {
            let path = entry.expect("an entry").path();
            if path.extension().is_some_and(|end| end == "pvd") {
                names.push(path.to_str().expect("a name").to_owned());
            }
        }
    }
    names.sort();
    names
}

/// Returns the files of the last instant of a series, particles first, and the time of this
/// instant.
fn last(series: &str) -> (Vec<Vec<u8>>, f64) {
    let list = fs::read_to_string(series).expect("the series");
    let time = |line: &str| attribute(line, "timestep").parse::<f64>().expect("a time");
    let lines: Vec<&str> = list.lines().filter(|line| line.starts_with("<DataSet")).collect();
    let end = time(lines[lines.len() - 1]);
    let folder = std::path::Path::new(series).parent().expect("a folder");
    let read = |line: &&str| fs::read(folder.join(attribute(line, "file"))).expect("a file");
    (lines.iter().filter(|line| time(line) == end).map(read).collect(), end)
}

/// The written errors must equal the judged ones.
#[test]
fn the_errors_of_the_particles_are_those_of_the_report() {
    let folder = Folder::with("bar.yaml", BAR);
    let arguments = ["run", "bar.yaml", "--case", "flip", "--vtu", "vtu", "--format", "json"];
    let found = folder.call(&arguments).ended(SOUND);
    let all = series(&folder);
    assert!(all.len() == 1 && all[0].ends_with("short-bar/mpm-linear-flip-musl.12-cells.pvd"));
    let (files, end) = last(&all[0]);
    let [particles, grid] = &files[..] else { panic!("{} files", files.len()) };
    assert_eq!(end, 0.05);
    let errors = numbers(particles, "error of displacement");
    let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
    let report: Value = serde_json::from_str(&found.out).expect("JSON");
    let levels = &report["suites"][0]["cases"][0]["levels"];
    let told = levels[3]["errors"]["rms"].as_f64().expect("a number");
    assert!((rms / told - 1.0).abs() < 1e-12, "{rms} of {told}");
    let mass = |file: &[u8]| numbers(file, "mass").iter().sum::<f64>();
    assert_abs_diff_eq!(mass(grid), 1.0, epsilon = 1e-12);
    assert_abs_diff_eq!(mass(particles), 1.0, epsilon = 1e-12);
}

#[test]
fn only_unexpected_results_are_written() {
    let folder = Folder::with("bars/short.yaml", BAR);
    folder.write("bars/ambitious.yaml", ambitious());
    let found = folder.call(&["run", "bars", "--brief", "--vtu", "vtu"]).ended(FAILED);
    let all = series(&folder);
    assert_eq!(all.len(), 2, "{all:?}");
    for series in &all {
        assert!(series.contains("/ambitious-bar/"), "{all:?}");
        let shown = series.split("vtu/").nth(1).expect("a path below the folder");
        assert_contains(&found.errors, &[shown]);
    }
    // FEM has no particles and no grid nodes, so its samples are written.
    let (files, _) = last(&all[0]);
    assert_eq!((files.len(), numbers(&files[0], "error of velocity").len() % 12), (1, 0));
}

/// The last frame must be the state at the failure, on the level that failed.
#[test]
fn failed_run_is_written_up_to_its_failure() {
    let folder = Folder::new();
    let case = "mpm-linear-apic-usl";
    let words = ["run", "finite-strain-crossing", "--case", case, "--brief", "--vtu", "vtu"];
    folder.call(&[&words[..], &["--out", "out"]].concat()).ended(SOUND);
    let all = series(&folder);
    let (files, end) = last(&all[0]);
    // A period is 0.02 s.
    assert!(end > 0.01 && end < 0.012, "{end}");
    let least = numbers(&files[0], "F").into_iter().fold(f64::INFINITY, f64::min);
    assert!(least <= 0.0, "{least}: nothing is inverted");
}

#[test]
fn study_without_runs_is_refused_with_the_reason() {
    let folder = Folder::new();
    let found = folder
        .call(&["run", "grid-crossing", "--case", "linear", "--brief", "--vtu", "v"])
        .ended(SOUND);
    insta::assert_snapshot!(found.errors, @"note: grid-crossing::mpm-linear: no output: its study has no runs to show");
}

#[test]
fn unwritable_folder_is_reported_before_the_run() {
    let folder = Folder::with("bar.yaml", BAR);
    folder.write("taken", "a file");
    let errors = folder.refused(&["run", "bar.yaml", "--case", "flip", "--vtu", "taken"]);
    assert!(errors.starts_with("error: --vtu "), "{errors}");
}

/// In 2-D vectors are extended to three components, and tensors to nine.
#[test]
fn a_problem_has_a_vertex_for_each_particle() {
    let folder = Folder::new();
    let mut command = folder.command(&[
        "problem",
        "mms-axis-aligned-2d-cubic",
        "--format",
        "vtu",
        "--level",
        "1",
    ]);
    let file = command.output().expect("the program starts").stdout;
    let n: usize = attribute(parts(&file).0, "NumberOfPoints").parse().expect("a number");
    assert_eq!(numbers(&file, "position").len(), 3 * n);
    assert_eq!(numbers(&file, "velocity").len(), 3 * n);
    let f = numbers(&file, "deformation_gradient");
    assert_eq!(f.len(), 9 * n);
    assert!(f[0] > 0.5 && f[4] > 0.5 && f[2] == 0.0 && f[8] == 0.0, "{:?}", &f[..9]);
}

//! `run --vtu`: writes cases as files for ParaView.

use super::{BAR, FAILED, Folder, SOUND, ambitious, assert_contains};
use crate::common::vtk::{attribute, numbers};
use std::fs;

/// Returns the paths of the series in the folder `vtu`.
fn series(folder: &Folder) -> Vec<String> {
    let suites = folder.files("vtu").into_iter().map(|suite| format!("vtu/{suite}"));
    let files = suites.flat_map(|suite| {
        folder.files(&suite).into_iter().map(move |file| format!("{suite}/{file}"))
    });
    let series = files.filter(|file| file.rsplit('.').next() == Some("pvd"));
    series.map(|file| folder.path().join(file).display().to_string()).collect()
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

#[test]
fn finest_level_of_a_chosen_case_is_written() {
    let folder = Folder::with("bar.yaml", BAR);
    folder.call(&["run", "bar.yaml", "--case", "flip", "--vtu", "vtu"]).ended(SOUND);
    let all = series(&folder);
    assert!(all.len() == 1 && all[0].ends_with("short-bar/mpm-linear-flip-musl.12-cells.pvd"));
    let (files, end) = last(&all[0]);
    let mass = |file: &Vec<u8>| numbers(file, "mass").iter().sum::<f64>();
    assert_eq!((files.len(), end), (2, 0.05), "particles and grid");
    assert!(files.iter().all(|file| (mass(file) - 1.0).abs() < 1e-12));
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

//! A run that is killed in the middle of a level, and goes on there.

use super::Folder;
use super::{BAR, SOUND, assert_contains};
use std::fs;
use std::path::PathBuf;
use std::process::Stdio;
use std::time::{Duration, Instant};

/// One level of fifty thousand steps, too few for a state to be kept unless that is asked for.
fn long() -> String {
    BAR.replace("dt: 1e-3", "dt: 1e-6")
        .replace("cells: [4, 6, 8, 12]", "cells: 12")
        .replace("  - fem: {element: linear, mass: lumped}\n", "")
        .replace("order: [1.7, 2.3]", "error_below: 1e-3")
}

/// Paths of the files of that kind among what is kept.
fn kept(folder: &Folder, kind: &str) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder.path().join("kept")) else { return Vec::new() };
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    paths.filter(|path| path.extension().is_some_and(|end| end == kind)).collect()
}

/// Kills a run as soon as it has kept a state; it keeps one after each step, which takes far longer
/// than the steps themselves.
fn killed(folder: &Folder) -> PathBuf {
    let every_step = ["--resume", "kept", "--checkpoint-every", "1e-6ms"];
    let mut command = folder.command(&[&["run", "bar.yaml"][..], &every_step].concat());
    let mut child = command.stdout(Stdio::null()).spawn().expect("the program starts");
    let start = Instant::now();
    while kept(folder, "checkpoint").is_empty() {
        assert!(start.elapsed() < Duration::from_secs(60), "no state is kept");
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().expect("it runs");
    child.wait().expect("an end");
    assert_eq!(kept(folder, "level"), [] as [PathBuf; 0], "it was in the middle of its only level");
    kept(folder, "checkpoint").remove(0)
}

/// The run prints, writes and keeps the same bytes, and leaves nothing else. So it does if the
/// state has been torn, or is that of another level; then it says so, and starts anew.
#[test]
fn a_level_that_was_killed_goes_on_where_it_was() {
    let folder = Folder::with("bar.yaml", long());
    let plain = folder.call(&["run", "bar.yaml", "--resume", "whole", "--out", "plain"]);
    assert_eq!((plain.code, plain.errors.as_str()), (SOUND, ""));
    let checkpoint = killed(&folder);
    let state = fs::read(&checkpoint).expect("a state");
    let mut changed = state.clone();
    changed[state.len() / 2] ^= 1;
    let half = state[..state.len() / 2].to_vec();
    let level = "short-bar::mpm-linear-flip-musl, 12 cells, dt = 0.000001";
    let torn = "its checkpoint is torn; the level starts anew";
    for (left, said) in [(state, "goes on after step "), (changed, torn), (half, torn)] {
        for path in kept(&folder, "level") {
            fs::remove_file(path).expect("a level");
        }
        fs::write(&checkpoint, left).expect("a state");
        let resumed = folder.call(&["run", "bar.yaml", "--resume", "kept", "--out", "resumed"]);
        assert_eq!((resumed.code, &resumed.out), (SOUND, &plain.out));
        let told = format!("note: {level}: {said}");
        assert!(resumed.errors.starts_with(&told), "{}", resumed.errors);
        assert_eq!(resumed.errors.lines().count(), 1, "{}", resumed.errors);
        for (one, other) in [("plain", "resumed"), ("whole", "kept")] {
            assert_eq!(folder.files(one), folder.files(other));
            for file in folder.files(one) {
                let [a, b] = [one, other].map(|place| folder.read(&format!("{place}/{file}")));
                assert_eq!(a, b, "{file}");
            }
        }
    }
}

/// The state is that of another suite: it is left alone.
#[test]
fn a_state_of_another_suite_is_not_taken() {
    let folder = Folder::with("bar.yaml", long());
    let checkpoint = killed(&folder);
    folder.write("bar.yaml", BAR);
    let plain = folder.call(&["run", "bar.yaml"]);
    let changed = folder.call(&["run", "bar.yaml", "--resume", "kept"]);
    assert_eq!((changed.code, &changed.out, changed.errors.as_str()), (SOUND, &plain.out, ""));
    assert!(checkpoint.exists());
}

#[test]
fn how_often_states_are_kept_is_a_time_beside_a_folder() {
    let folder = Folder::with("bar.yaml", BAR);
    for (arguments, words) in [
        (&["--checkpoint-every", "1s"][..], "--resume"),
        (&["--resume", "kept", "--checkpoint-every", "soon"], "expected a time with its unit"),
        (&["--resume", "kept", "--checkpoint-every", "0s"], "--checkpoint-every"),
        (&["--resume", "kept", "--checkpoint-every", "1e300h"], "--checkpoint-every"),
    ] {
        let errors = folder.refused(&[&["run", "bar.yaml"][..], arguments].concat());
        assert_contains(&errors, &[words]);
    }
}

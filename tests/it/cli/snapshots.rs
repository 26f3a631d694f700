//! `run --snapshots` and `accept`: snapshots without Rust.

use super::{BAD_INPUT, BAR, FAILED, Folder, SOUND, ambitious, assert_contains};

#[test]
fn changed_report_is_written_and_accepted() {
    let folder = Folder::with("bar.yaml", BAR);
    let run = ["run", "bar.yaml", "--snapshots", "--brief"];
    // There is no snapshot yet.
    let first = folder.call(&run).ended(FAILED);
    assert_contains(&first.out, &["+++ short-bar.snap.new", "\n1 changed report; `mpm-verify acc"]);
    assert_contains(&folder.accepted(&["accept"]), &["short-bar.snap\n1 snapshot accepted\n"]);
    assert_eq!(folder.call(&run).code, SOUND);
    folder.write("bar.yaml", BAR.replace("title: Short bar", "title: Long bar"));
    let changed = folder.call(&run).ended(FAILED);
    assert_contains(&changed.out, &["\n-short-bar: Short bar\n+short-bar: Long bar\n"]);
    let json = folder.call(&["run", "bar.yaml", "--snapshots", "--format", "json"]);
    assert!(serde_json::from_str::<serde_json::Value>(&json.out).is_ok(), "{}", json.out);
    assert_contains(&json.errors, &["+short-bar: Long bar\n", "1 changed report"]);
    assert_contains(&folder.accepted(&["accept", "."]), &["1 snapshot accepted"]);
    assert_contains(&folder.accepted(&["accept"]), &["0 snapshots accepted\nnext: mpm-verify"]);
}

/// A failed comparison with theory cannot be accepted.
#[test]
fn report_of_a_failing_case_is_not_written() {
    let folder = Folder::with("bar.yaml", ambitious());
    let found = folder.call(&["run", "bar.yaml", "--snapshots", "--brief"]).ended(FAILED);
    assert_contains(&found.out, &["ambitious-bar.snap.new is not written, because a case fails\n"]);
    assert_contains(&folder.accepted(&["accept"]), &["0 snapshots accepted"]);
}

/// The test harness for Rust has written the snapshot.
#[test]
fn files_are_those_of_the_test_harness() {
    let suite = concat!(env!("CARGO_MANIFEST_DIR"), "/verification/the-talk/grid-crossing.yaml");
    let found = Folder::new().call(&["run", suite, "--snapshots", "-q"]);
    assert_eq!((found.code, found.out.as_str()), (SOUND, ""));
}

#[test]
fn built_in_suite_needs_a_folder_for_its_snapshot() {
    let folder = Folder::new();
    let found = folder.call(&["run", "grid-crossing", "--snapshots"]).ended(BAD_INPUT);
    assert_contains(&found.errors, &["grid-crossing is in no folder\nhelp: --snapshots=DIR"]);
    folder.call(&["run", "grid-crossing", "--snapshots=kept", "-q"]).ended(FAILED);
    assert_contains(&folder.accepted(&["accept", "kept"]), &["1 snapshot accepted"]);
    let missing = folder.call(&["accept", "absent"]).ended(BAD_INPUT);
    assert_contains(&missing.errors, &["absent: expected a folder or a file SUITE.snap.new"]);
}

//! `compare`: the changes between two runs, and the exit status.

use super::{BAD_INPUT, BAR, FAILED, Folder, SOUND, assert_contains};
use rstest::rstest;

/// Runs the steps of the CI action that compare and comment, with a mock `gh` that returns the
/// reports of the last run and stores the comment. The new error is twice the old one.
#[cfg(unix)]
#[test]
fn workflow_comments_the_changes() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::with("bar.yaml", BAR);
    let old = folder.accepted(&["run", "bar.yaml", "--format", "json"]);
    let mut document: serde_json::Value = serde_json::from_str(&old).expect("JSON");
    folder.write("old.json", old);
    let error = &mut document["suites"][0]["cases"][0]["levels"][3]["judged"];
    *error = serde_json::json!(2.0 * error.as_f64().expect("an error"));
    folder.write("new.json", document.to_string());
    let text = include_str!("../../../examples/ci/action.yml");
    let action: serde_json::Value = serde_yaml::from_str(text).expect("YAML");
    let steps = action["runs"]["steps"].as_array().expect("steps");
    let script_of = |name: &str| {
        let step = steps.iter().find(|step| step["name"] == name);
        step.and_then(|step| step["run"].as_str()).expect("a script of that name")
    };
    for (name, file) in [
        ("Fetch the reports of the main branch", "fetch"),
        ("Compare with the main branch", "compare"),
        ("Comment on the pull request", "comment"),
    ] {
        folder.write(file, script_of(name));
    }
    folder.write(
        "bin/gh",
        "#!/bin/sh\ncase $1-$2 in\nrun-list) echo 7;;\n\
         run-download) mkdir before; cp ../old.json before/report.json;;\n\
         pr-comment) cp comment.md ..;;\nesac\n",
    );
    let program = folder.path().join("bin/gh");
    std::fs::set_permissions(&program, PermissionsExt::from_mode(0o755)).expect("a program");
    let own = env!("CARGO_BIN_EXE_mpm-verify");
    std::os::unix::fs::symlink(own, program.with_file_name("mpm-verify")).expect("a program");
    let script = "set -e; mkdir here; cd here; mkdir reports; cp ../new.json reports/report.json; \
        for step in fetch compare comment; do bash -eo pipefail ../$step; done";
    let path = std::env::var("PATH").unwrap_or_default();
    let path = format!("{}:{path}", folder.path().join("bin").display());
    let ran = std::process::Command::new("bash")
        .args(["-c", script])
        .current_dir(folder.path())
        .envs([
            ("PATH", path.as_str()),
            ("WORKFLOW", "Accuracy"),
            ("MAIN", "main"),
            ("ARTIFACT", "mpm-verify-reports"),
            ("GITHUB_STEP_SUMMARY", "summary.md"),
            ("GITHUB_REPOSITORY", "someone/solver"),
            ("PULL", "12"),
        ])
        .output()
        .expect("bash");
    assert!(ran.status.success(), "{ran:?}");
    let comment = folder.read("comment.md");
    assert!(comment.starts_with("```text\nworse: 1 less accurate"), "{comment}");
}

#[rstest]
#[case::missing("nix.json", None, "this file cannot be read: ")]
#[case::a_folder(".", None, "the folder `.` has neither report.json nor OVERVIEW.snap")]
#[case::not_json("bad.json", Some("verdicts"), "bad.json:1:1")]
#[case::another_document("bad.json", Some("{\"levels\": []}"), "missing field `suites`")]
#[case::a_wrong_type("bad.json", Some("{\n  \"suites\": 3\n}"), "bad.json:2:13")]
#[case::not_text("bad.json", Some("\u{feff}"), "expected the document that `mpm-verify run")]
fn a_file_that_cannot_be_used(#[case] name: &str, #[case] text: Option<&str>, #[case] words: &str) {
    let folder = Folder::with("good.json", "{\"suites\": []}");
    if let Some(text) = text {
        folder.write(name, text);
    }
    for files in [[name, "good.json"], ["good.json", name]] {
        let errors = folder.refused(&["compare", files[0], files[1]]);
        assert_contains(&errors, &[words]);
    }
    assert_eq!(folder.call(&["compare", "good.json", "good.json"]).code, SOUND);
}

const OVERVIEW: &str = "---\nsource: a\n---\nOverview of all suites\n\n  result        2 pass\n\n\
    \x20 suite  linear\nbars\n  bar      1.99\n";

const REPORT: &str = "---\nsource: a\n---\nbar: A bar\n\n\
    \x20 case                 result  verdict     order  95 % interval      error  floor\n\
    \x20 mpm-flip-{usl,musl}  pass    converging   1.99  [1.95, 2.03]   1.000e-04  -\n\n\
    \x20 source        a book\n\
    \x20 problem\n\
    \x20   parameters           E = 100\n\
    \x20   body                 (0) to (1) m\n\
    \x20   left                 fixed\n\
    \x20   dt                   the stable step, or\n\
    \x20                        0.1*h/c\n\
    \x20 methods\n\
    \x20   until                t = 1 s\n";

fn snapshots(report: &str) -> Folder {
    let folder = Folder::new();
    for (name, report) in [("old", REPORT), ("new", report)] {
        folder.write(&format!("{name}/OVERVIEW.snap"), OVERVIEW);
        folder.write(&format!("{name}/bars/bar.snap"), report);
    }
    folder
}

#[test]
fn changes_of_snapshots_are_listed() {
    let out = snapshots(REPORT).accepted(&["compare", "old", "new"]);
    insta::assert_snapshot!(out, @"
    nothing worse: 2 unchanged

    Values count as equal within a relative difference of 0.001.
    ");
    let worse = REPORT.replace("1.000e-04", "2.000e-04");
    let found = snapshots(&worse).call(&["compare", "old", "new"]).ended(FAILED);
    insta::assert_snapshot!(found.out, @"
    worse: 2 less accurate

    less accurate
      case                verdict         order                 error   times                at
      bar::mpm-flip-usl   converging       1.99  1.000e-4 -> 2.000e-4  2.00 x  the finest level
      bar::mpm-flip-musl  converging       1.99  1.000e-4 -> 2.000e-4  2.00 x  the finest level

    Values count as equal within a relative difference of 0.001.
    ");
    let tolerant = ["compare", "old", "new", "--tolerance", "10"];
    snapshots(&worse).call(&tolerant).ended(SOUND);
    let failing = REPORT.replace("  pass", "  FAIL");
    let found = snapshots(&failing).call(&["compare", "old", "new"]);
    let row = "  bar::mpm-flip-usl   converging -> converging (FAIL)   1.99\n";
    assert_contains(&found.out, &["worse: 2 newly failing\n", row]);
}

#[test]
fn changed_problem_is_not_reported_as_worse() {
    let worse = REPORT.replace("1.000e-04", "2.000e-04");
    let stiffer = worse.replace("E = 100", "E = 101").replace("  fixed", "  roller");
    let found = snapshots(&stiffer).call(&["compare", "old", "new"]).ended(SOUND);
    let changes = "changed problem: errors and orders are not compared\n  \
                   bar: parameters E = 100 -> E = 101\n  bar: left fixed -> roller\n";
    let row = "  bar::mpm-flip-usl   converging       1.99\n";
    assert_contains(&found.out, &["nothing worse: 2 with a changed problem\n", changes, row]);
    let finer = worse.replace("0.1*h/c", "0.05*h/c");
    // Time steps are not part of the problem.
    snapshots(&finer).call(&["compare", "old", "new"]).ended(FAILED);
}

#[test]
fn missing_inputs_are_named() {
    let folder = snapshots(REPORT);
    let missing = "`older` is neither a file, nor a folder, nor a commit with snapshots";
    assert_contains(&folder.refused(&["compare", "older", "new"]), &[missing]);
    assert_contains(&folder.refused(&["compare", "a.json", "b.json"]), &["a.json", "b.json"]);
}

/// Snapshots contain the finest level only.
#[test]
fn a_run_is_not_compared_with_snapshots() {
    let folder = snapshots(REPORT);
    folder.write("run/report.json", "{\"suites\": []}");
    let found = folder.call(&["compare", "old", "run"]).ended(BAD_INPUT);
    insta::assert_snapshot!(found.errors, @"
    error: `old` and `run` are the results of a run and snapshots, which have different figures
    help: compare two runs (JSON), or two sets of snapshots (folders or commits)
    ");
    assert_eq!(folder.call(&["compare", "run", "run/report.json"]).code, SOUND);
}

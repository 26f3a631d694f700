//! `run`: reports, verdicts, files, and the exit status for scripts.

use super::{
    BAD_INPUT, BAR, FAILED, Folder, SOUND, ambitious, assert_contains, mistaken, without_files,
};
use crate::common::folder::flat;
use std::io::{BufRead, BufReader, Read};
use std::process::Stdio;

#[test]
fn run_is_the_default_command() {
    let folder = Folder::new();
    assert_eq!(folder.call(&["grid-crossing"]).out, folder.call(&["run", "grid-crossing"]).out);
}

#[test]
fn brief_omits_reports() {
    let found = Folder::new().call(&["run", "--brief", "grid-crossing"]);
    assert_eq!((found.code, found.out.lines().count()), (SOUND, 14));
    assert_contains(&found.out, &["  pass  grid-crossing::mpm-linear  "]);
}

/// The entry of a case is found by its pattern and its reason, in lists of patterns too.
#[test]
fn violated_expectation_points_at_its_entry() {
    let (suite, _) = BAR.split_once("expect:").expect("expectations");
    let expect = "expect:\n  - case: 'mpm-*'\n    because: theory\n    order: [2.9, 3.1]\n  \
                  - case: ['fem-*']\n    because: theory\n    verdict: divergent\n";
    let folder = Folder::with("bar.yaml", format!("{suite}{expect}").replace("short", "long"));
    let found = folder.call(&["run", "bar.yaml", "--brief"]).ended(FAILED);
    let line = suite.lines().count() + 4;
    let (first, second) = (format!("bar.yaml:{line}:5"), format!("bar.yaml:{}:5", line + 3));
    assert_contains(
        &flat(&found.out),
        &[
            "error[order-too-low]: long-bar::mpm-linear-flip-musl: expected the verdict",
            &first,
            "error[limit-gone]: long-bar::fem-linear-lumped: expected the verdict `divergent`",
            &second,
            "next: mpm-verify diagnose bar.yaml --case fem-linear-lumped; mpm-verify explain ",
        ],
    );
    let github = folder.call(&["run", "bar.yaml", "-q", "--format", "github"]).out;
    let annotation =
        format!("::error file=bar.yaml,line={line},col=5,title=order-too-low::long-bar");
    // The escaped line break precedes the help.
    let help = "%0Anext: mpm-verify diagnose bar.yaml --case mpm-linear-flip-musl; ";
    assert_contains(&github, &[&annotation, help]);
    // The output of other formats is for programs, so people read diagnostics on standard error.
    let json = folder.call(&["run", "bar.yaml", "--format", "json"]);
    assert!(json.out.starts_with('{') && json.out.contains("\"order-too-low\""), "{}", json.out);
    assert_contains(&json.errors, &["error[order-too-low]: ", &first]);
}

#[test]
fn invalid_file_does_not_suppress_other_reports() {
    let folder = Folder::with("bad.yaml", mistaken());
    folder.write("good.yaml", BAR);
    let found = folder.call(&["run", "bad.yaml", "good.yaml", "odometer"]).ended(BAD_INPUT);
    assert_contains(&found.out, &["  fem-linear-lumped  ", "  mpm-linear-flip-musl  pass "]);
    let messages = ["error: unknown key `dimensions`\n --> bad.yaml:9:3\n", "called `odometer`\n"];
    assert_contains(&found.errors, &messages);
}

#[test]
fn one_thread_and_two_give_the_same_bytes() {
    let folder = Folder::with("bar.yaml", BAR);
    let run = |jobs: &str| {
        let arguments = ["run", "bar.yaml", "steffen-bar-small-load", "--jobs", jobs];
        without_files(&folder.accepted(&[&arguments[..], &["--out", jobs]].concat()))
    };
    assert_eq!(run("1"), run("2"));
    let files = folder.files("1");
    // One of the files contains the document of `--format json`.
    assert!(files.contains(&"report.json".to_owned()), "{files:?}");
    assert_eq!(files, folder.files("2"));
    for file in files {
        let read = |jobs: &str| folder.read(&format!("{jobs}/{file}"));
        assert!(read("1") == read("2"), "{file}");
    }
}

#[test]
fn closed_pipe_does_not_panic() {
    // There are so many suites that most remain to be printed when the reader closes the pipe.
    let folder = Folder::new();
    for number in 0..40 {
        let suite = BAR.replace("short-bar", &format!("bar-{number}"));
        folder.write(&format!("verification/{number}.yaml"), suite);
    }
    for arguments in [&["run"][..], &["list"], &["explain", "oedometer"], &["check"]] {
        let mut command = folder.command(arguments);
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("the program starts");
        let mut lines = BufReader::new(child.stdout.take().expect("a pipe"));
        lines.read_line(&mut String::new()).expect("a first line");
        drop(lines);
        let mut errors = String::new();
        child.stderr.take().expect("a pipe").read_to_string(&mut errors).expect("UTF-8");
        let status = child.wait().expect("an end");
        assert_eq!(status.code(), Some(SOUND), "{arguments:?}");
        assert!(!errors.contains("panicked") && !errors.contains("error:"), "{errors}");
    }
}

#[test]
fn pipe_closed_before_the_run_does_not_panic() {
    let folder = Folder::new();
    let mut command = folder.command(&["run", "grid-crossing", "--format", "json"]);
    let mut child = command.stdout(Stdio::piped()).spawn().expect("the program starts");
    drop(child.stdout.take());
    assert_eq!(child.wait().expect("an end").code(), Some(SOUND));
    assert!(folder.path().is_dir());
}

/// The first two levels are stored, one of them truncated. Text, JSON and drawings equal those of
/// an uninterrupted run. A path that is not a folder is bad input.
#[test]
fn a_resumed_run_prints_the_same_bytes() {
    let folder = Folder::with("bar.yaml", BAR);
    let mut plain = folder.call(&["run", "bar.yaml", "--out", "plain"]);
    plain.out = without_files(&plain.out);
    let first = folder.call(&["run", "bar.yaml", "--resume", "kept"]);
    assert_eq!((first.code, &first.out), (SOUND, &plain.out));
    let kept = folder.files("kept");
    assert_eq!(kept.len(), 8, "four levels of two cases");
    let whole = folder.read(&format!("kept/{}", kept[1]));
    folder.write(&format!("kept/{}", kept[1]), &whole[..whole.len() / 2]);
    for gone in &kept[2..] {
        folder.write(&format!("kept/{gone}"), "");
    }
    let resumed = folder.call(&["run", "bar.yaml", "--resume", "kept", "--out", "resumed"]);
    assert_eq!((resumed.code, &without_files(&resumed.out)), (SOUND, &plain.out));
    assert_eq!(folder.files("kept"), kept);
    assert_eq!(folder.read(&format!("kept/{}", kept[1])), whole);
    for file in folder.files("plain") {
        assert_eq!(folder.read(&format!("plain/{file}")), folder.read(&format!("resumed/{file}")));
    }
    let none = folder.call(&["run", "bar.yaml", "--resume", "bar.yaml"]).ended(BAD_INPUT);
    assert_contains(&none.errors, &["--resume bar.yaml"]);
}

/// Cached levels are marked. They must be read back instead of being run again.
#[test]
fn stored_level_is_used_only_for_the_same_suite() {
    let folder = Folder::with("bar.yaml", BAR);
    folder.call(&["run", "bar.yaml", "--resume", "kept"]);
    for kept in folder.files("kept") {
        let text = folder.read(&format!("kept/{kept}"));
        let marked = text.replace("failure: null", "failure: marked");
        assert_ne!(text, marked);
        folder.write(&format!("kept/{kept}"), marked);
    }
    let marked = folder.call(&["run", "bar.yaml", "--resume", "kept"]);
    assert_contains(&marked.out, &["marked"]);
    folder.write("bar.yaml", BAR.replace("until: 0.05", "until: 0.06"));
    let changed = folder.call(&["run", "bar.yaml", "--resume", "kept"]);
    assert!(!changed.out.contains("marked"), "{}", changed.out);
}

#[test]
fn diagnose_requires_a_suite() {
    let found = Folder::new().call(&["diagnose"]);
    assert_eq!((found.code, found.out.as_str()), (BAD_INPUT, ""));
    assert_contains(&found.errors, &["error: expected a suite", "help: `mpm-verify diagnose "]);
}

#[test]
fn failed_cases_run_again() {
    let folder = Folder::with("bar.yaml", BAR);
    folder.write("open.yaml", ambitious());
    let none = folder.call(&["run", "bar.yaml", "--last-failed"]).ended(BAD_INPUT);
    assert_contains(&none.errors, &["--last-failed: no case of the last run in this folder fail"]);
    let both = ["run", "bar.yaml", "open.yaml", "--brief"];
    assert_eq!(folder.call(&both).code, FAILED);
    let again = folder.call(&[&both[..], &["--last-failed"]].concat()).ended(FAILED);
    assert_contains(&again.out, &["1 suite, 2 cases: 2 FAIL\n"]);
    assert_eq!(folder.call(&["run", "bar.yaml", "-q"]).code, SOUND);
    assert_eq!(folder.call(&[&both[..], &["--last-failed"]].concat()).code, BAD_INPUT);
}

#[test]
fn fail_fast_starts_no_further_suite() {
    let folder = Folder::with("a.yaml", ambitious());
    folder.write("b.yaml", BAR);
    let arguments = ["run", "a.yaml", "b.yaml", "--jobs", "1", "--brief"];
    assert_contains(&folder.call(&arguments).out, &["2 suites, 4 cases: "]);
    let found = folder.call(&[&arguments[..], &["--fail-fast"]].concat()).ended(FAILED);
    assert!(!found.out.contains("short-bar::"), "{}", found.out);
    let parts = ["note: a case failed, so 1 suite did not start (--fail-fast)"];
    assert_contains(&found.errors, &parts);
}

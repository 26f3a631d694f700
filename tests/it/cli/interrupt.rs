//! Ctrl-C during a run.

use super::{BAR, Folder, assert_contains};
use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};

/// Exit status of a run that was ended by Ctrl-C.
const INTERRUPTED: i32 = 130;

#[cfg(unix)]
#[test]
fn interrupted_run_prints_how_to_resume() {
    let folder = Folder::with("first.yaml", BAR.replace("short-bar", "first"));
    let long = BAR.replace("until: 0.05, dt: 1e-3", "until: 0.05, dt: 1e-9");
    folder.write("long.yaml", long);
    for (more, words) in [
        (
            &[][..],
            "interrupted, and no results are stored: with a folder for results, `mpm-verify run",
        ),
        (&["--resume", "kept"], "long.yaml --resume kept` resumes the run"),
    ] {
        let mut command = folder.command(&[&["run", "first.yaml", "long.yaml"], more].concat());
        let mut child =
            command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("a program");
        // When the first suite has been printed, the second one is running.
        let mut lines = BufReader::new(child.stdout.take().expect("a pipe"));
        lines.read_line(&mut String::new()).expect("a first line");
        let id = child.id().to_string();
        assert!(Command::new("kill").args(["-INT", &id]).status().expect("kill").success());
        let mut errors = String::new();
        child.stderr.take().expect("a pipe").read_to_string(&mut errors).expect("UTF-8");
        assert_eq!(child.wait().expect("an end").code(), Some(INTERRUPTED), "{errors}");
        assert_contains(&errors, &[words]);
    }
}

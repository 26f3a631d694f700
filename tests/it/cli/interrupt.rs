//! Ctrl-C during a run.

use super::{BAR, Folder, assert_contains};
use crate::external::misbehaving::script;
use std::io::Read;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// Exit status of a run that was ended by Ctrl-C.
const INTERRUPTED: i32 = 130;

#[test]
fn interrupted_run_prints_how_to_resume() {
    // The solver does not end its first step. Its file shows that the run has begun.
    let script = script("touch running\ncat > discarded");
    let resume = "run bar.yaml --solver 'sh solver.sh' --resume kept` resumes the run";
    let advice = "no results are stored: with a folder for results, `mpm-verify run";
    for (more, words) in [(&[][..], advice), (&["--resume", "kept"], resume)] {
        let folder = Folder::with("bar.yaml", BAR);
        let running = folder.write("solver.sh", &script).with_file_name("running");
        let arguments = ["run", "bar.yaml", "--solver", "sh solver.sh"];
        let mut command = folder.command(&[&arguments, more].concat());
        let mut child =
            command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("a program");
        while !running.exists() {
            assert_eq!(child.try_wait().expect("a state"), None);
            sleep(Duration::from_millis(5));
        }
        let id = child.id().to_string();
        assert!(Command::new("kill").args(["-INT", &id]).status().expect("kill").success());
        let mut errors = String::new();
        child.stderr.take().expect("a pipe").read_to_string(&mut errors).expect("UTF-8");
        assert_eq!(child.wait().expect("an end").code(), Some(INTERRUPTED), "{errors}");
        assert_contains(&errors, &[words]);
    }
}

//! `--watch`: the same once more whenever a file changes.

use super::{BAD_INPUT, BAR, Folder, mistaken};
use rstest::rstest;
use std::io::{BufRead, BufReader, Read};
use std::process::{Child, Stdio};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::Duration;

/// A program that runs until its test ends.
struct Running {
    child: Child,
    /// Lines of both of its outputs.
    lines: Receiver<String>,
}

impl Running {
    fn new(folder: &Folder, arguments: &[&str]) -> Self {
        let mut command = folder.command(arguments);
        let mut child =
            command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("a program");
        let (sender, lines) = channel();
        read(child.stdout.take().expect("its output"), sender.clone());
        read(child.stderr.take().expect("its complaints"), sender);
        Self { child, lines }
    }

    /// Waits for a line with each of `words`, in any order: they may come by either output.
    fn wait_for(&self, words: &[&str]) {
        let mut missing = words.to_vec();
        while !missing.is_empty() {
            let line = self.lines.recv_timeout(Duration::from_secs(120));
            let line = line.unwrap_or_else(|_| panic!("no {missing:?}"));
            missing.retain(|words| !line.contains(words));
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn read(output: impl Read + Send + 'static, sender: Sender<String>) {
    thread::spawn(move || {
        let lines = BufReader::new(output).lines().map_while(Result::ok);
        lines.take_while(|line| sender.send(line.clone()).is_ok()).count()
    });
}

/// A second run with a number of threads would fail if it made them again.
#[test]
fn a_run_is_repeated_when_its_file_changes() {
    let folder = Folder::new();
    folder.write("bar.yaml", BAR);
    let running = Running::new(&folder, &["run", "--brief", "--watch", "--jobs", "1", "bar.yaml"]);
    let watching = "watching bar.yaml; Ctrl-C ends it";
    let changed = "changed: bar.yaml";
    running.wait_for(&["  pass  short-bar::fem-linear-lumped", watching]);
    folder.write("bar.yaml", mistaken());
    running.wait_for(&[changed, "unknown key `dimensions`", watching]);
    folder.write("bar.yaml", BAR.replace("short-bar", "longer-name"));
    running.wait_for(&[changed, "  pass  longer-name::fem-linear-lumped", watching]);
}

#[test]
fn a_check_is_repeated_and_a_file_may_come_later() {
    let folder = Folder::new();
    let running = Running::new(&folder, &["check", "--watch", "bar.yaml"]);
    running.wait_for(&["there is no such file", "watching bar.yaml; Ctrl-C ends it"]);
    folder.write("bar.yaml", BAR);
    running.wait_for(&["changed: bar.yaml", "short-bar: sound, 2 cases"]);
}

#[rstest]
#[case::built_in(&["oedometer"], "`oedometer` is built in: there is no file to watch")]
#[case::everything_built_in(&[], "there is no folder `verification/` to watch")]
#[case::misspelt(&["odometer"], "did you mean `oedometer`?")]
fn what_is_no_file_is_not_watched(
    #[values("run", "check")] command: &str,
    #[case] targets: &[&str],
    #[case] message: &str,
) {
    let found = Folder::new().call(&[&[command, "--watch"], targets].concat());
    assert_eq!((found.code, found.out.as_str()), (BAD_INPUT, ""));
    assert!(found.errors.contains(message), "{}", found.errors);
}

//! Standard output and standard error. All commands print through this module, which records the
//! first failed write. Only terminals get colours.

use anstyle::{AnsiColor, Style};
use mpm_verify::suite::yaml::Diagnostic;
use std::fmt::Display;
use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;
use std::sync::OnceLock;
use thiserror::Error;

static FAILURE: OnceLock<String> = OnceLock::new();

/// Prints to standard output, in colour if it is a terminal.
pub(super) fn print(text: &str) {
    let painted = painted(text);
    note(anstream::stdout().lock(), painted.as_bytes());
}

pub(super) fn print_bytes(bytes: &[u8]) {
    note(io::stdout().lock(), bytes);
}

/// Prints the last lines of a command: commands that help now, with their purposes.
pub(super) fn next<'a>(commands: impl IntoIterator<Item = (&'a str, &'a str)>) {
    for (k, (command, purpose)) in commands.into_iter().enumerate() {
        let key = if k == 0 { "next:" } else { "" };
        let line = format!("{key:5} mpm-verify {command:40} {purpose}");
        print(&format!("{}\n", line.trim_end()));
    }
}

/// Returns a message about the first failure to print; `None` without a failure.
pub(super) fn failure() -> Option<&'static str> {
    FAILURE.get().map(String::as_str)
}

pub(super) fn complain(text: &str) {
    let _ = writeln!(anstream::stderr().lock(), "{}", painted(text.trim_end()));
}

pub(super) fn diagnose(diagnostic: &Diagnostic) {
    complain(&diagnostic.styled());
}

/// Records the result of a write. A reader that closes the pipe (`| head`) is no failure.
pub(super) fn keep(outcome: io::Result<()>) {
    if let Err(error) = outcome
        && error.kind() != ErrorKind::BrokenPipe
    {
        FAILURE.get_or_init(|| format!("error: standard output cannot be written: {error}"));
    }
}

fn note(mut out: impl Write, bytes: &[u8]) {
    keep(out.write_all(bytes).and_then(|()| out.flush()));
}

const BAD: Style = AnsiColor::Red.on_default().bold();
const DOUBTFUL: Style = AnsiColor::Yellow.on_default().bold();
const GOOD: Style = AnsiColor::Green.on_default();
const REMARK: Style = AnsiColor::Cyan.on_default().bold();

/// Line beginnings (after leading spaces) that are coloured, with their styles.
const FIRST: [(&str, Style); 8] = [
    ("error:", BAD),
    ("warning:", DOUBTFUL),
    ("note:", REMARK),
    ("help:", REMARK),
    ("FAIL ", BAD),
    ("pass ", GOOD),
    ("known limit ", GOOD),
    ("not applicable ", DOUBTFUL),
];

fn painted(text: &str) -> String {
    text.split_inclusive('\n').map(line).collect()
}

fn line(line: &str) -> String {
    let start = line.len() - line.trim_start().len();
    let (space, rest) = line.split_at(start);
    for (word, style) in FIRST {
        if let Some(after) = rest.strip_prefix(word) {
            return format!("{space}{style}{word}{style:#}{after}");
        }
    }
    line.to_owned()
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Status {
    /// No case fails; in a comparison, nothing has become worse.
    Passed = 0,
    /// An expectation is not met; in a comparison, something has become worse.
    Failed = 1,
    /// An input is invalid, or output could not be written.
    BadInput = 2,
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        Self::from(status as u8)
    }
}

/// An error that ends a command with [`Status::BadInput`]. Hints in its text are on separate lines.
#[derive(Debug, Error)]
pub(super) enum CommandError {
    #[error("error: {0}")]
    Message(String),
    #[error("{}", .0.styled())]
    Diagnostic(#[from] Diagnostic),
}

impl CommandError {
    pub(super) fn about(subject: impl Display, reason: impl Display) -> Self {
        Self::Message(format!("{subject}: {reason}"))
    }

    pub(super) fn option(option: &str, value: impl Display, reason: impl Display) -> Self {
        Self::about(format_args!("{option} {value}"), reason)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case("error: no\n", "\u{1b}[1m\u{1b}[31merror:\u{1b}[0m no\n")]
    #[case("  pass  a::b  1.98\n", "  \u{1b}[32mpass \u{1b}[0m a::b  1.98\n")]
    #[case("  FAIL a: b\n", "  \u{1b}[1m\u{1b}[31mFAIL \u{1b}[0ma: b\n")]
    #[case("  about      to pass \n", "  about      to pass \n")]
    #[case("passing\n", "passing\n")]
    fn only_verdicts_are_coloured(#[case] text: &str, #[case] wanted: &str) {
        assert_eq!(painted(text), wanted);
    }
}

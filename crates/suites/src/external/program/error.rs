//! Failures of a solver program, and untrusted text in messages.

use crate::subject::LONGEST_NAME;
use std::io;
use thiserror::Error;

/// Failure of a solver process, or violation of the protocol. Most messages continue a sentence
/// that begins with the name of the solver.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ProgramError {
    /// The command has an unbalanced quote, or ends with a backslash.
    #[error("command has an unclosed quote, or ends with a backslash")]
    Quotes,
    /// The command is empty.
    #[error("command is empty: expected a program with its arguments")]
    EmptyCommand,
    /// The operating system does not support the memory limit.
    #[error("memory cannot be limited on this system")]
    MemoryLimit,
    /// The program does not start.
    #[error("program `{program}` does not start: {error}")]
    Start {
        /// Name of the program.
        program: String,
        /// Reason that the operating system reports.
        error: io::Error,
    },
    /// The process has no standard streams.
    #[error("process has no standard input, output or error")]
    Pipe,
    /// No answer arrived in time.
    #[error("did not answer within {0} s")]
    Silent(f64),
    /// The process ended without an answer, with this exit status.
    #[error("ended without an answer ({0})")]
    Ended(String),
    /// The process closed its standard output but is still running.
    #[error("closed its output but did not end")]
    ClosedOutput,
    /// The output of the process cannot be read.
    #[error("output cannot be read: {0}")]
    Unreadable(io::Error),
    /// An answer contains a number that JSON does not support, such as NaN.
    #[error("answered with {0}, which is not a finite number")]
    NoNumber(&'static str),
    /// A message violates the protocol, as described.
    #[error("{0}")]
    Protocol(String),
    /// The solver refuses the problem, for the given reason.
    #[error("{0}")]
    Refused(String),
    /// The solver reports a failure, with a description.
    #[error("reports: {0}")]
    Failed(String),
    /// A failure of a process that also wrote to its standard error.
    #[error("{error}; its last output on standard error: {lines}")]
    WithStandardError {
        /// The failure.
        error: Box<ProgramError>,
        /// Last lines of standard error.
        lines: String,
    },
}

impl ProgramError {
    pub(super) fn unexpected(request: &str, answer: &str) -> Self {
        Self::Protocol(format!("answered `{request}` with `{answer}`"))
    }

    pub(super) fn invalid_name(name: &str) -> Self {
        let name = printable(name);
        Self::Protocol(format!(
            "has the invalid name `{name}`: expected up to {LONGEST_NAME} letters, digits, `-`, `_` \
             or `.`"
        ))
    }
}

/// Converts untrusted text to one line of at most 200 characters.
pub(super) fn printable(text: &str) -> String {
    text.chars().take(200).map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// Returns the text of a JSON error without the names of Rust types.
pub(super) fn plain(error: &serde_json::Error) -> String {
    const EXPECTED: [(&str, &str); 8] = [
        ("u64", "a whole number, zero or more"),
        ("usize", "a whole number, zero or more"),
        ("f64", "a number"),
        ("a sequence", "a list"),
        ("a map", "an object"),
        ("internally tagged enum Answer", "an object with a `type`"),
        ("a boolean", "`true` or `false`"),
        ("a string", "a JSON string"),
    ];
    let text = error.to_string();
    if text.starts_with("data did not match any variant of untagged enum") {
        return "a column is a list of numbers, or `{\"f64\": [OFFSET, COUNT]}`".to_owned();
    }
    let Some((found, rest)) = text.split_once(", expected ") else { return text };
    let (expected, place) = rest.split_once(" at line ").unwrap_or((rest, "1"));
    let known = EXPECTED.iter().find(|(name, _)| *name == expected);
    let expected = match known {
        Some((_, plain)) => plain,
        None if expected.starts_with("struct ") => "an object",
        None => expected,
    };
    format!("{found}, expected {expected} at line {place}")
}

//! Failures of a solver's program, and untrusted text in messages.

use crate::external::fields::FieldError;
use crate::subject::{HIGHEST_ORDER, LONGEST_NAME};
use std::io;
use thiserror::Error;

/// A failure of a solver's process, or a breach of the protocol. The text is a predicate whose
/// subject is the solver.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ProgramError {
    /// The command has an unbalanced quote, or ends with a backslash.
    #[error("command has an unclosed quote, or ends with a backslash")]
    Quotes,
    /// The command is empty.
    #[error("is empty: expected a command with its arguments")]
    EmptyCommand,
    /// The operating system has no limit of memory.
    #[error("memory cannot be limited on this system")]
    MemoryLimit,
    /// The program does not start.
    #[error("`{program}`: {error}")]
    Start {
        /// Name of the program.
        program: String,
        /// The reason.
        error: io::Error,
    },
    /// The process has no standard streams.
    #[error("has no pipe")]
    Pipe,
    /// No answer arrived in time.
    #[error("did not answer within {0} s")]
    Silent(f64),
    /// The process ended without an answer.
    #[error("ended without an answer ({0})")]
    Ended(String),
    /// The process closed its standard output, and still runs.
    #[error("closed its output but did not end")]
    ClosedOutput,
    /// The output of the process cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(io::Error),
    /// The output ended within an answer, or within a block of bytes.
    #[error("ended in the middle of {0}")]
    Truncated(&'static str),
    /// An answer is longer than any answer that the problem needs.
    #[error("answered with more than {0} bytes")]
    TooLong(usize),
    /// An answer has a number that JSON does not have.
    #[error("answered with {0}, which is not a number")]
    NoNumber(&'static str),
    /// A line that is not a message of the protocol.
    #[error("sent an invalid message ({reason}): `{excerpt}`")]
    NoMessage {
        /// The violated rule.
        reason: String,
        /// Beginning of the line.
        excerpt: String,
    },
    /// A message of a type that does not answer the request.
    #[error("answered `{request}` with `{answer}`")]
    UnexpectedAnswer {
        /// Type of the request.
        request: &'static str,
        /// Type of the answer.
        answer: &'static str,
    },
    /// A version of the protocol that is not supported.
    #[error(
        "uses version {stated} of the protocol; expected version {} or {}",
        .expected[0],
        .expected[1]
    )]
    Version {
        /// Version that the solver stated.
        stated: u64,
        /// Versions that are supported.
        expected: [u64; 2],
    },
    /// The name of the solver is not a valid name.
    #[error(
        "has the invalid name `{0}`: expected up to {max} letters, digits, `-`, `_` or `.`",
        max = LONGEST_NAME
    )]
    Name(String),
    /// The formal order that the solver states is out of range.
    #[error("has the formal order {0}: expected one up to {max}", max = HIGHEST_ORDER)]
    FormalOrder(f64),
    /// A second process stated another name, version or capability than the first.
    #[error("sent a different `hello` than the first time")]
    ChangedHello,
    /// The solver refuses the problem, for this reason.
    #[error("{0}")]
    Refused(String),
    /// The solver reports a failure.
    #[error("reports: {0}")]
    Failed(String),
    /// A required column is missing.
    #[error("sent no column `{0}`")]
    NoColumn(&'static str),
    /// A column refers to bytes beyond the block of bytes.
    #[error(
        "placed the column `{name}` beyond its {bytes} bytes: {length} doubles from byte \
             {offset} on"
    )]
    ColumnBytes {
        /// Name of the column.
        name: String,
        /// Number of doubles.
        length: usize,
        /// First byte.
        offset: usize,
        /// Size of the block of bytes.
        bytes: usize,
    },
    /// A column has the wrong number of entries.
    #[error("sent {found} numbers in the column `{name}`, expected {expected}")]
    ColumnLength {
        /// Name of the column.
        name: String,
        /// Number of entries.
        found: usize,
        /// Number of entries that the problem needs.
        expected: usize,
    },
    /// A column has an entry that is not finite.
    #[error("sent {value} as number {index} of the column `{name}`")]
    NotFinite {
        /// Name of the column.
        name: String,
        /// The entry.
        value: f64,
        /// Index of the entry.
        index: usize,
    },
    /// The smallest determinant of F is not a positive number.
    #[error("sent {0} as `min_j`, but a determinant of F is positive")]
    Determinant(f64),
    /// A gradient has the wrong number of entries.
    #[error("sent a gradient of {found} numbers, expected {expected}: {names}")]
    GradientLength {
        /// Number of entries.
        found: usize,
        /// Number of entries that were requested.
        expected: usize,
        /// Names of the parameters that were requested.
        names: String,
    },
    /// A gradient has a number that JSON does not have.
    #[error("answered `differentiate` with {word}, which is not a number; requested: {names}")]
    GradientNoNumber {
        /// The number.
        word: &'static str,
        /// Names of the parameters that were requested.
        names: String,
    },
    /// An entry of a gradient, or the value of the functional, is not finite.
    #[error("sent {value} as the {of}")]
    GradientNotFinite {
        /// The number.
        value: f64,
        /// The entry, with the name of the parameter.
        of: String,
    },
    /// The solver has no points.
    #[error("has no points")]
    NoPoints,
    /// The points of the solver are not in the bodies of the problem.
    #[error("sent invalid points: {0}")]
    Points(FieldError),
    /// A request for values that cannot be answered.
    #[error("requested values of `{field}`: {reason}")]
    Request {
        /// Name of the field.
        field: String,
        /// The reason.
        reason: FieldError,
    },
    /// More requests for values than a solver needs.
    #[error("requested values {0} times")]
    TooManyRequests(u64),
    /// A failure of a process that wrote to its standard error.
    #[error("{error}; its last output on standard error: {lines}")]
    WithStandardError {
        /// The failure.
        error: Box<ProgramError>,
        /// Last lines of standard error.
        lines: String,
    },
}

/// Untrusted text in one line, at most 200 characters of it.
pub(super) fn printable(text: &str) -> String {
    text.chars().take(200).map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// An error of the JSON library without the names of Rust types.
pub(super) fn plain(error: &serde_json::Error) -> String {
    const EXPECTED: [(&str, &str); 8] = [
        ("u64", "a whole number, zero or more"),
        ("usize", "a whole number, zero or more"),
        ("f64", "a number"),
        ("a sequence", "a list"),
        ("a map", "an object"),
        ("internally tagged enum Answer", "an object with a `type`"),
        ("a boolean", "`true` or `false`"),
        ("a string", "a text"),
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

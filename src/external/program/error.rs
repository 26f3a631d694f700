//! Failures of a solver program, and untrusted text in messages.

use crate::external::fields::FieldError;
use crate::subject::{HIGHEST_ORDER, LONGEST_NAME};
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
    /// The output ended within an answer or a block of bytes.
    #[error("ended in the middle of {0}")]
    Truncated(&'static str),
    /// An answer is longer than this maximum number of bytes.
    #[error("answered with more than {0} bytes")]
    TooLong(usize),
    /// An answer contains a number that JSON does not support, such as NaN.
    #[error("answered with {0}, which is not a finite number")]
    NoNumber(&'static str),
    /// The output contains a line that is not a message of the protocol.
    #[error("sent an invalid message ({reason}): `{excerpt}`")]
    NoMessage {
        /// The violated rule.
        reason: String,
        /// Beginning of the line.
        excerpt: String,
    },
    /// The type of the answer does not match the request.
    #[error("answered `{request}` with `{answer}`")]
    UnexpectedAnswer {
        /// Type of the request.
        request: &'static str,
        /// Type of the answer.
        answer: &'static str,
    },
    /// The solver uses an unsupported version of the protocol.
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
    /// The solver's name is invalid.
    #[error(
        "has the invalid name `{0}`: expected up to {max} letters, digits, `-`, `_` or `.`",
        max = LONGEST_NAME
    )]
    Name(String),
    /// The solver's formal order is out of range.
    #[error(
        "has the formal order {0}: expected a number above 0 and up to {max}",
        max = HIGHEST_ORDER
    )]
    FormalOrder(f64),
    /// A second process stated a different name, version or capability than the first process.
    #[error("sent a different `hello` than in the first process")]
    ChangedHello,
    /// The solver refuses the problem, for the given reason.
    #[error("{0}")]
    Refused(String),
    /// The solver reports a failure, with a description.
    #[error("reports: {0}")]
    Failed(String),
    /// A required column is missing.
    #[error("sent no column `{0}`")]
    NoColumn(&'static str),
    /// A column refers to bytes outside the block.
    #[error(
        "sent the column `{name}` as {length} doubles from byte {offset}, but the message has \
         {bytes} bytes"
    )]
    ColumnBytes {
        /// Name of the column.
        name: String,
        /// Number of doubles in the column.
        length: usize,
        /// Index of the first byte of the column.
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
        /// Required number of entries.
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
    #[error("sent {0} as `min_j`, which must be positive")]
    Determinant(f64),
    /// A gradient has the wrong number of derivatives.
    #[error("sent a gradient of {found} numbers, expected {expected}: {names}")]
    GradientLength {
        /// Number of derivatives in the gradient.
        found: usize,
        /// Number of requested derivatives.
        expected: usize,
        /// Names of the requested parameters.
        names: String,
    },
    /// A gradient contains a number that JSON does not support, such as NaN.
    #[error(
        "answered `differentiate` with {word}, which is not a finite number; requested: {names}"
    )]
    GradientNoNumber {
        /// Text of the number.
        word: &'static str,
        /// Names of the requested parameters.
        names: String,
    },
    /// A derivative, or the value of the functional, is not finite.
    #[error("sent {value} as the {of}")]
    GradientNotFinite {
        /// The number.
        value: f64,
        /// Description of the number, with the parameter of a derivative.
        of: String,
    },
    /// The solver stated sample points, but there are none.
    #[error("sent an empty list of points")]
    NoPoints,
    /// The solver's points are outside the bodies of the problem.
    #[error("sent invalid points: {0}")]
    Points(FieldError),
    /// A request for values cannot be answered.
    #[error("requested values of `{field}`: {reason}")]
    Request {
        /// Name of the field.
        field: String,
        /// The reason.
        reason: FieldError,
    },
    /// The solver sent more requests for values than any correct solver needs.
    #[error("requested values {0} times, more than the limit")]
    TooManyRequests(u64),
    /// A failure of a process that also wrote to its standard error.
    #[error("{error}; its last output on standard error: {lines}")]
    WithStandardError {
        /// The failure.
        error: Box<ProgramError>,
        /// Last lines of standard error.
        lines: String,
    },
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

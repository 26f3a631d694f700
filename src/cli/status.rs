//! Exit statuses, and errors that end a command.

use mpm_verify::suite::yaml::Diagnostic;
use std::fmt::Display;
use std::process::ExitCode;
use thiserror::Error;

/// Exit status of a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Status {
    /// All results are as expected; in a comparison, nothing got worse.
    Passed = 0,
    /// Some expectation was not met; in a comparison, something got worse.
    Failed = 1,
    /// Some input could not be used, or the output could not be written.
    BadInput = 2,
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        Self::from(status as u8)
    }
}

/// An error that ends a command with [`Status::BadInput`]. The text may have hints on lines of
/// their own.
#[derive(Debug, Error)]
pub(super) enum CommandError {
    #[error("error: {0}")]
    Message(String),
    /// An error with its place in a file.
    #[error("{}", .0.styled())]
    Diagnostic(#[from] Diagnostic),
}

impl CommandError {
    /// An error about a suite, a case or an option.
    pub(super) fn about(subject: impl Display, reason: impl Display) -> Self {
        Self::Message(format!("{subject}: {reason}"))
    }

    /// An error about the value of an option.
    pub(super) fn option(option: &str, value: impl Display, reason: impl Display) -> Self {
        Self::about(format_args!("{option} {value}"), reason)
    }
}

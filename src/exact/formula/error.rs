//! Errors in formulas, with their place.

use std::ops::Range;

use thiserror::Error;

/// A formula that cannot be read or bound.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct FormulaError {
    /// The fault, in one line.
    pub message: String,
    /// The bytes at fault. They count in the source of the formula, or in the body of the function
    /// named by `within`; for a declared name that is refused, in that name itself.
    pub span: Range<usize>,
    /// A correction, where one is known.
    pub help: Option<String>,
    /// The user function in whose body the fault lies, if it is not in the formula itself.
    pub within: Option<String>,
    /// The name that is declared nowhere, if that is the fault.
    pub unknown: Option<String>,
}

impl FormulaError {
    /// An error without help, in the formula itself.
    pub(super) fn new(span: Range<usize>, message: impl Into<String>) -> Self {
        Self { message: message.into(), span, help: None, within: None, unknown: None }
    }

    /// An unknown name.
    pub(super) fn unknown(span: Range<usize>, name: &str) -> Self {
        let message = format!("unknown name `{name}`");
        Self { unknown: Some(name.to_owned()), ..Self::new(span, message) }
    }

    /// Adds what to write instead.
    pub(super) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Says that the span counts in the body of `function`. The innermost function is kept.
    pub(super) fn within(mut self, function: &str) -> Self {
        self.within.get_or_insert_with(|| function.to_owned());
        self
    }
}

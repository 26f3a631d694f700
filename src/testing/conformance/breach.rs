//! Breaches of the contract, in plain words.

use std::fmt;

/// A breach of the contract of [`Subject`](crate::subject::Subject).
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Breach {
    /// The part of the contract: `counts`, `labels`, `restart`.
    pub about: &'static str,
    /// Behaviour by the contract.
    pub expected: String,
    /// Behaviour of the subject.
    pub seen: String,
}

impl Breach {
    pub(super) fn new(
        about: &'static str,
        expected: impl Into<String>,
        seen: impl Into<String>,
    ) -> Self {
        Self { about, expected: expected.into(), seen: seen.into() }
    }
}

impl fmt::Display for Breach {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: expected {}; seen: {}", self.about, self.expected, self.seen)
    }
}

//! Where a value stands in a file.

use crate::suite::yaml::{OneOrMany, Step};

/// The way to a value in a file.
#[derive(Debug, Clone)]
pub(crate) struct Path(Vec<Step>);

impl Path {
    /// The value of a key of the whole file.
    pub(crate) fn top(key: &str) -> Self {
        Self(vec![Step::from(key)])
    }

    /// One step further down.
    pub(crate) fn then(&self, step: impl Into<Step>) -> Self {
        let mut longer = self.0.clone();
        longer.push(step.into());
        Self(longer)
    }

    /// The way to alternative `i` of those that stand here.
    pub(crate) fn alternative<T>(&self, alternatives: &OneOrMany<T>, i: usize) -> Self {
        if alternatives.is_listed() { self.then(i) } else { self.clone() }
    }

    /// The way, step by step.
    pub(crate) fn steps(&self) -> &[Step] {
        &self.0
    }
}

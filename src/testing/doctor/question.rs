//! Questions to a solver.

use super::patient::{Examined, Hindrance, Patient};

/// One question to a solver.
pub(super) struct Examination {
    /// Its name in reports.
    pub(super) name: &'static str,
    /// The sight of a sound solver, in one sentence.
    pub(super) expected: &'static str,
    /// Examinations without whose soundness this one says nothing.
    pub(super) after: &'static [&'static str],
    pub(super) examine: fn(&Patient<'_>) -> Result<Examined, Hindrance>,
}

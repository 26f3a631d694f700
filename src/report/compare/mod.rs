//! Two runs side by side: what moved between two JSON documents, the most important first.
//!
//! A pull request that makes a method less accurate, less stable or more expensive shows it here.
//! Cases are paired by suite and name, their levels by cells, spacing and particles per cell, so
//! that like is held against like; what has no counterpart is named and not judged. Work is counted
//! in transfers between particles and nodes, which are the same on every machine, and is compared
//! at equal error where the errors of both runs fall far enough to meet (`equal_error`).
//!
//! Cases judged by bounds on drifts alone have no error to compare, only a verdict.

mod accuracy;
mod changes;
mod document;
mod equal_error;
mod output;
mod pairs;
mod shared_words;
mod snapshots;
mod stability;

#[cfg(test)]
mod tests;

pub use changes::{Rank, ReportComparison};
pub use document::{ReportDocument, Unreadable};
pub use output::{json, markdown, text};

/// Largest relative change of a figure that counts as none, unless a caller says otherwise: that of
/// the [drift gate](super::text::drift).
pub const TOLERANCE: f64 = super::text::drift::RELATIVE;

/// Changes from `old` to `new` by more than the relative `tolerance`.
pub fn compare(old: &ReportDocument, new: &ReportDocument, tolerance: f64) -> ReportComparison {
    pairs::compare(old, new, tolerance)
}

//! Lists the changes between the JSON documents of two runs, the most important first.
//!
//! Cases are paired by suite and name, and levels by cells, spacing and particles per cell; others
//! are listed but not judged. Work is the number of particle-node transfers, which is the same on
//! all machines.
//!
//! A case that only bounds the drift of conserved sums has no error, so its verdict is compared.

mod accuracy;
mod changes;
mod document;
mod output;
mod pairs;
mod snapshots;
mod stability;

#[cfg(test)]
mod tests;

pub use changes::{Rank, ReportComparison};
pub use document::{ReportDocument, Unreadable};
pub use output::text;
pub use pairs::compare;

/// Default tolerance: maximum relative change of a value that counts as unchanged, as in the [drift
/// gate](super::text::drift).
pub const TOLERANCE: f64 = super::text::drift::RELATIVE;

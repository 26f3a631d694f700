//! Cost of suites in seconds: measured times of levels.
//!
//! Errors are measured in the same parallel runs as for reports. Then every level runs again, alone
//! on one thread, and its steps are timed. The times exclude the set-up and the computation of
//! errors.

pub(crate) mod measure;

pub use measure::{Goal, goals};
pub use measure::{TimedPart, price};

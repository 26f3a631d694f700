//! Cost of suites in seconds: measured for each level, and within a budget.
//!
//! Errors come from the same parallel runs as in reports. Then every level runs again, alone on one
//! thread, and its steps are timed. The times exclude the set-up and the computation of errors.

pub(crate) mod budget;
pub(crate) mod candidate;
pub(crate) mod measure;

pub use budget::{BudgetError, best_candidate};
pub use measure::{Goal, goals};
pub use measure::{TimedPart, price};

//! Cost of suites in seconds: measured level by level, and within a budget.
//!
//! Errors come from the same runs as reports, in parallel. Then every level is run again, alone on
//! one thread, and its steps are timed, without set-up and without computing errors.

pub(crate) mod budget;
pub(crate) mod candidate;
pub(crate) mod measure;

pub use budget::{BudgetError, best_candidate};
pub use measure::{Goal, goals};
pub use measure::{TimedPart, price};

//! The stability study: a parameter is swept, and every run ends in a verdict.
//!
//! ```text
//! model    a study, checked
//! recipe   values of the parameters -> a set-up, by reading the suite's words once more
//! scales   what a run is measured with
//! plan     words -> cases, each with what is expected of every row
//! expect   what is expected
//! run      cases -> outcomes: runs, predictions, limits
//! rows     the plan in rows of name and value, for reports
//! ```

pub(crate) mod expect;
pub(crate) mod plan;
pub(crate) mod recipe;
pub(crate) mod scales;

pub(crate) use plan::plan;

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

mod expect;
mod model;
mod plan;
mod recipe;
mod rows;
mod run;
mod scales;

pub use model::{StabilityCase, StabilityPlan};
pub(super) use plan::plan;
pub(super) use rows::{first, rows};
pub(super) use run::case;

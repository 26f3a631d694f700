//! The stability study: a parameter is swept, and every run ends in a verdict.
//!
//! ```text
//! setup    values of the parameters -> the set-up of a run
//! scales   scales and bounds that a run is judged by
//! plan     specification -> cases, each with an expectation of every row
//! expect   the expectations
//! ```

pub(crate) mod expect;
pub(crate) mod plan;
pub(crate) mod scales;
pub(crate) mod setup;

pub(crate) use plan::plan;

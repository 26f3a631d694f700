//! The report as JSON: an interface for programs.

pub(crate) mod cost;
pub(crate) mod diagnosis;
pub(crate) mod schema;
pub(crate) mod timed_suite;

//! The rows of name and value that describe a problem.

pub mod sketch;
pub(crate) mod statement;
pub use statement::Dispensable;

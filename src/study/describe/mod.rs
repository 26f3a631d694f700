//! Describes a problem in rows of name and value.

pub mod sketch;
pub(crate) mod statement;
pub use statement::Dispensable;

//! The rows of name and value that state a problem.

pub mod profiles;
pub mod sketch;
pub(crate) mod statement;

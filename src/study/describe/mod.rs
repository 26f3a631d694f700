//! The rows of name and value that state a problem.

pub(crate) mod amplitude;
pub(crate) mod heat;
pub mod profiles;
pub(crate) mod statement;

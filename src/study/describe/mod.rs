//! The rows of name and value that state a problem.

pub(crate) mod amplitude;
pub(crate) mod heat;
pub mod level_list;
pub(crate) mod linearisation;
pub mod profiles;
pub mod sketch;
pub(crate) mod statement;

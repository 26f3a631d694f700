//! skeleton
pub mod subject;

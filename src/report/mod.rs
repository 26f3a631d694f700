//! The page.
pub mod figure;

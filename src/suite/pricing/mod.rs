//! What suites cost in seconds: measured level by level, varied, and bid for.
//!
//! Errors come from the same runs as reports, in parallel; then every level is run again, alone, by one
//! thread, and its steps are timed: without setting up, without taking errors.

mod budget;
mod candidate;
mod goal;
mod machine;
mod measure;
mod variants;

pub use budget::bid;
pub use goal::{Goal, goals};
pub use measure::price;
pub use variants::{Over, variants};

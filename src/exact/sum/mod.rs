//! Exact sums over the body and over faces of it.

mod body_sum;
mod gauss;

pub use body_sum::{BodySum, SumDensity, SumPoint, SumRegion};

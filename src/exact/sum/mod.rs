//! Exact sums over the body and over faces of it.

mod body_sum;

pub use body_sum::{BodySum, SumDensity, SumPoint, SumRegion};

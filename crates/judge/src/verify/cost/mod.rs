//! Cost of accuracy: the method that reaches an error with the least work.
//!
//! Work is any additive measure, such as seconds or the number of particle-node transfers. Rankings
//! do not extrapolate: a method with larger errors on all levels does not reach the target.

mod exponent;
mod ranking;
mod sample;
#[cfg(test)]
mod tests;
mod timing;

pub use exponent::{Agreement, Exponent};
pub use ranking::{MethodCost, Ranked, Ranking, by_transfers, rankings};
pub use sample::{ConvergingPart, End, Reach, Sample, pareto_front};
pub use timing::{Machine, TimedSuite, Timing, Workload};

/// Target errors of tables, relative to the size of the solution.
pub const TARGETS: [f64; 3] = [1e-2, 1e-3, 1e-4];

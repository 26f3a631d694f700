//! Cost of accuracy: the method that reaches an error for the least work.
//!
//! | module | holds |
//! |---|---|
//! | [`tried`](Sample) | what one level gave and took |
//! | [`part`](ConvergingPart) | the levels over which a method converges |
//! | [`reach`](Reach) | the work at which an error is reached |
//! | [`exponent`](Exponent) | what one more digit costs, beside theory |
//! | [`front`](pareto_front()) | what nothing else beats |
//! | [`ranking`](Ranking) | all of it for the methods of one problem |
//! | [`timing`](Timing) | seconds that were measured |
//! | [`model`](Model) | seconds that are predicted |
//! | [`predicted_error`](PredictedError) | errors that are predicted, with an interval |
//! | [`priced`](TimedSuite) | a suite whose levels have been timed |
//!
//! Work is any number that adds up: particle-node transfers, which are the same everywhere, or
//! seconds. Rankings extrapolate nothing: an error that no level reaches is not reached.

mod exponent;
mod front;
mod model;
mod part;
mod predicted_error;
mod ranking;
mod reach;
mod sample;
#[cfg(test)]
mod tests;
mod timed_suite;
mod timing;

pub use exponent::{Agreement, Exponent};
pub use front::pareto_front;
pub use model::{Model, Workload};
pub use part::{ConvergingPart, End};
pub use predicted_error::{PredictedError, Unpredicted};
pub use ranking::{MethodCost, Ranked, Ranking, by_transfers, rankings};
pub use reach::Reach;
pub use sample::Sample;
pub use timed_suite::{BestCandidate, TimedSuite};
pub use timing::{Machine, Timing};

/// The errors, over the size of the solution, that tables ask for.
pub const TARGETS: [f64; 3] = [1e-2, 1e-3, 1e-4];

//! Tests of a solver in Rust, in the crate that it is of (docs/library.md).
//!
//! ```text
//! conformance   whether it keeps the contract of `Subject`
//! harness       a test for each case of a folder of suites, and its reports as snapshots
//! ```

mod conformance;
#[cfg(feature = "testing")]
mod harness;

pub use conformance::{Breach, conformance, conformance_on};
#[cfg(feature = "testing")]
pub use harness::SuiteFolder;

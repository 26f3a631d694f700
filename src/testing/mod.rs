//! Tests of a solver in its own crate, in Rust (docs/library.md).
//!
//! ```text
//! conformance   whether it keeps the contract of `Subject`
//! doctor        small problems that show what is wrong with it
//! harness       a test for each case of a folder of suites, and its reports as snapshots
//! ```

mod conformance;
mod doctor;
#[cfg(feature = "testing")]
mod harness;

pub use conformance::{Breach, conformance, conformance_on};
pub use doctor::{
    DoctorReport, ExaminationReport, ExaminationResult, FindingWeight, SolverFinding, doctor, page,
};
#[cfg(feature = "testing")]
pub use harness::SuiteFolder;

//! Test support for a solver's own crate (docs/library.md).
//!
//! ```text
//! conformance   whether the solver conforms to the contract of `Subject`
//! doctor        small problems that reveal defects of the solver
//! harness       a test for each case of a folder of suites, and report snapshots
//! ```

mod conformance;
mod doctor;
#[cfg(feature = "testing")]
mod harness;

pub use conformance::{Breach, conformance, conformance_on};
pub use doctor::{
    DoctorReport, ExaminationReport, ExaminationResult, FindingWeight, SolverFinding,
    UnexaminedCapability, brief_page, doctor, page,
};
#[cfg(feature = "testing")]
pub use harness::SuiteFolder;

//! Test support for a solver's own crate (docs/library.md).
//!
//! ```text
//! change        changes of a problem that must not affect its solution
//! conformance   whether the solver conforms to the contract of `Subject`
//! doctor        small problems that reveal defects of the solver
//! harness       a test for each case of a folder of suites, and report snapshots
//! ```

mod change;
mod conformance;
mod doctor;
#[cfg(feature = "testing")]
mod harness;

// For tests of this project, without a promise of stability.
#[doc(hidden)]
pub use change::{Change, Changed};
pub use conformance::{Breach, conformance, conformance_on};
pub use doctor::{
    DoctorReport, ExaminationReport, ExaminationResult, FindingWeight, SolverFinding,
    UnexaminedCapability, brief_page, doctor, page,
};
#[cfg(feature = "testing")]
pub use harness::SuiteFolder;

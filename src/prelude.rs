//! Names that authors of solvers in Rust need: `use mpm_verify::prelude::*`.

pub use crate::external::{
    BodyForceField, Capabilities, FieldName, FieldPlaces, LevelProblem, ProblemFields,
    ProblemMaterial, ProblemNeeds, ProblemParticles, SolverFactory,
};
pub use crate::study::{Runner, under};
pub use crate::subject::{Failure, RunCounters, Samples, Subject, SubjectError, Totals};
pub use crate::suite::yaml::{Diagnostic, Source};
pub use crate::suite::{Extent, Suite};
#[cfg(feature = "testing")]
pub use crate::testing::SuiteFolder;
pub use crate::testing::{Breach, conformance};
pub use crate::verify::{CaseOutcome, SuiteOutcome, Verdict};

//! External solvers: the trait of their makers, their problem, and the protocol for programs.
//!
//! ```text
//! problem        initial state of one level: particles, grid, faces, materials, loads, steps
//! fields         quantities of a problem at any place and time
//! capabilities   what a solver can do, what a problem needs, and the names of both
//! gradient       derivatives of functionals, and problems with another value of a parameter
//! format         a problem as a file
//! program/       solvers in programs that speak the protocol (docs/protocol.md)
//! ```

mod capabilities;
mod fields;
#[cfg(feature = "external-programs")]
mod format;
mod gradient;
mod problem;
#[cfg(feature = "external-programs")]
mod program;

use crate::subject::{Precision, Subject, SubjectError};
pub use capabilities::{Capabilities, ProblemNeeds};
pub use fields::{
    BodyForceField, FieldError, FieldName, FieldPlaces, HandedNumber, HandedValues,
    PlacedBodyForce, ProblemFields,
};
pub(crate) use fields::{FieldSource, ForceSource, owned};
#[cfg(feature = "external-programs")]
pub use format::ProblemFormat;
pub use gradient::{Gradient, GradientError, GradientRequest};
pub use problem::{
    LevelProblem, ProblemBody, ProblemContact, ProblemFace, ProblemGrid, ProblemLoad,
    ProblemMaterial, ProblemParticles, ProblemRegion,
};
#[cfg(feature = "external-programs")]
pub use program::{ProgramError, ProgramLimits, SolverProgram, protocol_schema, read_answers};

/// A solver that can be put on every level of a suite.
pub trait SolverFactory: Sync {
    /// Its name, which is also that of its case.
    fn name(&self) -> &str;

    /// Theoretical order in h of its displacements on a smooth solution.
    fn formal_order(&self) -> f64 {
        2.0
    }

    /// Precision of its numbers.
    fn precision(&self) -> Precision {
        Precision::Double
    }

    /// Settings for reports, as rows of name and value.
    fn settings(&self) -> Vec<(String, String)> {
        Vec::new()
    }

    /// Hash of all inputs of the results except the problem: the program and its arguments. Results
    /// are cached for later runs of a solver with the same hash. `None` (the default): results are
    /// not cached.
    fn identity(&self) -> Option<u64> {
        None
    }

    /// Missing capabilities of the solver for a problem; empty if it can be run.
    fn lacks(&self, _needs: &ProblemNeeds) -> Vec<String> {
        Vec::new()
    }

    /// The solver in the initial state of `problem`. Its labels are the reference positions of the
    /// particles, or its own sample points.
    ///
    /// # Errors
    /// [`SubjectError::Unsupported`] if the solver refuses the problem. A case with an error is not
    /// applicable. A solver that breaks returns a subject whose first step fails, and the case
    /// fails.
    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError>;

    /// The value of a functional after all steps of `problem`, and its gradient. The default is
    /// that of a solver that is not differentiable.
    ///
    /// # Errors
    /// [`GradientError::Cannot`] if the solver has no such gradient, [`GradientError::Failed`] if
    /// it breaks.
    fn gradient(
        &self,
        _problem: LevelProblem,
        _request: &GradientRequest,
    ) -> Result<Gradient, GradientError> {
        Err(GradientError::Cannot("has no gradients".to_owned()))
    }
}

//! External solvers: the trait that creates them, their problem, and the protocol for programs.

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
pub(crate) use fields::owned;
pub use fields::{BodyForceField, FieldName, FieldPlaces, ProblemFields};
#[cfg(feature = "external-programs")]
pub use format::ProblemFormat;
pub use gradient::{Gradient, GradientError, GradientRequest};
pub use problem::{
    LevelProblem, ProblemBody, ProblemContact, ProblemFace, ProblemGrid, ProblemLoad,
    ProblemMaterial, ProblemParticles, ProblemRegion,
};
#[cfg(feature = "external-programs")]
#[doc(hidden)]
pub use program::read_answers;
#[cfg(feature = "external-programs")]
pub use program::{
    ProgramError, ProgramLimits, ResultFolder, ResultLevel, SolverProgram, protocol_schema,
};

// For other modules and packages of this project, without a promise of stability.
#[doc(hidden)]
pub use self::{
    capabilities::{SMALL_STRAIN, everything},
    fields::{FieldError, HandedNumber, HandedValues, PlacedBodyForce},
};

/// Creates an external solver for any level of a suite.
pub trait SolverFactory: Sync {
    /// Returns the name of the solver. Reports also use it as the name of the case.
    fn name(&self) -> &str;

    /// Returns the theoretical order in h of the displacement error for a smooth solution.
    fn formal_order(&self) -> f64 {
        2.0
    }

    /// Returns the precision of the solver's numbers.
    fn precision(&self) -> Precision {
        Precision::Double
    }

    /// Returns the settings for reports, as rows of name and value.
    fn settings(&self) -> Vec<(String, String)> {
        Vec::new()
    }

    /// Returns a hash of everything that affects the results apart from the problem, such as the
    /// program and its arguments. Later runs of a solver with the same hash use cached results. By
    /// default, `None` is returned and results are not cached.
    fn identity(&self) -> Option<u64> {
        None
    }

    /// Lists the capabilities that a problem requires and the solver lacks.
    fn lacks(&self, _needs: &ProblemNeeds) -> Vec<String> {
        Vec::new()
    }

    /// Returns the capabilities that the solver declares; `None`, the default, if it declares none.
    /// `doctor` lists the declared capabilities that no examination covers.
    fn capabilities(&self) -> Option<&Capabilities> {
        None
    }

    /// Sets up the solver in the initial state of `problem`. Its labels are the reference positions
    /// of the particles, or of the solver's own sample points.
    ///
    /// # Errors
    /// [`SubjectError::Unsupported`] if the solver refuses the problem; the case is then not
    /// applicable. A solver that fails returns a subject whose first step fails; the case then
    /// fails.
    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError>;

    /// Computes a functional after all steps of `problem`, and its gradient. The default
    /// implementation returns [`GradientError::Cannot`].
    ///
    /// # Errors
    /// [`GradientError::Cannot`] if the solver does not support this gradient,
    /// [`GradientError::Failed`] if it fails.
    fn gradient(
        &self,
        _problem: LevelProblem,
        _request: &GradientRequest,
    ) -> Result<Gradient, GradientError> {
        Err(GradientError::Cannot("does not compute gradients".to_owned()))
    }
}

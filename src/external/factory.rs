//! Makers of solvers.

use super::capabilities::ProblemNeeds;
use super::gradient::{Gradient, GradientError, GradientRequest};
use super::problem::LevelProblem;
use crate::subject::{Precision, Subject};

/// A solver that can be put on every level of a suite.
pub trait SolverFactory: Sync {
    /// Its name, which becomes that of its case.
    fn name(&self) -> &str;

    /// Order in h that theory gives its displacements on a smooth solution.
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

    /// A number that stands for all that its results depend on besides the problem: its program
    /// and arguments. Results are kept for a later run of a solver with the same number, and of one
    /// that has none (the default) not at all.
    fn identity(&self) -> Option<u64> {
        None
    }

    /// Everything that a problem needs and the solver lacks; empty if it can be tried.
    fn lacks(&self, _needs: &ProblemNeeds) -> Vec<String> {
        Vec::new()
    }

    /// The solver in the initial state of `problem`. Its labels are the reference positions of the
    /// particles, or places of its own.
    ///
    /// # Errors
    /// One line that says why the problem is not for this solver; the case is then not applicable.
    /// A solver that is broken gives a subject whose first step fails.
    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, String>;

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

//! The request `differentiate` and its answer.

use super::answer::Answer;
use super::error::{ProgramError, printable};
use super::frame::Outgoing;
use super::solver::{SolverProgram, Started};
use super::subject::{QUESTIONS_PER_STEP, conclude};
use crate::external::gradient::{Gradient, GradientRequest};
use crate::external::problem::LevelProblem;
use serde_json::json;

impl SolverProgram {
    /// The value of a functional after all steps of `problem`, and its gradient, from a new
    /// process.
    ///
    /// # Errors
    /// [`ProgramError::Refused`] if the solver answers `cannot`; any other if it breaks.
    pub(super) fn differentiate(
        &self,
        problem: &LevelProblem,
        request: &GradientRequest,
    ) -> Result<Gradient, ProgramError> {
        let Started { mut connection, mut inquiry, .. } = self.ready(problem)?;
        let content = json!({
            "of": request.of,
            "with_respect_to": request.with_respect_to,
            "steps": problem.steps,
            "dt": problem.dt,
            "from": 0.0,
        });
        connection.send(Outgoing::new("differentiate", content, false));
        inquiry.allow(problem.steps.saturating_mul(QUESTIONS_PER_STEP));
        let names = || names(request).join(", ");
        let answer = conclude(&mut connection, &mut inquiry).map_err(|error| match error {
            // JSON has no such number, so the entry is unknown.
            ProgramError::NoNumber(word) => ProgramError::GradientNoNumber { word, names: names() },
            error => error,
        });
        let answer = answer?.0;
        let gradient = match answer {
            Answer::Gradient { value, gradient } => checked(request, value, gradient)?,
            Answer::Cannot { reason } => return Err(ProgramError::Refused(printable(&reason))),
            Answer::Failed { reason } => return Err(ProgramError::Failed(printable(&reason))),
            other => {
                let (request, answer) = ("differentiate", other.name());
                return Err(ProgramError::UnexpectedAnswer { request, answer });
            }
        };
        connection.end();
        Ok(gradient)
    }
}

/// The answer to `request`, if it has as many finite numbers as parameters.
fn checked(
    request: &GradientRequest,
    value: f64,
    gradient: Vec<f64>,
) -> Result<Gradient, ProgramError> {
    let names = names(request);
    if gradient.len() != names.len() {
        let (found, expected, names) = (gradient.len(), names.len(), names.join(", "));
        return Err(ProgramError::GradientLength { found, expected, names });
    }
    let entries = names.iter().map(|name| format!("derivative with respect to `{name}`"));
    let entries = entries.zip(&gradient).map(|(of, entry)| (of, *entry));
    let value_of = (format!("value of `{}`", request.of.name()), value);
    let mut all = std::iter::once(value_of).chain(entries);
    match all.find(|(_, number)| !number.is_finite()) {
        Some((of, value)) => Err(ProgramError::GradientNotFinite { value, of }),
        None => Ok(Gradient { value, gradient }),
    }
}

/// Names of the parameters of a request.
fn names(request: &GradientRequest) -> Vec<&'static str> {
    request.with_respect_to.iter().map(|one| one.name()).collect()
}

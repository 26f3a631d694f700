//! Values and gradients of functionals, and problems with a changed parameter.

use super::fields::{FieldError, FieldName, FieldPlaces, HandedNumber, ProblemFields};
use super::problem::LevelProblem;
use crate::subject::{Functional, GradientParameter, SubjectError};
use std::sync::Arc;
use thiserror::Error;

/// Request for the value of a functional and its gradient after all steps of a problem.
#[derive(Debug, Clone, PartialEq)]
pub struct GradientRequest {
    /// Functional to evaluate.
    pub of: Functional,
    /// Parameters of the derivatives, in the order of the gradient entries.
    pub with_respect_to: Vec<GradientParameter>,
}

/// Answer of a solver to a [`GradientRequest`].
#[derive(Debug, Clone, PartialEq)]
pub struct Gradient {
    /// Value of the functional.
    pub value: f64,
    /// Derivatives, one for each requested parameter, in units of the functional per unit of the
    /// parameter.
    pub gradient: Vec<f64>,
}

/// Reason why a solver returns no gradient.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum GradientError {
    /// The solver does not support this gradient; the reason is one line.
    #[error("{0}")]
    Cannot(String),
    /// The solver failed; the reason is one line.
    #[error("{0}")]
    Failed(String),
}

impl From<SubjectError> for GradientError {
    fn from(error: SubjectError) -> Self {
        match error {
            SubjectError::Unsupported(reason) => Self::Cannot(reason),
            SubjectError::Failed(failure) => Self::Failed(failure.to_string()),
        }
    }
}

impl LevelProblem {
    /// Returns the value of a parameter; `None` if the problem lacks the parameter or has several
    /// materials.
    pub fn parameter(&self, parameter: GradientParameter) -> Option<f64> {
        let [material] = self.materials.as_slice() else { return None };
        match parameter {
            GradientParameter::Density => Some(material.density),
            GradientParameter::InitialVelocity => Some(1.0),
            GradientParameter::Friction => self.faces.iter().find_map(|face| {
                let coefficient = face.numbers.values.iter().find(|(key, _)| *key == "coefficient");
                match coefficient {
                    Some((_, HandedNumber::Scalar(value))) => Some(*value),
                    _ => None,
                }
            }),
            other => Some(material.parameter(other.name())).filter(|value| value.is_finite()),
        }
    }

    /// Changes one parameter of the problem. A new density also changes all particle masses.
    #[must_use]
    pub fn with_parameter(mut self, parameter: GradientParameter, value: f64) -> Self {
        match parameter {
            GradientParameter::Density => {
                self.materials.iter_mut().for_each(|material| material.density = value);
                let volumes = &self.particles.reference_volume;
                self.particles.mass = volumes.iter().map(|volume| value * volume).collect();
            }
            GradientParameter::InitialVelocity => {
                self.particles.velocity.iter_mut().for_each(|velocity| *velocity *= value);
                let scaled = |source| Arc::new(ScaledVelocity { source, by: value });
                self.fields = self.fields.map(|source| scaled(source) as Arc<dyn ProblemFields>);
            }
            GradientParameter::Friction => {
                let numbers = self.faces.iter_mut().flat_map(|face| &mut face.numbers.values);
                for (_, number) in numbers.filter(|(key, _)| *key == "coefficient") {
                    *number = HandedNumber::Scalar(value);
                }
            }
            other => {
                let all = self.materials.iter_mut().flat_map(|material| &mut material.parameters);
                let known = all.filter(|(key, _)| *key == other.name());
                known.for_each(|(_, known)| *known = value);
            }
        }
        self
    }
}

struct ScaledVelocity {
    source: Arc<dyn ProblemFields>,
    by: f64,
}

impl ProblemFields for ScaledVelocity {
    fn bodies(&self, labels: &[f64]) -> Result<Vec<usize>, FieldError> {
        self.source.bodies(labels)
    }

    fn nearest_body(&self, label: &[f64]) -> usize {
        self.source.nearest_body(label)
    }

    fn check_places(&self, places: &FieldPlaces<'_>) -> Result<(), FieldError> {
        self.source.check_places(places)
    }

    fn values(&self, of: FieldName, t: f64, at: &FieldPlaces<'_>) -> Result<Vec<f64>, FieldError> {
        let mut values = self.source.values(of, t, at)?;
        if of == FieldName::Velocity {
            for value in &mut values {
                *value *= self.by;
            }
        }
        Ok(values)
    }
}

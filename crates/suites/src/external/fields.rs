//! Quantities of a problem, as numbers or as functions of position and time.

use serde::{Serialize, Serializer};
#[cfg(feature = "schemas")]
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;
use thiserror::Error;

/// A constant: one number, or the components of a vector.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub enum HandedNumber {
    /// One number (SI units).
    Scalar(f64),
    /// D numbers (SI units).
    Vector(Vec<f64>),
}

/// Numbers of a load or a face condition: constants, and quantities that depend on position, time
/// or displacement.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct HandedValues {
    /// Constants by their keys, in SI units.
    #[serde(serialize_with = "as_map")]
    #[cfg_attr(feature = "schemas", schemars(with = "BTreeMap<String, HandedNumber>"))]
    pub values: Vec<(&'static str, HandedNumber)>,
    /// Keys of the quantities that are not constant, each with the arguments of the quantity
    /// (`reference_position`, `t` or `displacement`), named as in a `values` request.
    #[serde(serialize_with = "as_map")]
    #[cfg_attr(feature = "schemas", schemars(with = "BTreeMap<String, Vec<String>>"))]
    pub asked: Vec<(&'static str, Vec<&'static str>)>,
}

pub(super) fn as_map<V: Serialize, S: Serializer>(
    all: &[(&'static str, V)],
    to: S,
) -> Result<S::Ok, S::Error> {
    to.collect_map(all.iter().map(|(key, value)| (key, value)))
}

/// A quantity of a problem that has a value at every point of a body or a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum FieldName {
    /// Sum of stated and manufactured body forces (m/s2).
    BodyForce,
    /// Displacement at t = 0 (m).
    Displacement,
    /// Velocity at t = 0 (m/s).
    Velocity,
    /// Deformation gradient at t = 0.
    DeformationGradient,
    /// Cauchy stress at t = 0 (Pa).
    Stress,
    /// Stress of the reference configuration (Pa).
    InitialStress,
    /// Out-of-plane normal components of this stress (Pa), 3 - D numbers.
    InitialStressAcross,
    /// Quantity of the load with this index.
    Load(usize),
    /// Quantity of the condition on the face with this index.
    Face(usize),
}

#[cfg(feature = "external-programs")]
pub(crate) const BODY_FIELDS: [(&str, FieldName); 7] = [
    ("body_force", FieldName::BodyForce),
    ("displacement", FieldName::Displacement),
    ("velocity", FieldName::Velocity),
    ("deformation_gradient", FieldName::DeformationGradient),
    ("stress", FieldName::Stress),
    ("initial_stress", FieldName::InitialStress),
    ("initial_stress_across", FieldName::InitialStressAcross),
];

impl FieldName {
    /// Whether the field belongs to the initial state.
    pub fn is_initial(self) -> bool {
        !matches!(self, Self::BodyForce | Self::Load(_) | Self::Face(_))
    }
}

/// Points of one problem at which values are requested.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct FieldPlaces<'a> {
    /// Reference positions (m), D numbers each.
    pub labels: &'a [f64],
    /// Index of the body at each point.
    pub bodies: &'a [usize],
    /// Displacements (m), D numbers each, if the request contains them.
    pub displacement: Option<&'a [f64]>,
}

impl<'a> FieldPlaces<'a> {
    /// Creates points from their reference positions (m, D numbers each) and the body at each
    /// point.
    pub fn new(labels: &'a [f64], bodies: &'a [usize]) -> Self {
        Self { labels, bodies, displacement: None }
    }
}

/// Reason why values cannot be returned.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum FieldError {
    /// The request is invalid; the reason is one line.
    #[error("{0}")]
    Request(String),
    /// The problem does not define the requested values; the reason is one line.
    #[error("{0}")]
    Undefined(String),
}

/// Initial state, loads and face conditions of a problem, at points and times that a solver
/// chooses.
pub trait ProblemFields: Send + Sync {
    /// Returns the index of the body that contains each of the reference positions (m, D numbers
    /// each).
    ///
    /// # Errors
    /// [`FieldError::Request`] for a point outside all bodies or on the common boundary of two
    /// bodies.
    fn bodies(&self, labels: &[f64]) -> Result<Vec<usize>, FieldError>;

    /// Returns the index of the body that contains the reference position `label` (m); 0, the index
    /// of the first body, if no body contains it.
    fn nearest_body(&self, label: &[f64]) -> usize;

    /// Checks that each point is in its stated body, within rounding.
    ///
    /// # Errors
    /// [`FieldError::Request`] for the first point outside its body.
    fn check_places(&self, places: &FieldPlaces<'_>) -> Result<(), FieldError>;

    /// Returns the values of a field at points, point by point. Vectors have D numbers, tensors
    /// D^2, row by row. The body force is available only from
    /// [`LevelProblem::body_force`](super::LevelProblem::body_force).
    ///
    /// # Errors
    /// [`FieldError::Request`] for a point that is not on its face, [`FieldError::Undefined`] if
    /// the problem does not define the value.
    fn values(&self, of: FieldName, t: f64, at: &FieldPlaces<'_>) -> Result<Vec<f64>, FieldError>;
}

impl fmt::Debug for dyn ProblemFields {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("ProblemFields")
    }
}

/// Function that writes the body force (m/s2) at fixed points for a given time (s).
pub type PlacedBodyForce = Box<dyn FnMut(f64, &mut [[f64; 3]]) + Send>;

/// A body force per unit of mass, as a function of the reference position and time.
pub trait BodyForceField: Send + Sync {
    /// Returns the force (m/s2) at the reference position `label` (m, D numbers) of body number
    /// `body` at time `t` (s). Components above the dimension are zero.
    fn at(&self, body: usize, label: &[f64], t: f64) -> [f64; 3];

    /// Whether the force depends on the displacement.
    fn depends_on_displacement(&self) -> bool {
        false
    }

    /// Returns the force (m/s2) like [`at`](Self::at), for a point with the displacement `u` (m).
    fn at_displaced(&self, body: usize, label: &[f64], t: f64, _u: &[f64; 3]) -> [f64; 3] {
        self.at(body, label, t)
    }

    /// Returns the force at fixed points as a function of time; `None` if evaluation point by point
    /// is as cheap.
    fn placed(&self, _bodies: &[usize], _labels: &[&[f64]]) -> Option<PlacedBodyForce> {
        None
    }
}

impl dyn BodyForceField {
    /// Returns the force at fixed points as a function of time. For many times, this is much
    /// cheaper than [`at`](BodyForceField::at).
    pub fn at_places(self: &Arc<Self>, bodies: &[usize], labels: &[&[f64]]) -> PlacedBodyForce {
        self.placed(bodies, labels).unwrap_or_else(|| {
            let (force, places) = (Arc::clone(self), owned(bodies, labels));
            Box::new(move |t, into| {
                for (into, (body, label)) in into.iter_mut().zip(&places) {
                    *into = force.at(*body, label, t);
                }
            })
        })
    }
}

pub(crate) fn owned(bodies: &[usize], labels: &[&[f64]]) -> Vec<(usize, Vec<f64>)> {
    bodies.iter().copied().zip(labels.iter().map(|label| label.to_vec())).collect()
}

impl fmt::Debug for dyn BodyForceField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("BodyForceField")
    }
}

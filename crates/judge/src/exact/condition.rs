//! Faces of a body, and conditions on their motion.

use super::formula::Formula;
use super::violation::Violation;
use std::fmt::Debug;
use std::sync::Arc;

/// A condition on a face of the body, checked pointwise.
pub trait Condition: Debug + Send + Sync {
    /// Checks the motion at `point`.
    ///
    /// # Errors
    /// The first violation of the condition.
    fn check(&self, point: &dyn FacePoint) -> Result<(), Violation>;
}

/// A point of a face at one time, with the elementary requirements that make up conditions.
pub trait FacePoint {
    /// Returns the number of space dimensions.
    fn dimension(&self) -> usize;

    /// Returns the axis of the face normal.
    fn axis(&self) -> usize;

    /// Evaluates a formula of the coordinates and t at this point and time.
    fn value(&self, formula: &Formula) -> f64;

    /// Returns `J F^-T n`, the current area vector per reference area. For small strains this is n.
    fn present_area(&self) -> [f64; 3];

    /// Requires `u_i = 0`; `what` describes the face in messages.
    ///
    /// # Errors
    /// If `u_i` is not zero.
    fn held(&self, i: usize, what: &str) -> Result<(), Violation>;

    /// Requires `(u_t)_i = given` (m/s).
    ///
    /// # Errors
    /// If the velocity differs.
    fn velocity(&self, i: usize, given: f64) -> Result<(), Violation>;

    /// Requires `(P n)_i = given` (Pa); `what` describes the face in messages.
    ///
    /// # Errors
    /// If the traction differs.
    fn traction(&self, i: usize, what: &str, given: f64) -> Result<(), Violation>;

    /// Requires u . n = 0 and no tension. The tangential traction must be `coefficient` times the
    /// pressure and opposite to the velocity, or at most `coefficient` times the pressure if the
    /// face does not move.
    ///
    /// # Errors
    /// The first violation.
    fn friction(&self, coefficient: f64) -> Result<(), Violation>;

    /// Requires that x is one period further along the axis than on the opposite face, and that
    /// grad u, and therefore P, is equal on both faces.
    ///
    /// # Errors
    /// The first violation.
    fn continues_on_opposite_face(&self) -> Result<(), Violation>;
}

/// One face of a box-shaped body.
#[derive(Debug, Clone)]
pub struct Face {
    /// Name of the face in suites.
    pub name: &'static str,
    /// Axis of the face normal.
    pub axis: usize,
    /// Whether this is the face with the larger coordinate.
    pub high: bool,
    /// Period along the face normal (m), if the axis is periodic: the length of the reference body,
    /// unless the body starts deformed.
    pub period: f64,
    /// Condition on the motion of the face.
    pub condition: Arc<dyn Condition>,
}

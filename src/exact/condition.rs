//! Faces of a body, and conditions on the motion there.

use super::formula::Formula;
use super::violation::Violation;
use std::fmt::Debug;
use std::sync::Arc;

/// A condition on a face of the body, checked point by point.
pub trait Condition: Debug + Send + Sync {
    /// Holds the motion at `point` to the condition.
    ///
    /// # Errors
    /// The first violation.
    fn check(&self, point: &dyn FacePoint) -> Result<(), Violation>;
}

/// A point of a face at a time of the run, with elementary requirements, which form the conditions.
/// There are few of them, because each residual needs a scale of the whole motion.
pub trait FacePoint {
    /// Number of space dimensions.
    fn dimension(&self) -> usize;

    /// Axis of the normal.
    fn axis(&self) -> usize;

    /// A formula of the coordinates and t, here and now.
    fn value(&self, formula: &Formula) -> f64;

    /// `J F^-T n`, the present area per reference area. Where strains are small it is n.
    fn present_area(&self) -> [f64; 3];

    /// `u_i = 0`, on a face that is `what`.
    ///
    /// # Errors
    /// The violation.
    fn held(&self, i: usize, what: &str) -> Result<(), Violation>;

    /// `(u_t)_i = given` (m/s).
    ///
    /// # Errors
    /// The violation.
    fn velocity(&self, i: usize, given: f64) -> Result<(), Violation>;

    /// `(P n)_i = given` (Pa), on a face that is `what`.
    ///
    /// # Errors
    /// The violation.
    fn traction(&self, i: usize, what: &str, given: f64) -> Result<(), Violation>;

    /// u . n = 0 and no tension. The tangential traction is `coefficient` times the pressure,
    /// against the velocity; where the face does not move, it is at most this value.
    ///
    /// # Errors
    /// The first violation.
    fn friction(&self, coefficient: f64) -> Result<(), Violation>;

    /// x lies one period further along the axis than on the opposite face, and grad u, and so P, is
    /// equal on both.
    ///
    /// # Errors
    /// The first violation.
    fn continues_on_opposite_face(&self) -> Result<(), Violation>;
}

/// One face of a box-shaped body.
#[derive(Debug, Clone)]
pub struct Face {
    /// Name that a suite gives it.
    pub name: &'static str,
    /// Axis of its normal.
    pub axis: usize,
    /// Whether it is the face with the larger coordinate.
    pub high: bool,
    /// Length (m) of the axis on which the body moves: its period, if the axis is periodic. It is
    /// that of the body itself, unless a periodic body starts deformed.
    pub period: f64,
    /// Condition on the motion there.
    pub condition: Arc<dyn Condition>,
}

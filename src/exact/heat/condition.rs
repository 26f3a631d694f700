//! Thermal conditions on the faces of a body.

use crate::exact::formula::Formula;
use crate::exact::violation::Violation;
use std::fmt::Debug;

/// A thermal condition on one face of the body, to which the temperature is held point by point.
pub trait ThermalCondition: Debug + Send + Sync {
    /// Holds the temperature at `point` to the condition.
    ///
    /// # Errors
    /// The first violation.
    fn check(&self, point: &dyn HeatFacePoint) -> Result<(), Violation>;
}

/// A point of a face at a time of the run, and what can be demanded of the temperature there: that
/// it has a value, that heat enters, or that it goes on behind the face.
pub trait HeatFacePoint {
    /// A formula of the coordinates and t, here and now.
    fn value(&self, formula: &Formula) -> f64;

    /// The temperature (K).
    fn temperature(&self) -> f64;

    /// Largest temperature in the body (K).
    fn largest_temperature(&self) -> f64;

    /// `T = given` (K).
    ///
    /// # Errors
    /// The violation.
    fn has_temperature(&self, given: f64) -> Result<(), Violation>;

    /// Heat that enters, per reference area (W/m^(D-1)), is `given`: on a face that is `what`,
    /// where `size` is that of the terms that `given` is made of.
    ///
    /// # Errors
    /// The violation.
    fn lets_in(&self, what: &str, given: f64, size: f64) -> Result<(), Violation>;

    /// Temperature and flow of heat are those on the opposite face.
    ///
    /// # Errors
    /// The first violation.
    fn continues_on_opposite_face(&self) -> Result<(), Violation>;
}

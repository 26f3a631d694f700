//! A face that is one and the same with the opposite one, of a body that is periodic.

use super::contract::{BuildThermal, HeatCondition};
use crate::exact::Violation;
use crate::exact::heat::{HeatFacePoint, ThermalCondition};

/// The temperature, and the flow of heat, of the opposite face.
#[derive(Debug)]
pub(crate) struct PeriodicTemperature;

impl ThermalCondition for PeriodicTemperature {
    fn check(&self, point: &dyn HeatFacePoint) -> Result<(), Violation> {
        point.continues_on_opposite_face()
    }
}

impl HeatCondition for PeriodicTemperature {
    fn row(&self) -> Option<String> {
        None
    }
}

impl<const D: usize> BuildThermal<D> for PeriodicTemperature {}

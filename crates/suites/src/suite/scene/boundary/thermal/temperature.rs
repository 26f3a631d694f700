//! A face with a prescribed temperature.

use super::contract::{HeatCondition, ThermalKeys};
use crate::exact::Violation;
use crate::exact::formula::Formula;
use crate::exact::heat::{HeatFacePoint, ThermalCondition};
use crate::mpm::Thermal;
use crate::suite::scene::boundary::FaceEntry;
use crate::suite::scene::numbers::{scalar, with_unit};
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Temperature (K), a formula of the coordinates and t.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub(crate) struct TemperatureSpec(NumberText);

impl ThermalKeys for TemperatureSpec {
    fn compile(&self, entry: &FaceEntry<'_>) -> Result<Arc<dyn HeatCondition>, Diagnostic> {
        Ok(Arc::new(GivenTemperature(entry.path.field(&self.0, entry.dimension)?)))
    }
}

/// The condition `T = value`.
#[derive(Debug)]
struct GivenTemperature(Formula);

impl ThermalCondition for GivenTemperature {
    fn check(&self, point: &dyn HeatFacePoint) -> Result<(), Violation> {
        point.has_temperature(point.value(&self.0))
    }
}

impl HeatCondition for GivenTemperature {
    fn row(&self) -> Option<String> {
        Some(format!("temperature = {}", with_unit(self.0.source(), "K")))
    }

    fn input(&self) -> Option<Thermal> {
        Some(Thermal::Temperature(Box::new(scalar(&self.0))))
    }
}

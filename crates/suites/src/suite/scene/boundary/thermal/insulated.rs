//! Faces without heat flux from outside: insulated faces and periodic faces.

use super::contract::{HeatCondition, ThermalKeys};
use crate::exact::Violation;
use crate::exact::heat::{HeatFacePoint, ThermalCondition};
use crate::suite::scene::boundary::FaceEntry;
use crate::suite::yaml::Diagnostic;
use std::sync::Arc;

/// The condition `Q . n = 0`.
#[derive(Debug)]
pub(crate) struct Insulated;

impl ThermalKeys for Insulated {
    fn compile(&self, _: &FaceEntry<'_>) -> Result<Arc<dyn HeatCondition>, Diagnostic> {
        Ok(Arc::new(Self))
    }
}

impl ThermalCondition for Insulated {
    fn check(&self, point: &dyn HeatFacePoint) -> Result<(), Violation> {
        point.lets_in("is insulated", 0.0, 0.0)
    }
}

impl HeatCondition for Insulated {
    fn row(&self) -> Option<String> {
        Some("insulated".to_owned())
    }
}

/// A face with the temperature and heat flux of the opposite face.
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

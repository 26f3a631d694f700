//! A face with a prescribed heat flux.

use super::contract::{HeatCondition, ThermalKeys};
use crate::exact::Violation;
use crate::exact::formula::Formula;
use crate::exact::heat::{HeatFacePoint, ThermalCondition};
use crate::mpm::Thermal;
use crate::suite::scene::boundary::FaceEntry;
use crate::suite::scene::numbers::{scalar, with_unit};
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Heat flux into the body (W/m^(D-1)), a formula of the coordinates and t.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub(crate) struct FluxSpec(NumberText);

impl ThermalKeys for FluxSpec {
    fn compile(&self, entry: &FaceEntry<'_>) -> Result<Arc<dyn HeatCondition>, Diagnostic> {
        Ok(Arc::new(GivenFlux(entry.path.field(&self.0, entry.dimension)?)))
    }
}

/// The condition `-Q . n = value`, per reference area.
#[derive(Debug)]
struct GivenFlux(Formula);

impl ThermalCondition for GivenFlux {
    fn check(&self, point: &dyn HeatFacePoint) -> Result<(), Violation> {
        let given = point.value(&self.0);
        point.lets_in("has a given flux", given, given.abs())
    }
}

impl HeatCondition for GivenFlux {
    fn row(&self) -> Option<String> {
        Some(format!("heat flux = {} into the body", with_unit(self.0.source(), "W/m2")))
    }

    fn input(&self) -> Option<Thermal> {
        let value = scalar(&self.0);
        Some(Thermal::Inflow(Box::new(move |x, t, _| value(x, t))))
    }
}

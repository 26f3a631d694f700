//! A face that exchanges heat with its surroundings by Newton's law of cooling.

use super::contract::{HeatCondition, ThermalKeys};
use crate::exact::Violation;
use crate::exact::formula::Formula;
use crate::exact::heat::{HeatFacePoint, ThermalCondition};
use crate::mpm::Thermal;
use crate::suite::scene::boundary::FaceEntry;
use crate::suite::scene::numbers::{scalar, with_unit};
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Newton's law of cooling. The ambient temperature is a formula of the coordinates and t.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ConvectionSpec {
    /// Heat transfer coefficient (W/(K m^(D-1))).
    coefficient: NumberText,
    /// Temperature of the surroundings (K).
    ambient: NumberText,
}

impl ThermalKeys for ConvectionSpec {
    fn compile(&self, entry: &FaceEntry<'_>) -> Result<Arc<dyn HeatCondition>, Diagnostic> {
        let (at, what) = (entry.path.then("coefficient"), "the coefficient of convection");
        let coefficient = at.positive(&self.coefficient, what)?;
        let ambient = entry.path.then("ambient").field(&self.ambient, entry.dimension)?;
        Ok(Arc::new(Convection { coefficient, ambient }))
    }
}

/// The condition `-Q . n = coefficient (ambient - T)`, per reference area.
#[derive(Debug)]
struct Convection {
    coefficient: f64,
    ambient: Formula,
}

impl ThermalCondition for Convection {
    fn check(&self, point: &dyn HeatFacePoint) -> Result<(), Violation> {
        let ambient = point.value(&self.ambient);
        let given = self.coefficient * (ambient - point.temperature());
        let size = self.coefficient * point.largest_temperature().max(ambient.abs());
        point.lets_in("is cooled by convection", given, size)
    }
}

impl HeatCondition for Convection {
    fn row(&self) -> Option<String> {
        let Self { coefficient, ambient } = self;
        let ambient = with_unit(ambient.source(), "K");
        Some(format!("convection, {coefficient} W/(m2 K), ambient temperature = {ambient}"))
    }

    fn input(&self) -> Option<Thermal> {
        let (coefficient, ambient) = (self.coefficient, scalar(&self.ambient));
        let flow = move |x: &[f64], t, value| coefficient * (ambient(x, t) - value);
        Some(Thermal::Inflow(Box::new(flow)))
    }
}

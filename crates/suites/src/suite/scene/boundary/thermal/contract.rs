//! Heat conduction in a scene, and thermal conditions on faces.

use crate::exact::formula::Formula;
use crate::exact::heat::{HeatFace, ThermalCondition};
use crate::mpm::Thermal;
use crate::suite::scene::boundary::FaceEntry;
use crate::suite::yaml::Diagnostic;
use std::sync::Arc;

pub(crate) trait ThermalKeys {
    fn compile(&self, entry: &FaceEntry<'_>) -> Result<Arc<dyn HeatCondition>, Diagnostic>;
}

/// Heat conduction with all numbers computed.
#[derive(Debug, Clone)]
pub struct SceneHeat {
    /// Conductivity k (W/(m K), per m^(3-D)).
    pub conductivity: f64,
    /// Heat capacity c (J/(kg K)).
    pub capacity: f64,
    /// Heat source (W/kg), a formula of the coordinates, t and T.
    pub source: Option<Formula>,
    /// Initial temperature (K), a formula; by default the exact temperature at t = 0.
    pub initial: Option<Formula>,
    pub(crate) faces: Vec<ThermalFace>,
}

#[derive(Debug, Clone)]
pub(crate) struct ThermalFace {
    pub(crate) name: &'static str,
    pub(crate) axis: usize,
    pub(crate) high: bool,
    pub(crate) condition: Arc<dyn HeatCondition>,
}

impl ThermalFace {
    pub(crate) fn exact(&self) -> HeatFace {
        let Self { name, axis, high, condition } = self;
        HeatFace { name, axis: *axis, high: *high, condition: condition.clone() }
    }
}

/// A thermal condition on one face of the body, with all numbers computed.
pub(crate) trait HeatCondition: ThermalCondition + 'static {
    /// Returns the condition for the solver; `None` if no heat enters.
    fn input(&self) -> Option<Thermal> {
        None
    }

    /// Returns the text for the report row of the face; `None` for a periodic face.
    fn row(&self) -> Option<String>;
}

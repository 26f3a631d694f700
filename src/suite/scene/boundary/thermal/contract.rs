//! Conduction of heat in a scene, and thermal conditions on faces: the keys in a suite, and the
//! checked condition.

use crate::dimension::in_every_dimension;
use crate::exact::formula::Formula;
use crate::exact::heat::{HeatFace, ThermalCondition};
use crate::mpm::Thermal;
use crate::suite::scene::boundary::FaceEntry;
use crate::suite::yaml::Diagnostic;
use std::sync::Arc;

/// Keys of a thermal condition on a face, in suites.
pub(crate) trait ThermalKeys {
    /// The condition, checked, with every number computed.
    ///
    /// # Errors
    /// The first error in its keys.
    fn compile(&self, entry: &FaceEntry<'_>) -> Result<Arc<dyn HeatCondition>, Diagnostic>;

    /// Whether heat can enter.
    fn lets_heat_in(&self) -> bool {
        true
    }
}

/// Conduction of heat, with every number computed.
#[derive(Debug, Clone)]
pub struct SceneHeat {
    /// k (W/(m K), per m^(3-D)).
    pub conductivity: f64,
    /// c (J/(kg K)).
    pub capacity: f64,
    /// Heat that arises (W/kg), a formula of the coordinates, t and T.
    pub source: Option<Formula>,
    /// Initial temperature (K), a formula of the coordinates and t; default: that of the exact
    /// solution.
    pub initial: Option<Formula>,
    /// Every face of the body.
    pub(crate) faces: Vec<ThermalFace>,
}

/// One face of a body in which heat flows.
#[derive(Debug, Clone)]
pub(crate) struct ThermalFace {
    pub(crate) name: &'static str,
    pub(crate) axis: usize,
    pub(crate) high: bool,
    pub(crate) condition: Arc<dyn HeatCondition>,
}

impl ThermalFace {
    /// The face of the exact heat problem.
    pub(crate) fn exact(&self) -> HeatFace {
        let Self { name, axis, high, condition } = self;
        HeatFace { name, axis: *axis, high: *high, condition: condition.clone() }
    }
}

/// A thermal condition of a scene as one of the solver.
pub(crate) trait BuildThermal<const D: usize> {
    /// The condition; `None` if no heat enters.
    fn build(&self) -> Option<Thermal<D>> {
        None
    }
}

in_every_dimension! {
    /// A thermal condition of a scene as one of the solver in any dimension.
    BuildThermals: BuildThermal
}

/// Thermal condition on one face of the body, with computed numbers: the contract of the family,
/// whose members are in `suite/scene/boundary/thermal`.
pub(crate) trait HeatCondition: BuildThermals + ThermalCondition + 'static {
    /// Value of its row in reports; `None` for a periodic face.
    fn row(&self) -> Option<String>;
}

/// `condition` for the solver in D dimensions.
pub(crate) fn build<const D: usize>(condition: &Arc<dyn HeatCondition>) -> Option<Thermal<D>> {
    let condition: Arc<dyn BuildThermals> = condition.clone();
    condition.in_dimension::<D>()?.build()
}

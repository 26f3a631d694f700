//! The words of a thermal condition.

use crate::suite::compile::boundary::contract::FaceEntry;
use crate::suite::model::heat::HeatCondition;
use crate::suite::yaml::Diagnostic;
use std::sync::Arc;

/// Words of the thermal condition on a face, as suites write them.
pub(crate) trait ThermalWords {
    /// The condition, checked, with every number computed.
    ///
    /// # Errors
    /// The first word that is wrong.
    fn compile(&self, entry: &FaceEntry<'_>) -> Result<Arc<dyn HeatCondition>, Diagnostic>;

    /// Whether heat can enter.
    fn lets_heat_in(&self) -> bool {
        true
    }
}

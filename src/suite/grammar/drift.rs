//! Bounds on the errors of conserved totals.

use crate::suite::yaml::NumberText;
use serde::Deserialize;

/// Bounds on the relative drift of sums over the body.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct DriftSpec {
    pub(crate) mass: Option<NumberText>,
    pub(crate) momentum: Option<NumberText>,
    pub(crate) angular_momentum: Option<NumberText>,
    pub(crate) kinetic_energy: Option<NumberText>,
    pub(crate) kinetic_energy_gain: Option<NumberText>,
    pub(crate) energy: Option<NumberText>,
}

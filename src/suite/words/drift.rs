//! The words of bounds on what a run keeps.

use crate::suite::yaml::NumberText;
use serde::Deserialize;

/// Bounds on the relative drift of sums over the body.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct DriftWords {
    pub(in crate::suite) mass: Option<NumberText>,
    pub(in crate::suite) momentum: Option<NumberText>,
    pub(in crate::suite) angular_momentum: Option<NumberText>,
    pub(in crate::suite) kinetic_energy: Option<NumberText>,
    pub(in crate::suite) kinetic_energy_gain: Option<NumberText>,
    pub(in crate::suite) energy: Option<NumberText>,
}

//! Keys of an internal-force study.

use super::StudyName;
use crate::mpm::BasisName;
use crate::suite::yaml::{NumberText, OneOrMany};
use serde::Deserialize;

study_spec! {
    /// A study of the internal force.
    struct InternalForceSpec {
        /// Kind of study: `internal_force`.
        study: StudyName,
        /// The set-up.
        internal_force: ForceSpec,
        /// Basis functions that are compared.
        methods: Vec<ForceMethodSpec>,
        /// Expectations, exactly one for each case. A suite without expectations is not a gate.
        #[serde(default)]
        expect: Vec<ForceExpectSpec>,
    }
}

/// The set-up of an internal-force study.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ForceSpec {
    /// Cell size (m).
    pub(crate) cell: NumberText,
    /// Particles per cell.
    pub(crate) ppc: NumberText,
    /// Volume of a particle (m).
    pub(crate) volume: NumberText,
    /// Uniform stress (Pa).
    pub(crate) stress: NumberText,
    /// Number of positions of the particles within a cell.
    pub(crate) positions: NumberText,
    /// Predicted force, a formula.
    pub(crate) prediction: NumberText,
}

/// A method of an internal-force study.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum ForceMethodSpec {
    Mpm { basis: OneOrMany<BasisName> },
}

/// An expectation of an internal-force study.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ForceExpectSpec {
    /// Cases that it speaks of, `*` standing for any text; all unless stated.
    pub(crate) case: Option<OneOrMany<String>>,
    /// Largest deviation from the prediction, relative to the largest prediction.
    pub(crate) agrees_within: Option<NumberText>,
    /// Largest change between neighbouring positions, relative to the largest prediction.
    pub(crate) steps_below: Option<NumberText>,
    /// The reason for expecting it.
    pub(crate) because: String,
}

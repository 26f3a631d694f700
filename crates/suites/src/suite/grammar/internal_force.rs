//! Keys of an internal-force study.

use super::StudyName;
use crate::mpm::BasisName;
use crate::suite::yaml::{NumberText, OneOrMany};
use serde::Deserialize;

study_spec! {
    /// A study of the internal force on a node while one particle moves past the node.
    struct InternalForceSpec {
        /// Kind of study: `internal_force`.
        study: StudyName,
        /// Cells, particles, stress and predicted force.
        internal_force: ForceSpec,
        /// Basis functions to be tested.
        methods: Vec<ForceMethodSpec>,
        /// Expected results. Each case needs exactly one matching entry. Without this key, cases
        /// neither pass nor fail.
        #[serde(default)]
        expect: Vec<ForceExpectSpec>,
    }
}

/// Set-up of an internal-force study: equal particles under one stress in two cells.
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
    /// Number of positions of the moving particle at which the force is computed.
    pub(crate) positions: NumberText,
    /// Predicted force (N), a formula of `n_left` and `n_right`, the numbers of particles in the
    /// cells on the left and on the right of the node.
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
    /// Names of the cases, with `*` for any text; default: all cases.
    pub(crate) case: Option<OneOrMany<String>>,
    /// Maximum deviation from the prediction, relative to the largest prediction.
    pub(crate) agrees_within: Option<NumberText>,
    /// Maximum change between neighbouring positions, relative to the largest prediction.
    pub(crate) steps_below: Option<NumberText>,
    /// Reason for the expectation.
    pub(crate) because: String,
}

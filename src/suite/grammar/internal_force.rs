//! Keys of an internal-force study.

use super::ParameterSpec;
use super::StudyName;
use crate::mpm::BasisName;
use crate::suite::yaml::{NumberText, OneOrMany, Ordered};
use serde::Deserialize;

/// A study of the internal force.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct InternalForceSpec {
    pub(crate) suite: String,
    #[serde(rename = "study")]
    pub(crate) _study: StudyName,
    pub(crate) title: String,
    pub(crate) source: String,
    #[serde(default)]
    pub(crate) about: String,
    #[serde(default)]
    pub(crate) parameters: Ordered<ParameterSpec>,
    #[serde(default)]
    pub(crate) functions: Ordered<String>,
    pub(crate) internal_force: ForceSpec,
    pub(crate) methods: Vec<ForceMethodSpec>,
    /// Empty: the suite explores, and is no gate.
    #[serde(default)]
    pub(crate) expect: Vec<ForceExpectSpec>,
}

/// The set-up of an internal-force study.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ForceSpec {
    pub(crate) cell: NumberText,
    pub(crate) ppc: NumberText,
    pub(crate) volume: NumberText,
    pub(crate) stress: NumberText,
    pub(crate) positions: NumberText,
    pub(crate) prediction: NumberText,
}

/// A method of an internal-force study.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum ForceMethodSpec {
    Mpm { basis: OneOrMany<BasisName> },
}

/// An expectation of an internal-force study.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ForceExpectSpec {
    pub(crate) case: Option<OneOrMany<String>>,
    /// Largest deviation from the prediction, relative to the largest prediction.
    pub(crate) agrees_within: Option<NumberText>,
    /// Largest change between neighbouring positions, relative to the largest prediction.
    pub(crate) steps_below: Option<NumberText>,
    pub(crate) because: String,
}

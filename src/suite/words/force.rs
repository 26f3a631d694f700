//! The words of an internal-force study.

use super::StudyName;
use crate::{
    mpm::BasisName,
    suite::yaml::{NumberText, OneOrMany, Ordered},
};
use serde::Deserialize;

/// A study of the internal force.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct InternalForceWords {
    pub(in crate::suite) suite: String,
    #[serde(rename = "study")]
    pub(in crate::suite) _study: StudyName,
    pub(in crate::suite) title: String,
    pub(in crate::suite) source: String,
    #[serde(default)]
    pub(in crate::suite) about: String,
    #[serde(default)]
    pub(in crate::suite) parameters: Ordered<NumberText>,
    #[serde(default)]
    pub(in crate::suite) functions: Ordered<String>,
    pub(in crate::suite) internal_force: ForceWords,
    pub(in crate::suite) methods: Vec<ForceMethodWords>,
    pub(in crate::suite) expect: Vec<ForceExpectWords>,
}

/// The set-up of an internal-force study.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct ForceWords {
    pub(in crate::suite) cell: NumberText,
    pub(in crate::suite) ppc: NumberText,
    pub(in crate::suite) volume: NumberText,
    pub(in crate::suite) stress: NumberText,
    pub(in crate::suite) positions: NumberText,
    pub(in crate::suite) prediction: NumberText,
}

/// A method of an internal-force study.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(in crate::suite) enum ForceMethodWords {
    Mpm { basis: OneOrMany<BasisName> },
}

/// An expectation of an internal-force study.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct ForceExpectWords {
    pub(in crate::suite) case: Option<OneOrMany<String>>,
    /// Largest deviation from the prediction, relative to the largest prediction.
    pub(in crate::suite) agrees_within: Option<NumberText>,
    /// Largest change between neighbouring positions, relative to the largest prediction.
    pub(in crate::suite) steps_below: Option<NumberText>,
    pub(in crate::suite) because: String,
}

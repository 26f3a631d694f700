//! Kind of study of a suite.

use serde::Deserialize;

/// Keys that every suite has, whatever it studies.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub(crate) struct Head {
    #[serde(default = "StudyName::default_study")]
    pub(crate) study: StudyName,
}

/// Kinds of study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum StudyName {
    /// Errors over a refinement plan.
    Convergence,
    /// Internal force on a node while a particle moves through it.
    InternalForce,
    /// Whether runs stay bounded, and up to which value of a parameter.
    Stability,
}

impl StudyName {
    pub(super) fn default_study() -> Self {
        Self::Convergence
    }
}

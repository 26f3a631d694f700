//! Keys of a spectrum study.

use super::{MethodSpec, SceneSpec, StudyName};
use crate::suite::yaml::{NumberText, OneOrMany, Ordered};
use serde::Deserialize;

study_spec! {
    /// A study of the phase speed and the damping of waves.
    struct SpectrumSpec {
        /// Kind of study: `spectrum`.
        study: StudyName,
        /// Body, material and periodic boundary.
        scene: SceneSpec,
        /// Cells and particles.
        particles: RowSpec,
        /// Wavelengths and time steps.
        spectrum: WavesSpec,
        /// Methods to be tested. Each combination of list values is a case.
        methods: Vec<MethodSpec>,
        /// Expected results. Each case needs exactly one matching entry. Without this key, cases
        /// neither pass nor fail.
        #[serde(default)]
        expect: Vec<SpectrumExpectSpec>,
    }
}

/// A row of cells with the same particles in each cell.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct RowSpec {
    /// Number of cells.
    pub(crate) cells: NumberText,
    /// Particles per cell.
    pub(crate) ppc: NumberText,
    /// Translation of every particle (m), less than half the particle spacing.
    pub(crate) shift: Option<Vec<NumberText>>,
}

/// Wavelengths and time steps. Each combination is a row of the report.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct WavesSpec {
    /// Wavelengths (cells).
    pub(crate) cells_per_wavelength: OneOrMany<NumberText>,
    /// Courant numbers `c dt/h`.
    pub(crate) courant: OneOrMany<NumberText>,
    /// External solvers, each with the case that predicts its results.
    #[serde(default)]
    pub(crate) solvers: Ordered<String>,
}

/// An expectation of a spectrum study.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SpectrumExpectSpec {
    /// Names of the cases, with `*` for any text; default: all cases.
    pub(crate) case: Option<OneOrMany<String>>,
    /// Maximum deviation of the phase error from the prediction, relative to the prediction.
    pub(crate) phase_within: Option<NumberText>,
    /// Maximum deviation of the logarithm of the amplitude per period from the prediction,
    /// relative to the prediction.
    pub(crate) damping_within: Option<NumberText>,
    /// Reason for the expectation.
    pub(crate) because: String,
}

//! The words of a stability study.

use super::{MethodWords, SceneWords, StepWords, StudyName};
use crate::{
    suite::yaml::{NumberText, OneOrMany, Ordered},
    verify::Stability,
};
use serde::Deserialize;

/// A stability study.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct StabilityWords {
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
    pub(in crate::suite) scene: SceneWords,
    pub(in crate::suite) particles: ParticleWords,
    pub(in crate::suite) run: StabilityRunWords,
    /// One parameter, and the values that it takes.
    pub(in crate::suite) sweep: Ordered<OneOrMany<NumberText>>,
    pub(in crate::suite) critical: Option<CriticalWords>,
    /// Figures that the report shows.
    #[serde(default)]
    pub(in crate::suite) show: Vec<crate::verify::RunFigure>,
    pub(in crate::suite) methods: Vec<MethodWords>,
    pub(in crate::suite) expect: Vec<StabilityExpectWords>,
}

/// How the body is filled.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct ParticleWords {
    pub(in crate::suite) cells: NumberText,
    pub(in crate::suite) ppc: NumberText,
    /// What every particle is moved by (m), before anything starts.
    pub(in crate::suite) shift: Option<Vec<NumberText>>,
    /// Places (m) of further particles, each with the volume of the others.
    #[serde(default)]
    pub(in crate::suite) extra: Vec<Vec<NumberText>>,
}

/// How it is run.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct StabilityRunWords {
    pub(in crate::suite) dt: StepWords,
    /// Another length of a step, which takes turns with `dt`.
    pub(in crate::suite) alternate: Option<NumberText>,
    /// Steps of one length before it is the turn of the other.
    pub(in crate::suite) every: Option<NumberText>,
    pub(in crate::suite) steps: NumberText,
    /// Steps of a full run, where that takes more.
    pub(in crate::suite) full_steps: Option<NumberText>,
    /// Whether particles stay where they are.
    #[serde(default)]
    pub(in crate::suite) frozen: bool,
    /// Size of random perturbations of the state at the start.
    pub(in crate::suite) perturb: Option<NumberText>,
    pub(in crate::suite) stable_below: Option<NumberText>,
    pub(in crate::suite) unstable_above: Option<NumberText>,
}

/// The parameter whose limit is sought, and where.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct CriticalWords {
    pub(in crate::suite) parameter: String,
    pub(in crate::suite) from: NumberText,
    pub(in crate::suite) to: NumberText,
}

/// An expectation of a stability study.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct StabilityExpectWords {
    pub(in crate::suite) case: Option<OneOrMany<String>>,
    /// Of every row, or one for each.
    pub(in crate::suite) verdict: Option<OneOrMany<Stability>>,
    /// The limit that is sought.
    pub(in crate::suite) critical: Option<FigureWords>,
    #[serde(default)]
    pub(in crate::suite) figures: Ordered<FigureWords>,
    pub(in crate::suite) because: String,
}

/// What a figure must be.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct FigureWords {
    /// A closed form, of the parameters.
    pub(in crate::suite) is: Option<NumberText>,
    /// Largest deviation from it: a share of it, or of one if it is smaller.
    pub(in crate::suite) within: Option<NumberText>,
    pub(in crate::suite) above: Option<NumberText>,
    pub(in crate::suite) below: Option<NumberText>,
}

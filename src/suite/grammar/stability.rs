//! Keys of a stability study.

use super::ParameterSpec;
use super::{MethodSpec, SceneSpec, StepSpec, StudyName};
use crate::suite::yaml::{NumberText, OneOrMany, Ordered};
use crate::verify::Stability;
use serde::Deserialize;

/// A stability study.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct StabilitySpec {
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
    pub(crate) scene: SceneSpec,
    pub(crate) particles: ParticleSpec,
    pub(crate) run: StabilityRunSpec,
    /// One parameter, and the values that it takes.
    pub(crate) sweep: Ordered<OneOrMany<NumberText>>,
    pub(crate) critical: Option<CriticalSpec>,
    /// Figures that the report shows.
    #[serde(default)]
    pub(crate) show: Vec<crate::verify::RunFigure>,
    pub(crate) methods: Vec<MethodSpec>,
    /// Empty: the suite explores, and is no gate.
    #[serde(default)]
    pub(crate) expect: Vec<StabilityExpectSpec>,
}

/// How the body is filled.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ParticleSpec {
    pub(crate) cells: NumberText,
    pub(crate) ppc: NumberText,
    /// Translation of every particle (m) before the start.
    pub(crate) shift: Option<Vec<NumberText>>,
    /// Places (m) of further particles, each with the volume of the others.
    #[serde(default)]
    pub(crate) extra: Vec<Vec<NumberText>>,
}

/// How it is run.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct StabilityRunSpec {
    pub(crate) dt: StepSpec,
    /// Another length of a step, which takes turns with `dt`.
    pub(crate) alternate: Option<NumberText>,
    /// Steps of one length before it is the turn of the other.
    pub(crate) every: Option<NumberText>,
    pub(crate) steps: NumberText,
    /// Steps of a full run, where that takes more.
    pub(crate) full_steps: Option<NumberText>,
    /// Whether particles stay where they are.
    #[serde(default)]
    pub(crate) frozen: bool,
    /// Size of random perturbations of the state at the start.
    pub(crate) perturb: Option<NumberText>,
    pub(crate) stable_below: Option<NumberText>,
    pub(crate) unstable_above: Option<NumberText>,
}

/// The parameter whose limit is sought, and where.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CriticalSpec {
    pub(crate) parameter: String,
    pub(crate) from: NumberText,
    pub(crate) to: NumberText,
}

/// An expectation of a stability study.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct StabilityExpectSpec {
    pub(crate) case: Option<OneOrMany<String>>,
    /// Of every row, or one for each.
    pub(crate) verdict: Option<OneOrMany<Stability>>,
    /// The limit that is sought.
    pub(crate) critical: Option<FigureSpec>,
    #[serde(default)]
    pub(crate) figures: Ordered<FigureSpec>,
    pub(crate) because: String,
}

/// Bounds on a figure.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FigureSpec {
    /// A closed form, of the parameters.
    pub(crate) is: Option<NumberText>,
    /// Largest deviation from it: a share of it, or of one if it is smaller.
    pub(crate) within: Option<NumberText>,
    pub(crate) above: Option<NumberText>,
    pub(crate) below: Option<NumberText>,
}

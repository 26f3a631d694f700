//! The grammar of a suite: what may stand in a YAML file, before any number is known.
//!
//! Every map refuses keys that it does not know. A number may be a formula of declared parameters;
//! a method's entries may be lists, whose product gives the cases.

use super::yaml::{NumberText, OneOrMany, Ordered};
use crate::{
    fem::{Element, Mass, Sampling},
    mpm::{BasisName, SchemeName, TransferName},
    named::named,
    subject::Start,
};
use serde::Deserialize;

/// What every suite has, whatever it studies.
#[derive(Debug, Clone, Deserialize)]
pub(super) struct Head {
    #[serde(default = "StudyName::default_study")]
    pub(super) study: StudyName,
}

/// Kinds of study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum StudyName {
    /// Errors over a refinement plan.
    Convergence,
    /// Internal force on a node while a particle moves through it.
    InternalForce,
}

impl StudyName {
    fn default_study() -> Self {
        Self::Convergence
    }
}

/// A convergence study.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ConvergenceWords {
    pub(super) suite: String,
    #[serde(rename = "study")]
    pub(super) _study: Option<StudyName>,
    pub(super) title: String,
    pub(super) source: String,
    #[serde(default)]
    pub(super) about: String,
    #[serde(default)]
    pub(super) parameters: Ordered<NumberText>,
    #[serde(default)]
    pub(super) functions: Ordered<String>,
    pub(super) scene: SceneWords,
    pub(super) exact: Option<ExactWords>,
    pub(super) reference: Option<ReferenceWords>,
    pub(super) run: RunWords,
    pub(super) refine: RefineWords,
    pub(super) methods: Vec<MethodWords>,
    #[serde(default)]
    pub(super) judge: JudgeWords,
    pub(super) observe: Option<ObserveWords>,
    pub(super) expect: Vec<ExpectWords>,
}

/// A study of the internal force.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct InternalForceWords {
    pub(super) suite: String,
    #[serde(rename = "study")]
    pub(super) _study: StudyName,
    pub(super) title: String,
    pub(super) source: String,
    #[serde(default)]
    pub(super) about: String,
    #[serde(default)]
    pub(super) parameters: Ordered<NumberText>,
    #[serde(default)]
    pub(super) functions: Ordered<String>,
    pub(super) internal_force: ForceWords,
    pub(super) methods: Vec<ForceMethodWords>,
    pub(super) expect: Vec<ForceExpectWords>,
}

/// The set-up of an internal-force study.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ForceWords {
    pub(super) cell: NumberText,
    pub(super) ppc: NumberText,
    pub(super) volume: NumberText,
    pub(super) stress: NumberText,
    pub(super) positions: NumberText,
    pub(super) prediction: NumberText,
}

/// A method of an internal-force study.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum ForceMethodWords {
    Mpm { basis: OneOrMany<BasisName> },
}

/// An expectation of an internal-force study.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ForceExpectWords {
    pub(super) case: Option<OneOrMany<String>>,
    /// Largest deviation from the prediction, relative to the largest prediction.
    pub(super) agrees_within: NumberText,
    pub(super) because: String,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SceneWords {
    pub(super) dimension: NumberText,
    pub(super) body: BodyWords,
    pub(super) grid: Option<BoxWords>,
    pub(super) material: MaterialWords,
    #[serde(default)]
    pub(super) boundary: Ordered<BoundaryName>,
    pub(super) initial_velocity: Option<Vec<NumberText>>,
    #[serde(default)]
    pub(super) loads: Vec<LoadWords>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum BodyWords {
    Box(BoxWords),
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BoxWords {
    pub(super) from: Vec<NumberText>,
    pub(super) to: Vec<NumberText>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum MaterialWords {
    LinearElastic { young: NumberText, poisson: NumberText, density: NumberText },
}

/// Boundary conditions on a face; a face that is not named is free.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum BoundaryName {
    /// No displacement.
    Fixed,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum LoadWords {
    /// Uniform acceleration (m/s2), formulas of t.
    Gravity(Vec<NumberText>),
    /// Force per reference area on one face (Pa), formulas of t.
    Traction { on: String, value: Vec<NumberText> },
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ExactWords {
    pub(super) equation: EquationName,
    pub(super) displacement: Vec<NumberText>,
    pub(super) tolerance: Option<NumberText>,
}

named! {
    /// Equations of motion, by their law between stress and strain.
    pub enum EquationName {
        /// `P = E u_X`: the linear problem of the talk.
        SmallStrain = "small_strain",
        /// `P = E ln F`: what the rate form of the original MPM integrates to in 1-D.
        LogStrain = "log_strain",
    }
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ReferenceWords {
    pub(super) equation: EquationName,
    pub(super) fem: ReferenceFemWords,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ReferenceFemWords {
    pub(super) element: Element,
    pub(super) mass: Mass,
    pub(super) cells: NumberText,
    pub(super) dt: NumberText,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RunWords {
    pub(super) until: OneOrMany<NumberText>,
    pub(super) dt: NumberText,
    pub(super) instants: Option<NumberText>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RefineWords {
    pub(super) cells: OneOrMany<NumberText>,
    pub(super) ppc: Option<NumberText>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum MethodWords {
    Mpm {
        basis: OneOrMany<BasisName>,
        transfer: OneOrMany<TransferName>,
        scheme: OneOrMany<SchemeName>,
        start: Option<OneOrMany<Start>>,
    },
    Fem {
        element: OneOrMany<Element>,
        mass: OneOrMany<Mass>,
        law: Option<OneOrMany<EquationName>>,
        start: Option<OneOrMany<Start>>,
        sampling: Option<OneOrMany<Sampling>>,
    },
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct JudgeWords {
    #[serde(default)]
    pub(super) norm: NormName,
    #[serde(default)]
    pub(super) crossing_levels: CrossingLevels,
}

named! {
    /// The error that is judged.
    #[derive(Default)]
    pub enum NormName {
        /// RMS over labels at the end: the measure of the talk.
        #[default]
        Rms = "rms",
        /// Mean, weighted by volume, at the end.
        L1 = "l1",
        /// RMS, weighted by volume, at the end.
        L2 = "l2",
        /// Largest at the end.
        Linf = "linf",
        /// Largest RMS over the instants.
        MaxRms = "max_rms",
    }
}

named! {
    /// Whether levels on which particles changed their cell may count.
    #[derive(Default)]
    pub enum CrossingLevels {
        /// They count like others.
        #[default]
        Counted = "counted",
        /// They are shown and do not count.
        Excluded = "excluded",
    }
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ObserveWords {
    pub(super) at: Vec<NumberText>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ExpectWords {
    pub(super) case: Option<OneOrMany<String>>,
    pub(super) verdict: Option<String>,
    pub(super) order: Option<Vec<NumberText>>,
    pub(super) finest_pair: Option<Vec<NumberText>>,
    pub(super) crossings: Option<CrossingsName>,
    pub(super) because: String,
}

/// Whether particles change their cell on the finest level.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum CrossingsName {
    /// None does.
    None,
    /// At least one does.
    Some,
}

//! The grammar of a suite: what may stand in a YAML file, before any number is known.
//!
//! Every map refuses keys that it does not know. A number may be a formula of declared parameters;
//! a method's entries may be lists, whose product gives the cases.

pub(crate) mod drift;
pub(crate) mod head;
pub(crate) mod internal_force;
pub(crate) mod refine;
pub(crate) mod scene;
pub(crate) mod stability;
pub(crate) mod step;
pub(crate) mod transfer;
pub(crate) mod truth;

pub(crate) use drift::DriftWords;
pub(crate) use head::{Head, StudyName};
pub(crate) use internal_force::{ForceExpectWords, ForceMethodWords, InternalForceWords};
pub(crate) use refine::{RefineWords, RunWords};
pub(crate) use scene::{
    AnnulusWords, BodyWords, BoundaryWords, BoxWords, ExpansionWords, HeatWords, LoadWords,
    OneBodyWords, QuadrilateralWords, RoundWords, SceneWords, SetWords, ThermalWords,
    ViscosityWords,
};
pub(crate) use stability::{FigureWords, StabilityExpectWords, StabilityWords};
pub(crate) use step::StepWords;
pub use truth::EquationName;
pub(crate) use truth::{ExactWords, ManufacturedWords};

use super::yaml::{NumberText, OneOrMany, Ordered};
use crate::{
    fem::{Element, Mass, Sampling},
    mpm::{BasisName, FrameName, MassName, SchemeName, TransferChoice},
    named::named,
    subject::Start,
    verify::{FloorCause, Quantity},
};
use serde::Deserialize;

/// A convergence study.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ConvergenceWords {
    pub(crate) suite: String,
    #[serde(rename = "study")]
    pub(crate) _study: Option<StudyName>,
    pub(crate) title: String,
    pub(crate) source: String,
    #[serde(default)]
    pub(crate) about: String,
    #[serde(default)]
    pub(crate) parameters: Ordered<NumberText>,
    #[serde(default)]
    pub(crate) functions: Ordered<String>,
    pub(crate) scene: SceneWords,
    pub(crate) exact: Option<ExactWords>,
    pub(crate) manufactured: Option<ManufacturedWords>,
    pub(crate) equilibrium: Option<ExactWords>,
    pub(crate) reference: Option<ReferenceWords>,
    pub(crate) run: RunWords,
    pub(crate) refine: RefineWords,
    pub(crate) methods: Vec<MethodWords>,
    #[serde(default)]
    pub(crate) judge: JudgeWords,
    pub(crate) observe: Option<ObserveWords>,
    pub(crate) expect: Vec<ExpectWords>,
}

impl ConvergenceWords {
    /// Number of the first entry of `methods` that is an FEM.
    pub(crate) fn fem_method(&self) -> Option<usize> {
        self.methods.iter().position(|method| matches!(method, MethodWords::Fem { .. }))
    }

    /// Whether a fine FEM computation is asked for.
    pub(crate) fn has_fem_reference(&self) -> bool {
        self.reference.as_ref().is_some_and(|reference| reference.fem.is_some())
    }
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReferenceWords {
    pub(crate) equation: Option<EquationName>,
    pub(crate) fem: Option<ReferenceFemWords>,
    pub(crate) same_method: Option<SameMethodWords>,
}

/// The same method with shorter steps.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SameMethodWords {
    pub(crate) dt: NumberText,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReferenceFemWords {
    pub(crate) element: Element,
    pub(crate) mass: Mass,
    pub(crate) cells: NumberText,
    pub(crate) dt: NumberText,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum MethodWords {
    Mpm {
        basis: OneOrMany<BasisName>,
        transfer: OneOrMany<TransferChoice>,
        scheme: OneOrMany<SchemeName>,
        start: Option<OneOrMany<Start>>,
        mass: Option<OneOrMany<MassName>>,
        frame: Option<OneOrMany<FrameName>>,
    },
    Fem {
        element: OneOrMany<Element>,
        mass: OneOrMany<Mass>,
        law: Option<OneOrMany<EquationName>>,
        start: Option<OneOrMany<Start>>,
        sampling: Option<OneOrMany<Sampling>>,
    },
    /// MPM of a body at rest, in which heat flows.
    Heat { basis: OneOrMany<BasisName> },
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct JudgeWords {
    #[serde(default)]
    pub(crate) of: Quantity,
    #[serde(default)]
    pub(crate) norm: NormName,
    /// What the error is divided by before it is judged.
    pub(crate) scale: Option<NumberText>,
    #[serde(default)]
    pub(crate) crossing_levels: CrossingLevels,
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
        /// Largest L1 over the instants.
        MaxL1 = "max_l1",
        /// Largest L2 over the instants.
        MaxL2 = "max_l2",
        /// Largest over labels and instants.
        MaxLinf = "max_linf",
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
pub(crate) struct ObserveWords {
    pub(crate) at: Vec<NumberText>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ExpectWords {
    pub(crate) case: Option<OneOrMany<String>>,
    pub(crate) verdict: Option<String>,
    pub(crate) order: Option<Vec<NumberText>>,
    pub(crate) finest_pair: Option<Vec<NumberText>>,
    pub(crate) crossings: Option<CrossingsName>,
    pub(crate) floor: Option<FloorCause>,
    /// Bounds on the judged error of every level that counts.
    pub(crate) error_below: Option<NumberText>,
    pub(crate) error_above: Option<NumberText>,
    /// Distance (m) of the observed place from the exact one, at the end, on the finest level.
    pub(crate) observed_within: Option<NumberText>,
    /// Largest speed towards the end of every level that counts, over the wave speed.
    pub(crate) rest_below: Option<NumberText>,
    pub(crate) drift: Option<DriftWords>,
    /// Bounds on the rate of the energy (1/s).
    pub(crate) energy_rate: Option<Vec<NumberText>>,
    pub(crate) because: String,
    /// What is expected of a full run, where that differs.
    pub(crate) full: Option<Box<ExpectWords>>,
}

/// Whether particles change their cell on the finest level.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum CrossingsName {
    /// None does.
    None,
    /// At least one does.
    Some,
}

//! The grammar of a suite: what may stand in a YAML file, before any number is known.
//!
//! Every map refuses keys that it does not know. A number may be a formula of declared parameters;
//! a method's entries may be lists, whose product gives the cases.

mod drift;
mod force;
mod head;
mod refine;
mod scene;
mod stability;
mod step;
mod transfer;
mod truth;

pub(in crate::suite) use drift::DriftWords;
pub(in crate::suite) use force::{ForceExpectWords, ForceMethodWords, InternalForceWords};
pub(in crate::suite) use head::{Head, StudyName};
pub(in crate::suite) use refine::{RefineWords, RunWords};
pub(in crate::suite) use scene::{
    AnnulusWords, BodyWords, BoundaryWords, BoxWords, ExpansionWords, HeatWords, LoadWords,
    OneBodyWords, QuadrilateralWords, RoundWords, SceneWords, SetWords, ThermalWords,
    ViscosityWords,
};
pub(in crate::suite) use stability::{FigureWords, StabilityExpectWords, StabilityWords};
pub(in crate::suite) use step::StepWords;
pub use truth::EquationName;
pub(in crate::suite) use truth::{ExactWords, ManufacturedWords};

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
pub(in crate::suite) struct ConvergenceWords {
    pub(in crate::suite) suite: String,
    #[serde(rename = "study")]
    pub(in crate::suite) _study: Option<StudyName>,
    pub(in crate::suite) title: String,
    pub(in crate::suite) source: String,
    #[serde(default)]
    pub(in crate::suite) about: String,
    #[serde(default)]
    pub(in crate::suite) parameters: Ordered<NumberText>,
    #[serde(default)]
    pub(in crate::suite) functions: Ordered<String>,
    pub(in crate::suite) scene: SceneWords,
    pub(in crate::suite) exact: Option<ExactWords>,
    pub(in crate::suite) manufactured: Option<ManufacturedWords>,
    pub(in crate::suite) equilibrium: Option<ExactWords>,
    pub(in crate::suite) reference: Option<ReferenceWords>,
    pub(in crate::suite) run: RunWords,
    pub(in crate::suite) refine: RefineWords,
    pub(in crate::suite) methods: Vec<MethodWords>,
    #[serde(default)]
    pub(in crate::suite) judge: JudgeWords,
    pub(in crate::suite) observe: Option<ObserveWords>,
    pub(in crate::suite) expect: Vec<ExpectWords>,
}

impl ConvergenceWords {
    /// Number of the first entry of `methods` that is an FEM.
    pub(in crate::suite) fn fem_method(&self) -> Option<usize> {
        self.methods.iter().position(|method| matches!(method, MethodWords::Fem { .. }))
    }

    /// Whether a fine FEM computation is asked for.
    pub(in crate::suite) fn has_fem_reference(&self) -> bool {
        self.reference.as_ref().is_some_and(|reference| reference.fem.is_some())
    }
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct ReferenceWords {
    pub(in crate::suite) equation: Option<EquationName>,
    pub(in crate::suite) fem: Option<ReferenceFemWords>,
    pub(in crate::suite) same_method: Option<SameMethodWords>,
}

/// The same method with shorter steps.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct SameMethodWords {
    pub(in crate::suite) dt: NumberText,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct ReferenceFemWords {
    pub(in crate::suite) element: Element,
    pub(in crate::suite) mass: Mass,
    pub(in crate::suite) cells: NumberText,
    pub(in crate::suite) dt: NumberText,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(in crate::suite) enum MethodWords {
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
pub(in crate::suite) struct JudgeWords {
    #[serde(default)]
    pub(in crate::suite) of: Quantity,
    #[serde(default)]
    pub(in crate::suite) norm: NormName,
    /// What the error is divided by before it is judged.
    pub(in crate::suite) scale: Option<NumberText>,
    #[serde(default)]
    pub(in crate::suite) crossing_levels: CrossingLevels,
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
pub(in crate::suite) struct ObserveWords {
    pub(in crate::suite) at: Vec<NumberText>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct ExpectWords {
    pub(in crate::suite) case: Option<OneOrMany<String>>,
    pub(in crate::suite) verdict: Option<String>,
    pub(in crate::suite) order: Option<Vec<NumberText>>,
    pub(in crate::suite) finest_pair: Option<Vec<NumberText>>,
    pub(in crate::suite) crossings: Option<CrossingsName>,
    pub(in crate::suite) floor: Option<FloorCause>,
    /// Bounds on the judged error of every level that counts.
    pub(in crate::suite) error_below: Option<NumberText>,
    pub(in crate::suite) error_above: Option<NumberText>,
    /// Distance (m) of the observed place from the exact one, at the end, on the finest level.
    pub(in crate::suite) observed_within: Option<NumberText>,
    /// Largest speed towards the end of every level that counts, over the wave speed.
    pub(in crate::suite) rest_below: Option<NumberText>,
    pub(in crate::suite) drift: Option<DriftWords>,
    /// Bounds on the rate of the energy (1/s).
    pub(in crate::suite) energy_rate: Option<Vec<NumberText>>,
    pub(in crate::suite) because: String,
    /// What is expected of a full run, where that differs.
    pub(in crate::suite) full: Option<Box<ExpectWords>>,
}

/// Whether particles change their cell on the finest level.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(in crate::suite) enum CrossingsName {
    /// None does.
    None,
    /// At least one does.
    Some,
}

//! The grammar of a suite: what may stand in a YAML file, before any number is known.
//!
//! Every map refuses keys that it does not know. A number may be a formula of declared parameters;
//! a method's entries may be lists, whose product gives the cases.

pub(crate) mod drift;
pub(crate) mod head;
pub(crate) mod internal_force;
pub(crate) mod parameter;
pub(crate) mod refine;
pub(crate) mod sample;
pub(crate) mod scene;
pub(crate) mod stability;
pub(crate) mod step;
pub(crate) mod transfer;
pub(crate) mod truth;

pub(crate) use drift::DriftSpec;
pub(crate) use head::{Head, StudyName};
pub(crate) use internal_force::{ForceExpectSpec, ForceMethodSpec, InternalForceSpec};
pub(crate) use parameter::{ParameterSpec, TableSpec};
pub(crate) use refine::{RefineSpec, RunSpec, ScatterSpec};
pub(crate) use sample::read;
pub(crate) use scene::{
    AnnulusSpec, BodySpec, BoxSpec, OneBodySpec, QuadrilateralSpec, RoundSpec, SceneSpec, SetSpec,
    StressSpec,
};
pub(crate) use stability::{FigureSpec, StabilityExpectSpec, StabilitySpec};
pub(crate) use step::StepSpec;
pub use truth::EquationName;
pub(crate) use truth::{ExactSpec, LinearisedSpec, ManufacturedSpec};

use super::yaml::{NumberText, OneOrMany, Ordered};
use crate::fem::{Element, Mass, Sampling};
use crate::mpm::{BasisName, FrameName, MassName, SchemeName, TransferChoice};
use crate::named::named;
use crate::subject::{Precision, Start};
use crate::verify::{FloorCause, Quantity};
use serde::Deserialize;

/// A convergence study.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ConvergenceSpec {
    pub(crate) suite: String,
    #[serde(rename = "study")]
    pub(crate) _study: Option<StudyName>,
    pub(crate) title: String,
    pub(crate) source: String,
    #[serde(default)]
    pub(crate) about: String,
    #[serde(default)]
    pub(crate) parameters: Ordered<ParameterSpec>,
    #[serde(default)]
    pub(crate) functions: Ordered<String>,
    pub(crate) scene: SceneSpec,
    pub(crate) exact: Option<ExactSpec>,
    pub(crate) manufactured: Option<ManufacturedSpec>,
    pub(crate) equilibrium: Option<ExactSpec>,
    pub(crate) reference: Option<ReferenceSpec>,
    pub(crate) run: RunSpec,
    pub(crate) refine: RefineSpec,
    pub(crate) particles: Option<ScatterSpec>,
    pub(crate) methods: Vec<MethodSpec>,
    #[serde(default)]
    pub(crate) judge: JudgeSpec,
    pub(crate) observe: Option<ObserveSpec>,
    /// Empty: the suite explores, and is no gate.
    #[serde(default)]
    pub(crate) expect: Vec<ExpectSpec>,
}

impl ConvergenceSpec {
    /// Number of the first entry of `methods` that is an FEM.
    pub(crate) fn fem_method(&self) -> Option<usize> {
        self.methods.iter().position(|method| matches!(method, MethodSpec::Fem { .. }))
    }

    /// Whether a fine FEM computation is asked for.
    pub(crate) fn has_fem_reference(&self) -> bool {
        self.reference.as_ref().is_some_and(|reference| reference.fem.is_some())
    }
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReferenceSpec {
    pub(crate) equation: Option<EquationName>,
    pub(crate) fem: Option<ReferenceFemSpec>,
    pub(crate) same_method: Option<SameMethodSpec>,
}

/// The same method with shorter steps, or on a fine grid.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SameMethodSpec {
    pub(crate) dt: Option<NumberText>,
    pub(crate) cells: Option<NumberText>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReferenceFemSpec {
    pub(crate) element: Element,
    pub(crate) mass: Mass,
    pub(crate) cells: NumberText,
    pub(crate) dt: NumberText,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum MethodSpec {
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
    /// A solver that is not of this crate, which the command line starts.
    External { name: String, formal_order: Option<NumberText>, precision: Option<Precision> },
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct JudgeSpec {
    #[serde(default)]
    pub(crate) of: Quantity,
    #[serde(default)]
    pub(crate) norm: NormName,
    /// Face whose reaction is judged; absent: all walls together.
    pub(crate) face: Option<String>,
    /// Divisor of the error before it is judged.
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

impl NormName {
    /// Whether it is the largest over the instants of another norm.
    pub(crate) fn is_over_instants(self) -> bool {
        matches!(self, Self::MaxRms | Self::MaxL1 | Self::MaxL2 | Self::MaxLinf)
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
pub(crate) struct ObserveSpec {
    pub(crate) at: Vec<NumberText>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ExpectSpec {
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
    pub(crate) drift: Option<DriftSpec>,
    /// Bounds on the rate of the energy (1/s).
    pub(crate) energy_rate: Option<Vec<NumberText>>,
    pub(crate) because: String,
    /// Expectation of a full run, where that differs.
    pub(crate) full: Option<Box<ExpectSpec>>,
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

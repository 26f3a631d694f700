//! Keys of a suite file (YAML) and the types of their values. Formulas are not evaluated here.
//!
//! Unknown keys are errors. A number may be a formula of the suite's parameters. A setting of a
//! method may be a list. Each combination of list values is a case.

/// Declares the keys of one kind of study: the keys that all studies have, then the given ones.
/// `serde(flatten)` is not used, because its errors have no position in the file.
macro_rules! study_spec {
    (
        $(#[$about:meta])*
        struct $name:ident {
            $(#[$about_study:meta])*
            study: $study:ty,
            $($(#[$about_key:meta])* $key:ident: $keys:ty,)*
        }
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone, serde::Deserialize)]
        #[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
        #[serde(deny_unknown_fields)]
        pub(crate) struct $name {
            /// Name of the suite: lower-case letters, digits and hyphens.
            pub(crate) suite: String,
            $(#[$about_study])*
            #[serde(rename = "study")]
            pub(crate) _study: $study,
            /// Title of the suite in reports and figures, on one line.
            pub(crate) title: String,
            /// Source of the problem, such as a textbook.
            pub(crate) source: String,
            /// Description of the suite, printed at the head of the report.
            #[serde(default)]
            pub(crate) about: String,
            /// Named numbers, formulas of preceding parameters, or tables. All must be used.
            #[serde(default)]
            pub(crate) parameters: crate::suite::yaml::Ordered<crate::suite::grammar::ParameterSpec>,
            /// Functions for use in formulas, such as `s(tau): "sin(3*tau)"`.
            #[serde(default)]
            pub(crate) functions: crate::suite::yaml::Ordered<String>,
            $($(#[$about_key])* pub(crate) $key: $keys,)*
        }
    };
}

pub(crate) mod convergence;
pub(crate) mod expect;
pub(crate) mod gradient;
pub(crate) mod internal_force;
pub(crate) mod method;
pub(crate) mod sample;
pub(crate) mod scene;
pub(crate) mod spectrum;
pub(crate) mod stability;
pub(crate) mod truth;

pub(crate) use super::evaluator::ParameterSpec;
pub use crate::verify::NormName;
pub use convergence::CrossingLevels;
pub(crate) use convergence::{
    ConvergenceSpec, ObserveSpec, ReferenceSpec, RefineSpec, RunSpec, ScatterSpec,
};
pub use expect::WarningName;
pub(crate) use expect::{AcknowledgeSpec, AnyMethodSpec, CrossingsName, DriftSpec, ExpectSpec};
pub(crate) use gradient::{FunctionalSpec, GradientExpectSpec, GradientSpec};
pub(crate) use internal_force::{ForceExpectSpec, ForceMethodSpec, InternalForceSpec};
pub(crate) use method::{MethodSpec, SchemeKey, StepSpec, TransferSpec};
pub(crate) use scene::{
    AnnulusSpec, BodySpec, BoxSpec, OneBodySpec, QuadrilateralSpec, RoundSpec, SceneSpec, SetSpec,
    StressSpec,
};
pub(crate) use spectrum::{SpectrumExpectSpec, SpectrumSpec};
pub(crate) use stability::{FigureSpec, StabilityExpectSpec, StabilitySpec};
pub use truth::EquationName;
pub(crate) use truth::{ExactSpec, ManufacturedSpec};

use serde::Deserialize;

#[derive(Debug, Clone)]
pub(crate) enum SuiteSpec {
    Convergence(Box<ConvergenceSpec>),
    InternalForce(Box<InternalForceSpec>),
    Stability(Box<StabilitySpec>),
    Gradient(Box<GradientSpec>),
    Spectrum(Box<SpectrumSpec>),
}

/// The key that selects the kind of study.
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
    /// Errors on levels of increasing refinement.
    Convergence,
    /// Internal force on a node while a particle moves past the node.
    InternalForce,
    /// Whether the energy of runs stays bounded, and up to which parameter value.
    Stability,
    /// Derivatives that a differentiable solver returns.
    Gradient,
    /// Phase speed and damping of waves.
    Spectrum,
}

impl StudyName {
    pub(super) fn default_study() -> Self {
        Self::Convergence
    }
}

//! Keys of a gradient study.

use super::convergence::RunSpec;
use super::{ConvergenceSpec, ExactSpec, MethodSpec, RefineSpec, SceneSpec, StudyName};
use crate::suite::yaml::{NumberText, OneOrMany, Ordered};
use crate::verify::GradientState;
use serde::Deserialize;

study_spec! {
    /// A study of the derivatives that a differentiable solver returns.
    struct GradientSpec {
        /// Kind of study: `gradient`.
        study: StudyName,
        /// Body, material, boundary conditions and loads.
        scene: SceneSpec,
        /// Exact solution as formulas. It is checked before any solver runs.
        exact: Option<ExactSpec>,
        /// Equilibrium at the end of the run as formulas of the coordinates, instead of `exact`.
        equilibrium: Option<ExactSpec>,
        /// The derivatives to be verified.
        gradient: DerivativeSpec,
        /// End and time step of a run.
        run: RunSpec,
        /// Refinement levels: numbers of cells from coarse to fine.
        refine: RefineSpec,
        /// External solvers whose results are expected below.
        #[serde(default)]
        methods: Vec<MethodSpec>,
        /// Expected results. Each case needs exactly one matching entry. Without this key, cases
        /// neither pass nor fail.
        #[serde(default)]
        expect: Vec<GradientExpectSpec>,
    }
}

impl GradientSpec {
    /// Returns the key of the exact solution or equilibrium, and its value, if any.
    pub(crate) fn truth(&self) -> (&'static str, Option<&ExactSpec>) {
        match (&self.exact, &self.equilibrium) {
            (Some(exact), _) => ("exact", Some(exact)),
            (None, Some(rest)) => ("equilibrium", Some(rest)),
            (None, None) => ("study", None),
        }
    }

    /// Returns a convergence study of the same problem, judged at the end of the run only.
    pub(crate) fn convergence(&self, methods: Vec<MethodSpec>) -> ConvergenceSpec {
        let run = RunSpec { instants: Some(NumberText::Number(1.0)), ..self.run.clone() };
        ConvergenceSpec {
            suite: self.suite.clone(),
            _study: None,
            title: self.title.clone(),
            source: self.source.clone(),
            about: String::new(),
            parameters: self.parameters.clone(),
            functions: self.functions.clone(),
            scene: self.scene.clone(),
            exact: self.exact.clone(),
            manufactured: None,
            equilibrium: self.equilibrium.clone(),
            reference: None,
            run,
            refine: self.refine.clone(),
            particles: None,
            methods,
            judge: super::convergence::JudgeSpec::default(),
            observe: None,
            expect: Vec::new(),
            acknowledge: Vec::new(),
            any_method: None,
        }
    }
}

/// The derivatives to be verified.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct DerivativeSpec {
    /// Functional of the state at the end of the run.
    pub(crate) of: FunctionalSpec,
    /// Problem parameters (`young`, `density`, ...), each with the suite parameter that sets it.
    pub(crate) with_respect_to: Ordered<String>,
    /// Number of cells of the level on which parameters are perturbed; default: the finest level.
    pub(crate) cells: Option<NumberText>,
    /// Sweep over an interval of one parameter.
    pub(crate) sweep: Option<GradientSweepSpec>,
}

/// A functional of the state at the end of the run.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum FunctionalSpec {
    /// Mean of a component of the displacement, weighted with the masses.
    MeanDisplacement {
        /// Axis, from 0.
        axis: NumberText,
    },
    /// Mean square of the displacement, weighted with the masses.
    MeanSquareDisplacement,
    /// Kinetic energy.
    KineticEnergy,
    /// Position of one particle.
    PositionOf {
        /// Index of the particle, from 0.
        particle: NumberText,
        /// Axis, from 0.
        axis: NumberText,
    },
}

/// An interval of one parameter, around its value.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct GradientSweepSpec {
    /// Name of the parameter, as in `with_respect_to`.
    pub(crate) parameter: String,
    /// Half the length of the interval, as a fraction of the parameter value.
    pub(crate) within: NumberText,
    /// Number of points.
    pub(crate) points: NumberText,
}

/// An expectation of a gradient study.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct GradientExpectSpec {
    /// Names of the cases, with `*` for any text; default: all cases.
    pub(crate) case: Option<OneOrMany<String>>,
    /// Result of the verification of the derivative; default: any result except `wrong`.
    pub(crate) state: Option<GradientState>,
    /// Lowest and highest order of the error of the derivative.
    pub(crate) order: Option<Vec<NumberText>>,
    /// Reason for the expectation.
    pub(crate) because: String,
}

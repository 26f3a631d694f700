//! Keys of a convergence study.

use super::{
    AcknowledgeSpec, AnyMethodSpec, BoxSpec, EquationName, ExactSpec, ExpectSpec, ManufacturedSpec,
    MethodSpec, SceneSpec, StepSpec, StudyName,
};
use crate::fem::{Element, Mass};
use crate::named::named;
use crate::suite::yaml::{NumberText, OneOrMany};
use crate::verify::{NormName, Quantity};
use serde::Deserialize;

study_spec! {
    /// A convergence study.
    struct ConvergenceSpec {
        /// Kind of study; `convergence` unless stated.
        study: Option<StudyName>,
        /// The body with its conditions and loads.
        scene: SceneSpec,
        /// The exact solution as formulas, checked before any solver runs.
        exact: Option<ExactSpec>,
        /// A motion from which the body force is computed by differentiation.
        manufactured: Option<ManufacturedSpec>,
        /// Equilibrium in which the body comes to rest, as formulas of the coordinates.
        equilibrium: Option<ExactSpec>,
        /// A fine computation to compare with, if no exact solution is known.
        reference: Option<ReferenceSpec>,
        /// End, time step and instants of a run.
        run: RunSpec,
        /// Refinement levels, from coarse to fine.
        refine: RefineSpec,
        /// Offsets of particles from their lattice.
        particles: Option<ScatterSpec>,
        /// Methods to be judged. List values give one case for each combination.
        methods: Vec<MethodSpec>,
        /// Quantity and norm of the error from which the order is determined.
        #[serde(default)]
        judge: JudgeSpec,
        /// Point whose velocity history and extrapolated displacement are reported.
        observe: Option<ObserveSpec>,
        /// Expectations, exactly one for each case. Without expectations, cases neither pass nor
        /// fail.
        #[serde(default)]
        expect: Vec<ExpectSpec>,
        /// Accepted warnings of `check`, each with its reason.
        #[serde(default)]
        acknowledge: Vec<AcknowledgeSpec>,
        /// Accuracy that any method can reach, which `run --gate` requires of external solvers.
        any_method: Option<AnyMethodSpec>,
    }
}

impl ConvergenceSpec {
    /// Returns the index of the first FEM entry in `methods`.
    pub(crate) fn fem_method(&self) -> Option<usize> {
        self.methods.iter().position(|method| matches!(method, MethodSpec::Fem { .. }))
    }

    /// Whether the suite has a fine FEM computation as reference.
    pub(crate) fn has_fem_reference(&self) -> bool {
        self.reference.as_ref().is_some_and(|reference| reference.fem.is_some())
    }
}

#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ReferenceSpec {
    /// Equation that the FEM computation solves.
    pub(crate) equation: Option<EquationName>,
    /// A fine FEM computation.
    pub(crate) fem: Option<ReferenceFemSpec>,
    /// A reference run by the same method, with much shorter steps or on a much finer grid.
    pub(crate) same_method: Option<SameMethodSpec>,
}

/// A reference run by the same method, with shorter steps or on a finer grid.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SameMethodSpec {
    /// Time step (s), at most 1/8 of the step on the finest level.
    pub(crate) dt: Option<NumberText>,
    /// Cells along the first axis, at least 4 times those of the finest level.
    pub(crate) cells: Option<NumberText>,
}

#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ReferenceFemSpec {
    /// Finite element.
    pub(crate) element: Element,
    /// Mass matrix.
    pub(crate) mass: Mass,
    /// Number of elements.
    pub(crate) cells: NumberText,
    /// Time step (s).
    pub(crate) dt: NumberText,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct JudgeSpec {
    /// Quantity whose error is measured.
    #[serde(default)]
    pub(crate) of: Quantity,
    /// Norm of the error.
    #[serde(default)]
    pub(crate) norm: NormName,
    /// Face whose reaction force is measured; default: the sum over all walls.
    pub(crate) face: Option<String>,
    /// Box of reference positions in which the error is measured; default: the body.
    pub(crate) within: Option<BoxSpec>,
    /// Value by which the error is divided.
    pub(crate) scale: Option<NumberText>,
    /// Whether the order may use levels on which particles change their cell.
    #[serde(default)]
    pub(crate) crossing_levels: CrossingLevels,
}

named! {
    /// Whether the order may use levels on which particles change their cell.
    #[derive(Default)]
    pub enum CrossingLevels {
        /// The order uses these levels.
        #[default]
        Counted = "counted",
        /// These levels are shown but not used.
        Excluded = "excluded",
    }
}

#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ObserveSpec {
    /// Reference position (m).
    pub(crate) at: Vec<NumberText>,
}

#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct RunSpec {
    /// End of the run (s), or a list of ends; absent with `load_steps`.
    pub(crate) until: Option<OneOrMany<NumberText>>,
    /// Number of load steps to an equilibrium, or a list of numbers, in place of `until`.
    pub(crate) load_steps: Option<OneOrMany<NumberText>>,
    /// Time step; absent if `refine` lists time steps.
    pub(crate) dt: Option<StepSpec>,
    /// Number of instants at which the error is measured.
    pub(crate) instants: Option<NumberText>,
}

/// Refinement plan. The key with a list of values is refined, from coarse to fine.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct RefineSpec {
    /// Cells along the first axis.
    pub(crate) cells: OneOrMany<NumberText>,
    /// Time steps (s).
    pub(crate) dt: Option<OneOrMany<NumberText>>,
    /// Particles per cell.
    pub(crate) ppc: Option<OneOrMany<NumberText>>,
    /// Additional finer levels, for full runs only.
    pub(crate) full: Option<OneOrMany<NumberText>>,
}

/// Offsets of particles from their lattice points, as shares of the particle spacing.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ScatterSpec {
    /// Translation of all particles along each axis.
    pub(crate) shift: Option<Vec<NumberText>>,
    /// Maximum random displacement of each particle along an axis.
    pub(crate) perturb: Option<NumberText>,
    /// Seed of the random displacements.
    pub(crate) seed: Option<NumberText>,
}

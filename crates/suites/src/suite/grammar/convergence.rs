//! Keys of a convergence study.

use super::{
    AcknowledgeSpec, AnyMethodSpec, BoxSpec, EquationName, ExactSpec, ExpectSpec, ManufacturedSpec,
    MethodSpec, SceneSpec, StepSpec, StudyName,
};
use crate::fem::{Element, Mass};
use crate::suite::yaml::{NumberText, OneOrMany};
use crate::verify::{NormName, Quantity};
use mpm_subject::named;
use serde::Deserialize;

study_spec! {
    /// A convergence study: errors on levels of increasing refinement.
    struct ConvergenceSpec {
        /// Kind of study: `convergence`, the default.
        study: Option<StudyName>,
        /// Body, material, boundary conditions and loads.
        scene: SceneSpec,
        /// Exact solution as formulas. It is checked before any solver runs.
        exact: Option<ExactSpec>,
        /// Motion or temperature field from which the body force or the heat source is computed.
        manufactured: Option<ManufacturedSpec>,
        /// Equilibrium in which the body comes to rest, as formulas of the coordinates.
        equilibrium: Option<ExactSpec>,
        /// Fine computation with which runs are compared, instead of or in addition to an exact
        /// solution.
        reference: Option<ReferenceSpec>,
        /// End and time step of a run, and the number of instants at which the error is measured.
        run: RunSpec,
        /// Refinement levels, from coarse to fine.
        refine: RefineSpec,
        /// Displacements of particles from their regular lattice.
        particles: Option<ScatterSpec>,
        /// Methods to be tested. Each combination of list values is a case.
        methods: Vec<MethodSpec>,
        /// Quantity and norm of the error from which the order is determined.
        #[serde(default)]
        judge: JudgeSpec,
        /// Point for which the velocity history and the extrapolated displacement are reported.
        observe: Option<ObserveSpec>,
        /// Expected results. Each case needs exactly one matching entry. Without this key, cases
        /// neither pass nor fail.
        #[serde(default)]
        expect: Vec<ExpectSpec>,
        /// Warnings of `mpm-verify check` that are accepted, each with the reason.
        #[serde(default)]
        acknowledge: Vec<AcknowledgeSpec>,
        /// Accuracy that any method can reach. `run --gate` requires it of external solvers.
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
    /// Reference computed with FEM on a fine mesh.
    pub(crate) fem: Option<ReferenceFemSpec>,
    /// Reference computed with the tested method, with much shorter steps or on a much finer grid.
    pub(crate) same_method: Option<SameMethodSpec>,
}

/// A reference that is computed with the tested method, with shorter steps or on a finer grid.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SameMethodSpec {
    /// Time step (s), at most 1/8 of the step on the finest level.
    pub(crate) dt: Option<NumberText>,
    /// Number of cells along the first axis, at least 4 times that of the finest level.
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
    /// Face whose reaction force is measured; default: all walls together.
    pub(crate) face: Option<String>,
    /// Box of reference positions in which the error is measured; default: the whole body.
    pub(crate) within: Option<BoxSpec>,
    /// Number by which the error is divided.
    pub(crate) scale: Option<NumberText>,
    /// Whether levels on which particles cross cells count for the order.
    #[serde(default)]
    pub(crate) crossing_levels: CrossingLevels,
}

named! {
    /// Whether levels on which particles cross cells count for the order.
    #[derive(Default)]
    pub enum CrossingLevels {
        /// Levels with cell crossings count.
        #[default]
        Counted = "counted",
        /// Levels with cell crossings are reported but do not count.
        Excluded = "excluded",
    }
}

#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ObserveSpec {
    /// Reference position of the point (m).
    pub(crate) at: Vec<NumberText>,
}

#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct RunSpec {
    /// End of the run (s), or a list of ends with one case each. Not allowed with `load_steps`.
    pub(crate) until: Option<OneOrMany<NumberText>>,
    /// Number of quasi-static load steps, in place of `until`, or a list with one case each.
    pub(crate) load_steps: Option<OneOrMany<NumberText>>,
    /// Time step. Not allowed if `refine` lists time steps.
    pub(crate) dt: Option<StepSpec>,
    /// Number of instants at which the error is measured; default: 50.
    pub(crate) instants: Option<NumberText>,
}

/// Refinement levels. Each value of a list is one level, from coarse to fine.
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
    /// Finer levels that `run --full` adds to the list.
    pub(crate) full: Option<OneOrMany<NumberText>>,
}

/// Displacements of particles from their lattice points, as fractions of the particle spacing.
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

//! Keys of a stability study.

use super::{MethodSpec, SceneSpec, StepSpec, StudyName};
use crate::suite::yaml::{NumberText, OneOrMany, Ordered};
use crate::verify::Stability;
use serde::Deserialize;

study_spec! {
    /// A stability study: whether the energy of runs stays bounded.
    struct StabilitySpec {
        /// Kind of study: `stability`.
        study: StudyName,
        /// Body, material, boundary conditions and loads.
        scene: SceneSpec,
        /// Cells and particles.
        particles: ParticleSpec,
        /// Time step and number of steps.
        run: StabilityRunSpec,
        /// Parameter with a list of values. Each value gives a row of the report.
        sweep: Ordered<OneOrMany<NumberText>>,
        /// Another parameter, whose largest stable value is determined for each row.
        critical: Option<CriticalSpec>,
        /// Measured quantities that the report shows.
        #[serde(default)]
        show: Vec<crate::verify::RunFigure>,
        /// Methods to be tested. Each combination of list values is a case.
        methods: Vec<MethodSpec>,
        /// Expected results. Each case needs exactly one matching entry. Without this key, cases
        /// neither pass nor fail.
        #[serde(default)]
        expect: Vec<StabilityExpectSpec>,
    }
}

/// Particles of the body.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ParticleSpec {
    /// Cells along the first axis.
    pub(crate) cells: NumberText,
    /// Particles per cell.
    pub(crate) ppc: NumberText,
    /// Translation of every particle (m) before the start.
    pub(crate) shift: Option<Vec<NumberText>>,
    /// Positions (m) of additional particles, each with the volume of a lattice particle.
    #[serde(default)]
    pub(crate) extra: Vec<Vec<NumberText>>,
}

/// Settings of a run.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct StabilityRunSpec {
    /// Time step (s): a number, `auto`, or `{courant: ...}`.
    pub(crate) dt: StepSpec,
    /// A second time step (s), which alternates with `dt`.
    pub(crate) alternate: Option<NumberText>,
    /// Number of consecutive steps with each time step; default: 1.
    pub(crate) every: Option<NumberText>,
    /// Number of steps.
    pub(crate) steps: NumberText,
    /// Number of steps in `run --full`; default: `steps`.
    pub(crate) full_steps: Option<NumberText>,
    /// Whether particles keep their positions, so that every step is the same linear map.
    #[serde(default)]
    pub(crate) frozen: bool,
    /// Size of the random perturbation of the whole state at the start, in natural units.
    pub(crate) perturb: Option<NumberText>,
    /// Maximum energy of a stable run, relative to the energy at the start; default: 1e3.
    pub(crate) stable_below: Option<NumberText>,
    /// Minimum energy of an unstable run, relative to the energy at the start; default: 1e8.
    pub(crate) unstable_above: Option<NumberText>,
}

/// The parameter whose largest stable value is determined, and the range of the search.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct CriticalSpec {
    /// Name of the parameter.
    pub(crate) parameter: String,
    /// Minimum of the range.
    pub(crate) from: NumberText,
    /// Maximum of the range.
    pub(crate) to: NumberText,
}

/// An expectation of a stability study.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct StabilityExpectSpec {
    /// Names of the cases, with `*` for any text; default: all cases.
    pub(crate) case: Option<OneOrMany<String>>,
    /// Whether `run --gate` requires this of external solvers. The entry then applies to no case
    /// of the suite.
    #[serde(default)]
    pub(crate) any_method: bool,
    /// Expected verdict of all rows, or a list with one verdict per row.
    pub(crate) verdict: Option<OneOrMany<Stability>>,
    /// Bounds on the stability limit.
    pub(crate) critical: Option<FigureSpec>,
    /// Bounds on measured quantities of the runs.
    #[serde(default)]
    pub(crate) figures: Ordered<FigureSpec>,
    /// Reason for the expectation.
    pub(crate) because: String,
}

/// Bounds on a measured quantity.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct FigureSpec {
    /// Expected value, as a formula of the parameters.
    pub(crate) is: Option<NumberText>,
    /// Maximum deviation from `is`, relative to `is`, or absolute if `is` is 0.
    pub(crate) within: Option<NumberText>,
    /// Lower bound.
    pub(crate) above: Option<NumberText>,
    /// Upper bound.
    pub(crate) below: Option<NumberText>,
}

//! Keys of a stability study.

use super::{MethodSpec, SceneSpec, StepSpec, StudyName};
use crate::suite::yaml::{NumberText, OneOrMany, Ordered};
use crate::verify::Stability;
use serde::Deserialize;

study_spec! {
    /// A stability study.
    struct StabilitySpec {
        /// Kind of study: `stability`.
        study: StudyName,
        /// The body with its conditions and loads.
        scene: SceneSpec,
        /// Cells and particles.
        particles: ParticleSpec,
        /// Time step and number of steps.
        run: StabilityRunSpec,
        /// One parameter, and its values.
        sweep: Ordered<OneOrMany<NumberText>>,
        /// The parameter whose largest stable value is determined for each row.
        critical: Option<CriticalSpec>,
        /// Figures that the report shows.
        #[serde(default)]
        show: Vec<crate::verify::RunFigure>,
        /// Methods to be studied; lists in an entry multiply to cases.
        methods: Vec<MethodSpec>,
        /// Expectations, exactly one for each case. A suite without expectations is not a gate.
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
    /// Positions (m) of additional particles, each with the volume of the others.
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
    /// A second step length, which alternates with `dt`.
    pub(crate) alternate: Option<NumberText>,
    /// Number of consecutive steps of each length.
    pub(crate) every: Option<NumberText>,
    /// Number of steps.
    pub(crate) steps: NumberText,
    /// Steps of a full run, if it has more.
    pub(crate) full_steps: Option<NumberText>,
    /// Whether the particles do not move.
    #[serde(default)]
    pub(crate) frozen: bool,
    /// Size of random perturbations of the state at the start.
    pub(crate) perturb: Option<NumberText>,
    /// Energy, over that at the start, below which a run is stable.
    pub(crate) stable_below: Option<NumberText>,
    /// Energy, over that at the start, above which a run is unstable.
    pub(crate) unstable_above: Option<NumberText>,
}

/// The parameter whose limit is sought, and its range.
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
    /// Cases that it speaks of, `*` standing for any text; all unless stated.
    pub(crate) case: Option<OneOrMany<String>>,
    /// Expected verdict of every row, or one for each.
    pub(crate) verdict: Option<OneOrMany<Stability>>,
    /// The limit that is sought.
    pub(crate) critical: Option<FigureSpec>,
    /// Bounds on figures of the runs.
    #[serde(default)]
    pub(crate) figures: Ordered<FigureSpec>,
    /// The reason for expecting it.
    pub(crate) because: String,
}

/// Bounds on a figure.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct FigureSpec {
    /// A closed form, of the parameters.
    pub(crate) is: Option<NumberText>,
    /// Maximum deviation: a share of the value, or of one if the value is smaller.
    pub(crate) within: Option<NumberText>,
    /// Lower bound.
    pub(crate) above: Option<NumberText>,
    /// Upper bound.
    pub(crate) below: Option<NumberText>,
}

//! Keys of an expectation in a convergence study, and of acknowledged warnings.

use crate::suite::yaml::{NumberText, OneOrMany};
#[cfg(feature = "schemas")]
use crate::verify::Verdict;
use crate::verify::{CaseFigure, FloorCause};
use mpm_judge::each_case_figure;
use mpm_subject::named;
use serde::Deserialize;

/// Declares [`ExpectSpec`], with one key for each measured quantity that can be bounded.
macro_rules! expect_spec {
    ($($(#[$doc:meta])* $member:ident = $key:ident, $text:literal, $bound:ident, $need:ident,
        $value:ident;)+) => {
/// An expectation: a verdict or an order, bounds, and the reason.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ExpectSpec {
    /// Names of the cases, with `*` for any text; default: all cases.
    pub(crate) case: Option<OneOrMany<String>>,
    /// Expected verdict; default: `converging` if an `order` is stated.
    #[cfg_attr(feature = "schemas", schemars(schema_with = "verdicts", default))]
    pub(crate) verdict: Option<String>,
    /// Lowest and highest order. The whole confidence interval of the observed order must lie
    /// between them.
    pub(crate) order: Option<Vec<NumberText>>,
    /// Lowest and highest order, computed from the two finest levels alone.
    pub(crate) finest_pair: Option<Vec<NumberText>>,
    /// Whether particles cross cells on the finest level.
    pub(crate) crossings: Option<CrossingsName>,
    /// Cause of the error floor, where the error no longer falls.
    pub(crate) floor: Option<FloorCause>,
            $($(#[$doc])* pub(crate) $key: Option<NumberText>,)+
    /// Bounds on the relative change of sums over the body during a run, such as the mass.
    pub(crate) drift: Option<DriftSpec>,
    /// Lowest and highest relative growth rate of the energy (1/s).
    pub(crate) energy_rate: Option<Vec<NumberText>>,
    /// Reason for the expectation.
    pub(crate) because: String,
    /// Expectation for `run --full`, if it differs.
    pub(crate) full: Option<Box<ExpectSpec>>,
}

        impl ExpectSpec {
            /// Returns the stated bounds, in the order of [`CaseFigure::ALL`].
            pub(crate) fn bounds(&self) -> Vec<(CaseFigure, &NumberText)> {
                let bounds = [$((CaseFigure::$member, &self.$key)),+];
                bounds.into_iter().filter_map(|(figure, text)| Some((figure, text.as_ref()?))).collect()
            }
        }
    };
}
each_case_figure!(expect_spec);

/// Accuracy that any method can reach on the problem.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct AnyMethodSpec {
    /// Highest order along the refined axis that the regularity of the solution allows.
    pub(crate) order: Option<NumberText>,
    /// Errors at or below this bound are accepted, even if the order is too low.
    pub(crate) error_below: Option<NumberText>,
    /// Whether a solver may use another law, because the body does not deform, or because strains
    /// are small and the law is isotropic and elastic.
    #[serde(default)]
    pub(crate) any_law: bool,
    /// Whether `run --gate` requires anything of external solvers; default: true.
    pub(crate) gated: Option<bool>,
    /// Reason for these values.
    pub(crate) because: String,
}

/// Returns the JSON schema of the verdict names in suites.
#[cfg(feature = "schemas")]
fn verdicts(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let names: Vec<String> = Verdict::ALL.iter().map(|verdict| verdict.key()).collect();
    schemars::json_schema!({"type": "string", "enum": names})
}

/// Whether particles cross cells on the finest level.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum CrossingsName {
    /// No particle crosses cells.
    None,
    /// At least one particle crosses cells.
    Some,
}

/// Bounds on the largest relative change of sums over the body during a run.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct DriftSpec {
    pub(crate) mass: Option<NumberText>,
    pub(crate) momentum: Option<NumberText>,
    pub(crate) angular_momentum: Option<NumberText>,
    pub(crate) kinetic_energy: Option<NumberText>,
    pub(crate) kinetic_energy_gain: Option<NumberText>,
    pub(crate) energy: Option<NumberText>,
}

named! {
    /// A warning or note of `mpm-verify check` about a suite that can run.
    pub enum WarningName {
        /// Too few levels to determine an order.
        FewLevels = "few_levels",
        /// A time step that is longer than the stable one, or the same on all levels.
        TimeStep = "time_step",
        /// An exact motion that leaves the grid.
        LeavesGrid = "leaves_grid",
        /// An exact solution that holds for small strains only, or for a linearised law.
        SmallStrain = "small_strain",
        /// A solver that computes in single precision.
        SinglePrecision = "single_precision",
        /// An interface of two bodies, or a loaded face, that lies inside a cell.
        InsideCell = "inside_cell",
        /// A tolerance of a linearised solution that is much larger than necessary.
        LooseTolerance = "loose_tolerance",
        /// A box whose outermost particles start exactly on nodes, with linear basis functions.
        EndOnNode = "end_on_node",
        /// An equilibrium study in which nothing removes energy.
        Undamped = "undamped",
    }
}

/// An accepted warning, with the reason.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct AcknowledgeSpec {
    /// Name of the warning.
    pub(crate) warning: WarningName,
    /// Reason for accepting the warning.
    pub(crate) because: String,
}

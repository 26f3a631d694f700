//! Keys of an expectation of a convergence study.

use super::DriftSpec;
use crate::suite::yaml::{NumberText, OneOrMany};
use crate::verify::FloorCause;
#[cfg(feature = "schemas")]
use crate::verify::Verdict;
use serde::Deserialize;

/// An expectation: a verdict or an order, bounds, and the reason.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ExpectSpec {
    /// Cases that it speaks of, `*` standing for any text; all unless stated.
    pub(crate) case: Option<OneOrMany<String>>,
    /// The verdict; `converging` where an `order` is given.
    #[cfg_attr(feature = "schemas", schemars(schema_with = "verdicts", default))]
    pub(crate) verdict: Option<String>,
    /// Lowest and highest order: the whole confidence interval must lie within.
    pub(crate) order: Option<Vec<NumberText>>,
    /// Lowest and highest order between the two finest levels.
    pub(crate) finest_pair: Option<Vec<NumberText>>,
    /// Whether particles change their cell on the finest level.
    pub(crate) crossings: Option<CrossingsName>,
    /// The axis whose error the floor is.
    pub(crate) floor: Option<FloorCause>,
    /// Bounds on the judged error of every level that counts.
    pub(crate) error_below: Option<NumberText>,
    /// Lower bound on the judged error of every level that counts.
    pub(crate) error_above: Option<NumberText>,
    /// Distance (m) of the observed place from the exact one, at the end, on the finest level.
    pub(crate) observed_within: Option<NumberText>,
    /// Largest speed towards the end of every level that counts, over the wave speed.
    pub(crate) rest_below: Option<NumberText>,
    /// Bounds on the relative change of sums over the body.
    pub(crate) drift: Option<DriftSpec>,
    /// Bounds on the rate of the energy (1/s).
    pub(crate) energy_rate: Option<Vec<NumberText>>,
    /// The reason for expecting it.
    pub(crate) because: String,
    /// Expectation of a full run, where that differs.
    pub(crate) full: Option<Box<ExpectSpec>>,
}

/// Accuracy that any method can reach on the problem.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct AnyMethodSpec {
    /// Highest order along the refined axis that the regularity of the solution allows.
    pub(crate) order: Option<NumberText>,
    /// Bound on errors that are accepted without an order.
    pub(crate) error_below: Option<NumberText>,
    /// Whether nothing deforms, so that a solver may use any law.
    #[serde(default)]
    pub(crate) any_law: bool,
    /// Whether the gate requires anything of an external solver; it does unless stated.
    pub(crate) gated: Option<bool>,
    /// The reason.
    pub(crate) because: String,
}

/// The names of verdicts, as suites spell them.
#[cfg(feature = "schemas")]
fn verdicts(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let names = Verdict::ALL.map(|verdict| verdict.name().replace([' ', '-'], "_"));
    schemars::json_schema!({"type": "string", "enum": names})
}

/// Whether particles change their cell on the finest level.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum CrossingsName {
    /// None does.
    None,
    /// At least one does.
    Some,
}

//! A time step: a length, or a rule for it (`auto`, `{courant: 0.5}`).

use crate::suite::yaml::{InPlaceOfNumber, NumberOr, NumberText};
use serde::Deserialize;

/// Length of a step.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(from = "NumberOr<Rule>")]
pub(crate) enum StepSpec {
    /// A number (s), or a formula.
    Length(NumberText),
    /// The share of the stable time step.
    Courant(NumberText),
    /// A share that leaves room for what happens on the way.
    Auto,
}

/// `{courant: 0.5}`.
#[derive(Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct Rule {
    /// Share of the stable time step.
    courant: NumberText,
}

impl InPlaceOfNumber for Rule {
    const EXPECTED: &'static str = "a time step, `auto`, or `{courant: ...}`";
}

impl From<NumberOr<Rule>> for StepSpec {
    fn from(step: NumberOr<Rule>) -> Self {
        match step {
            NumberOr::Number(NumberText::Formula(text)) if text == "auto" => Self::Auto,
            NumberOr::Number(length) => Self::Length(length),
            NumberOr::Map(rule) => Self::Courant(rule.courant),
        }
    }
}

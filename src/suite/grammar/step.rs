//! A time step: a length, or a rule for it (`auto`, `{courant: 0.5}`).

use crate::suite::yaml::NumberText;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, Deserializer, Error, IntoDeserializer, MapAccess, Visitor};
use std::fmt;

/// Length of a step.
#[derive(Debug, Clone)]
pub(crate) enum StepSpec {
    /// A number (s), or a formula.
    Length(NumberText),
    /// The share of the stable time step.
    Courant(NumberText),
    /// A share that leaves room for what happens on the way.
    Auto,
}

/// `{courant: 0.5}`.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Rule {
    courant: NumberText,
}

impl<'de> Deserialize<'de> for StepSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(LengthOrRule)
    }
}

struct LengthOrRule;

fn length<'de, E: Error>(value: impl IntoDeserializer<'de, E>) -> Result<StepSpec, E> {
    NumberText::deserialize(value.into_deserializer()).map(StepSpec::Length)
}

impl<'de> Visitor<'de> for LengthOrRule {
    type Value = StepSpec;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a time step, `auto`, or `{courant: ...}`")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<StepSpec, E> {
        if text == "auto" { Ok(StepSpec::Auto) } else { length(text) }
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<StepSpec, A::Error> {
        Rule::deserialize(MapAccessDeserializer::new(map))
            .map(|rule| StepSpec::Courant(rule.courant))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<StepSpec, E> {
        length(value)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<StepSpec, E> {
        length(value)
    }

    fn visit_u128<E: Error>(self, value: u128) -> Result<StepSpec, E> {
        length(value)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<StepSpec, E> {
        length(value)
    }
}

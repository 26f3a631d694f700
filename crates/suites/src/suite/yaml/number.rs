//! A number, a formula, or a map that replaces a number.

use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, Deserializer, Error, MapAccess, Unexpected, Visitor};
use std::fmt;
use std::marker::PhantomData;

/// A number in a suite, or a formula for a number: `25`, `1e-3` or `"pi/(2*L)"`.
///
/// The text of a formula is not parsed here. `Display` returns this text; for a number, it returns
/// the shortest text that parses to the same number.
#[derive(Clone, Debug, PartialEq)]
pub enum NumberText {
    /// A finite number.
    Number(f64),
    /// The text of a formula, without quotes and with escapes resolved.
    Formula(String),
}

/// Zero, the default of an optional number.
impl Default for NumberText {
    fn default() -> Self {
        Self::Number(0.0)
    }
}

impl fmt::Display for NumberText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Formula(text) => f.write_str(text),
            // Without an exponent, 1e300 would be printed as 1 and 300 zeros.
            Self::Number(value) if *value != 0.0 && !(1e-5..1e16).contains(&value.abs()) => {
                write!(f, "{value:e}")
            }
            Self::Number(value) => write!(f, "{value}"),
        }
    }
}

impl<'de> Deserialize<'de> for NumberText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match NumberOr::<NoMap>::deserialize(deserializer)? {
            NumberOr::Number(text) => Ok(text),
            NumberOr::Map(never) => match never {},
        }
    }
}

#[cfg(feature = "schemas")]
impl schemars::JsonSchema for NumberText {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "NumberText".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({"type": ["number", "string"]})
    }
}

/// A number or formula, or a map in its place: `1e-3`, `{courant: 0.5}`.
#[derive(Clone, Debug)]
pub(crate) enum NumberOr<T> {
    Number(NumberText),
    Map(T),
}

/// A map that may replace a number.
pub(crate) trait InPlaceOfNumber {
    /// Phrase for messages that lists all allowed forms.
    const EXPECTED: &'static str;
}

impl<'de, T: Deserialize<'de> + InPlaceOfNumber> Deserialize<'de> for NumberOr<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(EitherOf(PhantomData))
    }
}

#[cfg(feature = "schemas")]
impl<T: schemars::JsonSchema> schemars::JsonSchema for NumberOr<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        format!("NumberOr_{}", T::schema_name()).into()
    }

    fn json_schema(all: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let (number, map) = (all.subschema_for::<NumberText>(), all.subschema_for::<T>());
        schemars::json_schema!({"anyOf": [number, map]})
    }
}

/// The map that may replace a number where no map is allowed.
enum NoMap {}

impl InPlaceOfNumber for NoMap {
    const EXPECTED: &'static str = "a finite number or a formula";
}

impl<'de> Deserialize<'de> for NoMap {
    fn deserialize<D: Deserializer<'de>>(_: D) -> Result<Self, D::Error> {
        Err(D::Error::invalid_type(Unexpected::Map, &Self::EXPECTED))
    }
}

struct EitherOf<T>(PhantomData<T>);

fn number<T>(value: f64) -> NumberOr<T> {
    NumberOr::Number(NumberText::Number(value))
}

impl<'de, T: Deserialize<'de> + InPlaceOfNumber> Visitor<'de> for EitherOf<T> {
    type Value = NumberOr<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(T::EXPECTED)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<NumberOr<T>, A::Error> {
        T::deserialize(MapAccessDeserializer::new(map)).map(NumberOr::Map)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<NumberOr<T>, E> {
        Ok(NumberOr::Number(NumberText::Formula(text.to_owned())))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<NumberOr<T>, E> {
        Ok(number(value as f64))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<NumberOr<T>, E> {
        Ok(number(value as f64))
    }

    fn visit_i128<E: Error>(self, value: i128) -> Result<NumberOr<T>, E> {
        Ok(number(value as f64))
    }

    fn visit_u128<E: Error>(self, value: u128) -> Result<NumberOr<T>, E> {
        Ok(number(value as f64))
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<NumberOr<T>, E> {
        Ok(number(value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn text_of_a_number_parses_to_the_same_number(
            value in any::<f64>().prop_filter("finite", |v| v.is_finite()),
        ) {
            let text = NumberText::Number(value).to_string();
            prop_assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits());
            prop_assert!(text.len() < 30);
        }
    }
}

//! A number, or a map in its place.

use super::NumberText;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, Deserializer, Error, IntoDeserializer, MapAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

/// A number or formula, or a map that says where a number comes from: `1e-3`, `{courant: 0.5}`.
#[derive(Clone, Debug)]
pub(crate) enum NumberOr<T> {
    /// A number, or the text of a formula.
    Number(NumberText),
    /// A map.
    Map(T),
}

/// A map that may stand in the place of a number.
pub(crate) trait InPlaceOfNumber {
    /// Phrase for messages of all that may stand there.
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

struct EitherOf<T>(PhantomData<T>);

fn number<'de, T, E: Error>(value: impl IntoDeserializer<'de, E>) -> Result<NumberOr<T>, E> {
    NumberText::deserialize(value.into_deserializer()).map(NumberOr::Number)
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
        number(text)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<NumberOr<T>, E> {
        number(value)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<NumberOr<T>, E> {
        number(value)
    }

    fn visit_i128<E: Error>(self, value: i128) -> Result<NumberOr<T>, E> {
        number(value as f64)
    }

    fn visit_u128<E: Error>(self, value: u128) -> Result<NumberOr<T>, E> {
        number(value as f64)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<NumberOr<T>, E> {
        number(value)
    }
}

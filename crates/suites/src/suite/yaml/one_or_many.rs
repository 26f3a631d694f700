//! A value, or a list of alternatives.

use super::refuse;
use serde::de::value::MapAccessDeserializer;
use serde::de::{self, Deserialize, Deserializer, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

/// A setting that a suite may vary. For example, `scheme: [musl, usl]` gives one case for each
/// entry.
///
/// The list is never empty. `T` may be a number, text, a struct or an enum. It must not be a list,
/// because the first bracket always opens the list of alternatives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OneOrMany<T> {
    values: Vec<T>,
    listed: bool,
}

impl<T> OneOrMany<T> {
    /// Returns the alternatives in the order of the file; at least one.
    pub fn as_slice(&self) -> &[T] {
        &self.values
    }

    /// Whether the file writes the alternatives in brackets.
    pub fn is_listed(&self) -> bool {
        self.listed
    }

    /// Returns `values` as a list if `self` is a list; otherwise the first value, if any.
    pub(crate) fn with_values(&self, values: impl IntoIterator<Item = T>) -> Option<Self> {
        let limit = if self.listed { usize::MAX } else { 1 };
        let values: Vec<T> = values.into_iter().take(limit).collect();
        (!values.is_empty()).then_some(Self { values, listed: self.listed })
    }
}

impl<T> From<T> for OneOrMany<T> {
    fn from(one: T) -> Self {
        Self { values: vec![one], listed: false }
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for OneOrMany<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Alternatives(PhantomData))
    }
}

#[cfg(feature = "schemas")]
impl<T: schemars::JsonSchema> schemars::JsonSchema for OneOrMany<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        format!("OneOrMany_{}", T::schema_name()).into()
    }

    fn json_schema(all: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let one = all.subschema_for::<T>();
        let many = schemars::json_schema!({"type": "array", "items": one.clone(), "minItems": 1});
        schemars::json_schema!({"anyOf": [one, many]})
    }
}

struct Alternatives<T>(PhantomData<T>);

fn one<'de, T: Deserialize<'de>, E: de::Error>(
    value: impl IntoDeserializer<'de, E>,
) -> Result<OneOrMany<T>, E> {
    T::deserialize(value.into_deserializer()).map(OneOrMany::from)
}

impl<'de, T: Deserialize<'de>> Visitor<'de> for Alternatives<T> {
    type Value = OneOrMany<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value or a list of values")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
        let mut values = Vec::new();
        while let Some(value) = list.next_element()? {
            values.push(value);
        }
        if values.is_empty() {
            return Err(refuse(
                "an empty list selects nothing",
                "at least one value is expected here",
                "",
            ));
        }
        Ok(OneOrMany { values, listed: true })
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
        T::deserialize(MapAccessDeserializer::new(map)).map(OneOrMany::from)
    }

    fn visit_bool<E: de::Error>(self, value: bool) -> Result<Self::Value, E> {
        one(value)
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Self::Value, E> {
        one(value)
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<Self::Value, E> {
        one(value)
    }

    fn visit_i128<E: de::Error>(self, value: i128) -> Result<Self::Value, E> {
        one(value)
    }

    fn visit_u128<E: de::Error>(self, value: u128) -> Result<Self::Value, E> {
        one(value)
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Self::Value, E> {
        one(value)
    }

    fn visit_str<E: de::Error>(self, value: &str) -> Result<Self::Value, E> {
        one(value)
    }
}

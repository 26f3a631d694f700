//! Checks rules that hold for all keys of a suite file: no duplicate keys, no merge keys, a maximum
//! number of entries, and finite numbers.
//!
//! The checks are a separate pass, because a typed parser would report a duplicate key only after
//! parsing the value of the key, and a field of type `f64` accepts `.nan`.
//!
//! The error for a refused value has three texts (message, label and help), but the error type of a
//! deserializer holds one string, to which the YAML library adds a path and a position. Separators
//! mark the three texts. A file cannot forge separators, because sources with control characters
//! are refused.

use super::{MAX_ENTRIES, Source};
use serde::de::{self, Deserialize, DeserializeSeed, Deserializer, MapAccess, SeqAccess, Visitor};
use std::collections::HashSet;
use std::fmt;
use std::marker::PhantomData;

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum TopValue {
    Absent,
    Text(String),
    Other,
}

/// Checks the whole file. Returns the value of the top-level key `key`.
pub(crate) fn check(source: &Source, key: &str) -> Result<TopValue, serde_yaml::Error> {
    let parser = serde_yaml::Deserializer::from_str(source.text());
    let mut found = TopValue::Absent;
    ShapeCheck::Root { key, found: &mut found }.deserialize(parser)?;
    Ok(found)
}

/// Deserialization seed that checks the rules for a value.
enum ShapeCheck<'k> {
    /// The whole file, and the key whose value is stored.
    Root { key: &'k str, found: &'k mut TopValue },
    /// The value to store.
    Kept(&'k mut TopValue),
    /// Any other value.
    Inside,
}

impl<'de> DeserializeSeed<'de> for ShapeCheck<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for ShapeCheck<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let mut seen = HashSet::new();
        let mut root = match self {
            Self::Root { key, found } => Some((key, found)),
            Self::Kept(_) | Self::Inside => None,
        };
        while let Some(name) = map.next_key_seed(NewKey { seen: &mut seen })? {
            map.next_value_seed(match &mut root {
                Some((key, found)) if *key == name => {
                    **found = TopValue::Other;
                    ShapeCheck::Kept(found)
                }
                _ => ShapeCheck::Inside,
            })?;
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        let mut length = 0;
        while list.next_element_seed(Self::Inside)?.is_some() {
            length += 1;
            within_cap(length, "list")?;
        }
        Ok(())
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<(), E> {
        finite(value, "a finite number").map(drop)
    }

    fn visit_none<E: de::Error>(self) -> Result<(), E> {
        self.visit_unit()
    }

    fn visit_unit<E: de::Error>(self) -> Result<(), E> {
        if !matches!(self, Self::Root { .. }) {
            return Ok(());
        }
        Err(refuse("the file is empty; a suite starts with `suite: NAME`", "", ""))
    }

    fn visit_bool<E: de::Error>(self, _: bool) -> Result<(), E> {
        Ok(())
    }

    fn visit_i64<E: de::Error>(self, _: i64) -> Result<(), E> {
        Ok(())
    }

    fn visit_u64<E: de::Error>(self, _: u64) -> Result<(), E> {
        Ok(())
    }

    fn visit_i128<E: de::Error>(self, _: i128) -> Result<(), E> {
        Ok(())
    }

    fn visit_u128<E: de::Error>(self, _: u128) -> Result<(), E> {
        Ok(())
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<(), E> {
        if let Self::Kept(found) = self {
            *found = TopValue::Text(text.to_owned());
        }
        Ok(())
    }
}

/// Deserializes a map key, and refuses a duplicate with an error at the key.
struct NewKey<'a> {
    seen: &'a mut HashSet<String>,
}

impl<'de> DeserializeSeed<'de> for NewKey<'_> {
    type Value = String;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<String, D::Error> {
        deserializer.deserialize_str(self)
    }
}

impl Visitor<'_> for NewKey<'_> {
    type Value = String;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a name as key")
    }

    fn visit_str<E: de::Error>(self, key: &str) -> Result<String, E> {
        if key == "<<" {
            return Err(refuse(
                "merge keys are not supported",
                "a key cannot be `<<`",
                "write the keys out; give a value a name under `parameters`",
            ));
        }
        if !self.seen.insert(key.to_owned()) {
            return Err(refuse(
                &format!("the key `{key}` is given twice"),
                "the second time",
                "keep one of the two",
            ));
        }
        within_cap(self.seen.len(), "map")?;
        Ok(key.to_owned())
    }
}

/// Names and their values, in the order of the file, without duplicates.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ordered<T>(Vec<(String, T)>);

impl<T> Ordered<T> {
    /// Returns the entries in the order of the file.
    pub fn as_slice(&self) -> &[(String, T)] {
        &self.0
    }

    /// Replaces the value of `name`, if there is one.
    #[must_use]
    pub fn with(mut self, name: &str, value: T) -> Self {
        if let Some((_, old)) = self.0.iter_mut().find(|(key, _)| key == name) {
            *old = value;
        }
        self
    }

    /// Returns the value of a name.
    pub fn get(&self, name: &str) -> Option<&T> {
        self.0.iter().find(|(key, _)| key == name).map(|(_, value)| value)
    }
}

impl<T> Default for Ordered<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Ordered<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(OrderedEntries(PhantomData)).map(Self)
    }
}

#[cfg(feature = "schemas")]
impl<T: schemars::JsonSchema> schemars::JsonSchema for Ordered<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        format!("Ordered_{}", T::schema_name()).into()
    }

    fn json_schema(all: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let value = all.subschema_for::<T>();
        schemars::json_schema!({"type": "object", "additionalProperties": value})
    }
}

struct OrderedEntries<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for OrderedEntries<T> {
    type Value = Vec<(String, T)>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a map")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut seen = HashSet::new();
        let mut entries = Vec::new();
        while let Some(name) = map.next_key_seed(NewKey { seen: &mut seen })? {
            entries.push((name, map.next_value()?));
        }
        Ok(entries)
    }
}

pub(crate) fn within_cap<E: de::Error>(length: usize, what: &str) -> Result<(), E> {
    if length <= MAX_ENTRIES {
        return Ok(());
    }
    let message = format!("this {what} has more than {MAX_ENTRIES} entries");
    Err(refuse(&message, "", ""))
}

/// Refuses `.nan` and `.inf`, which are valid numbers in YAML.
pub(crate) fn finite<E: de::Error>(value: f64, expected: &str) -> Result<f64, E> {
    if value.is_finite() {
        return Ok(value);
    }
    let found = if value.is_nan() { "NaN" } else { "infinity" };
    Err(refuse(
        &format!("expected {expected}, found {found}"),
        &format!("{expected} is expected here"),
        "",
    ))
}

const FENCE: char = '\u{1f}';

/// Creates the error for a value that is refused during deserialization.
///
/// `label` and `help` may be empty. [`read`](super::read()) shows the three texts unchanged, at the
/// position of the innermost value being parsed.
pub fn refuse<E: de::Error>(message: &str, label: &str, help: &str) -> E {
    let [message, label, help] = [message, label, help].map(|part| part.replace(FENCE, " "));
    E::custom(format!("{FENCE}{message}{FENCE}{label}{FENCE}{help}{FENCE}"))
}

/// Returns message, label and help, if `error` is the text of a refusal.
pub(crate) fn refused(error: &str) -> Option<[&str; 3]> {
    let mut parts = error.split(FENCE).skip(1);
    Some([parts.next()?, parts.next()?, parts.next()?])
}

//! Locates a value in a file after parsing.
//!
//! The YAML library reports positions only in errors. The text is therefore parsed again with a
//! `DeserializeSeed` that follows the path to the value and then fails on purpose. The error
//! contains the position.

use super::{Diagnostic, OneOrMany, Place, Source};
use serde::de::{self, DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};
use std::cell::Cell;
use std::fmt;
use std::ops::Range;

/// One step into a map or a list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// Into the value of a key.
    Key(String),
    /// Into a list entry; indices start at zero.
    Index(usize),
}

impl From<&str> for Step {
    fn from(key: &str) -> Self {
        Self::Key(key.to_owned())
    }
}

impl From<usize> for Step {
    fn from(index: usize) -> Self {
        Self::Index(index)
    }
}

#[derive(Debug, Clone)]
pub(crate) struct Path(Vec<Step>);

impl Path {
    pub(crate) fn top(key: &str) -> Self {
        Self(vec![Step::from(key)])
    }

    pub(crate) fn then(&self, step: impl Into<Step>) -> Self {
        let mut longer = self.0.clone();
        longer.push(step.into());
        Self(longer)
    }

    /// Returns the path of value number `i` if the setting at this path is a list of
    /// `alternatives`, and otherwise this path.
    pub(crate) fn alternative<T>(&self, alternatives: &OneOrMany<T>, i: usize) -> Self {
        if alternatives.is_listed() { self.then(i) } else { self.clone() }
    }

    pub(crate) fn steps(&self) -> &[Step] {
        &self.0
    }
}

impl Source {
    /// Returns the position of a value; for a list or a map, the position of its first character.
    pub fn value_at(&self, path: &[Step]) -> Option<Place> {
        self.find(path, Sought::Value).map(|at| Place::of(self.text(), self.token_at(at)))
    }

    /// Returns a diagnostic about the value at `path`; about the file if there is no such value.
    pub fn diagnostic_at(&self, path: &[Step], message: &str) -> Diagnostic {
        match self.value_at(path) {
            Some(place) => self.diagnostic(place, message),
            None => Diagnostic::about(self.name(), message),
        }
    }

    /// Returns the position of the key in the last step of `path`.
    pub fn key_at(&self, path: &[Step]) -> Option<Place> {
        self.find(path, Sought::Key).map(|at| Place::of(self.text(), self.token_at(at)))
    }

    /// Returns the position of a byte range within a text value, such as one name in a formula.
    ///
    /// If the file does not contain the value verbatim (escapes, several lines), returns the
    /// position of the whole value.
    pub fn within(&self, path: &[Step], bytes: Range<usize>) -> Option<Place> {
        let at = self.find(path, Sought::Value)?;
        let verbatim = self.scalar_at(at).and_then(|scalar| scalar.verbatim(self.text()));
        let part = verbatim.and_then(|value| {
            let end = value.start.checked_add(bytes.end)?;
            (bytes.start <= bytes.end && end <= value.end).then(|| value.start + bytes.start..end)
        });
        Some(Place::of(self.text(), part.unwrap_or_else(|| self.token_at(at))))
    }

    fn find(&self, path: &[Step], sought: Sought) -> Option<usize> {
        let found = Cell::new(false);
        let walk = Walk { path, sought, found: &found };
        let error = walk.deserialize(serde_yaml::Deserializer::from_str(self.text())).err()?;
        let location = error.location().filter(|_| found.get())?;
        Some(location.index())
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Sought {
    Value,
    Key,
}

#[derive(Clone, Copy)]
struct Walk<'a> {
    path: &'a [Step],
    sought: Sought,
    found: &'a Cell<bool>,
}

impl Walk<'_> {
    fn stop<E: de::Error>(self) -> E {
        self.found.set(true);
        E::custom("found")
    }

    fn scalar<E: de::Error>(self) -> Result<(), E> {
        if self.path.is_empty() { Err(self.stop()) } else { Ok(()) }
    }
}

impl<'de> DeserializeSeed<'de> for Walk<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Walk<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("anything")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let Some((step, path)) = self.path.split_first() else { return Err(self.stop()) };
        let Step::Key(key) = step else { return Ok(()) };
        let last = path.is_empty() && self.sought == Sought::Key;
        while let Some(same) = map.next_key_seed(Key { wanted: key, last, walk: self })? {
            if same {
                return map.next_value_seed(Self { path, ..self });
            }
            map.next_value::<IgnoredAny>()?;
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        let Some((step, path)) = self.path.split_first() else { return Err(self.stop()) };
        let Step::Index(index) = step else { return Ok(()) };
        for _ in 0..*index {
            if list.next_element::<IgnoredAny>()?.is_none() {
                return Ok(());
            }
        }
        list.next_element_seed(Self { path, ..self }).map(Option::unwrap_or_default)
    }

    fn visit_bool<E: de::Error>(self, _: bool) -> Result<(), E> {
        self.scalar()
    }

    fn visit_i64<E: de::Error>(self, _: i64) -> Result<(), E> {
        self.scalar()
    }

    fn visit_u64<E: de::Error>(self, _: u64) -> Result<(), E> {
        self.scalar()
    }

    fn visit_i128<E: de::Error>(self, _: i128) -> Result<(), E> {
        self.scalar()
    }

    fn visit_u128<E: de::Error>(self, _: u128) -> Result<(), E> {
        self.scalar()
    }

    fn visit_f64<E: de::Error>(self, _: f64) -> Result<(), E> {
        self.scalar()
    }

    fn visit_str<E: de::Error>(self, _: &str) -> Result<(), E> {
        self.scalar()
    }

    fn visit_unit<E: de::Error>(self) -> Result<(), E> {
        self.scalar()
    }

    fn visit_none<E: de::Error>(self) -> Result<(), E> {
        self.scalar()
    }
}

/// Seed that compares a key with `wanted`. If the key itself is to be located, deserialization
/// fails on purpose at this key.
struct Key<'a> {
    wanted: &'a str,
    last: bool,
    walk: Walk<'a>,
}

impl<'de> DeserializeSeed<'de> for Key<'_> {
    type Value = bool;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<bool, D::Error> {
        deserializer.deserialize_str(self)
    }
}

impl Visitor<'_> for Key<'_> {
    type Value = bool;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a key")
    }

    fn visit_str<E: de::Error>(self, key: &str) -> Result<bool, E> {
        let same = key == self.wanted;
        if same && self.last { Err(self.walk.stop()) } else { Ok(same) }
    }
}

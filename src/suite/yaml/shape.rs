//! Rules for every suite file, whatever its keys mean: no key twice, no merge keys, no endless
//! lists, only finite numbers.
//!
//! Checked in a walk of its own, because a typed reader notices a second key only after its
//! value, and a field of type `f64` accepts `.nan`.

use super::{MAX_ENTRIES, Source, refuse};
use serde::de::{self, DeserializeSeed, Deserializer, MapAccess, SeqAccess, Visitor};
use std::collections::HashSet;
use std::fmt;

/// Walks the whole file.
pub(crate) fn check(source: &Source) -> Result<(), serde_yaml::Error> {
    ShapeCheck { root: true }.deserialize(serde_yaml::Deserializer::from_str(source.text()))
}

struct ShapeCheck {
    root: bool,
}

const INSIDE: ShapeCheck = ShapeCheck { root: false };

impl<'de> DeserializeSeed<'de> for ShapeCheck {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for ShapeCheck {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let mut seen = HashSet::new();
        while map.next_key_seed(NewKey { seen: &mut seen })?.is_some() {
            map.next_value_seed(INSIDE)?;
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        let mut length = 0;
        while list.next_element_seed(INSIDE)?.is_some() {
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
        if !self.root {
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

    fn visit_str<E: de::Error>(self, _: &str) -> Result<(), E> {
        Ok(())
    }
}

/// Reads a key of a map that must not have been seen; an error stands at the key itself.
pub(crate) struct NewKey<'a> {
    pub(crate) seen: &'a mut HashSet<String>,
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

/// Refuses a list or a map that has grown past the cap.
pub(crate) fn within_cap<E: de::Error>(length: usize, what: &str) -> Result<(), E> {
    if length <= MAX_ENTRIES {
        return Ok(());
    }
    let message = format!("this {what} has more than {MAX_ENTRIES} entries");
    Err(refuse(&message, "", ""))
}

/// Refuses `.nan` and `.inf`, which YAML counts as numbers.
pub(crate) fn finite<E: de::Error>(value: f64, expected: &str) -> Result<f64, E> {
    if value.is_finite() {
        return Ok(value);
    }
    let found = if value.is_nan() { "not a number" } else { "infinite" };
    Err(refuse(
        &format!("expected {expected}, found one that is {found}"),
        &format!("{expected} is expected here"),
        "",
    ))
}

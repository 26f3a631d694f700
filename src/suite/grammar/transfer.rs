//! The words of a transfer: a name, or a series and its number of terms (`{fmpm: 8}`).

use crate::{
    mpm::{TransferChoice, TransferName},
    suite::yaml::refuse,
};
use serde::de::{
    Deserialize, Deserializer, Error, MapAccess, Visitor,
    value::{MapAccessDeserializer, StrDeserializer},
};
use std::fmt;

/// Most terms of a series: each is two passes over the particles.
const MOST: u32 = 64;

/// A series with its number of terms.
#[derive(serde::Deserialize)]
#[serde(rename_all = "snake_case")]
enum Series {
    Xpic(u32),
    Fmpm(u32),
}

impl<'de> Deserialize<'de> for TransferChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NameOrSeries)
    }
}

struct NameOrSeries;

impl<'de> Visitor<'de> for NameOrSeries {
    type Value = TransferChoice;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of a transfer, or a series with its number of terms")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<TransferChoice, E> {
        TransferName::deserialize(StrDeserializer::new(name)).map(TransferChoice::Named)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<TransferChoice, A::Error> {
        let series = Series::deserialize(MapAccessDeserializer::new(map))?;
        let (Series::Xpic(terms) | Series::Fmpm(terms)) = series;
        if !(1..=MOST).contains(&terms) {
            let message = format!("a series of {terms} terms");
            let label = format!("expected a whole number from 1 to {MOST}");
            return Err(refuse(&message, &label, ""));
        }
        Ok(match series {
            Series::Xpic(terms) => TransferChoice::Xpic(terms),
            Series::Fmpm(terms) => TransferChoice::Fmpm(terms),
        })
    }
}

//! Grammar of a transfer: a name, or a name with its parameter (`{fmpm: 8}`).

use crate::mpm::{TransferChoice, TransferName, WithParameter};
use crate::suite::yaml::refuse;
use serde::de::value::StrDeserializer;
use serde::de::{Deserialize, Deserializer, Error, MapAccess, Visitor};
use std::fmt;

impl<'de> Deserialize<'de> for TransferChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NameOrParameter)
    }
}

#[cfg(feature = "schemas")]
impl schemars::JsonSchema for TransferChoice {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        "TransferChoice".into()
    }

    fn json_schema(all: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let series = WithParameter::ALL.iter().map(|name| {
            let (least, most) = name.parameter().range;
            let terms = schemars::json_schema!({
                "type": "integer", "minimum": least, "maximum": most,
                "description": "Number of terms."
            });
            schemars::json_schema!({
                "type": "object", "properties": {name.name(): terms},
                "required": [name.name()], "additionalProperties": false
            })
        });
        let name = all.subschema_for::<TransferName>();
        schemars::json_schema!({"anyOf": std::iter::once(name).chain(series).collect::<Vec<_>>()})
    }
}

struct NameOrParameter;

impl<'de> Visitor<'de> for NameOrParameter {
    type Value = TransferChoice;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of a transfer, or a series with its number of terms")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<TransferChoice, E> {
        TransferName::deserialize(StrDeserializer::new(name)).map(TransferChoice::Named)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<TransferChoice, A::Error> {
        let Some(name) = map.next_key::<WithParameter>()? else {
            return Err(A::Error::invalid_length(0, &self));
        };
        let (value, parameter) = (map.next_value::<u32>()?, name.parameter());
        let ((least, most), (before, after)) = (parameter.range, parameter.words);
        if !(least..=most).contains(&value) {
            let message = format!("{before} {value} {after}");
            let label = format!("expected a whole number from {least} to {most}");
            return Err(refuse(&message, &label, ""));
        }
        if map.next_key::<WithParameter>()?.is_some() {
            return Err(A::Error::invalid_length(2, &self));
        }
        Ok(TransferChoice::With(name, value))
    }
}

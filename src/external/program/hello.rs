//! The first answer of a solver.

use crate::external::capabilities::Capabilities;
use crate::subject::Precision;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};
use serde_json::Value;

/// Who a solver is, and what it can do.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
pub(super) struct Hello {
    /// Version of the protocol.
    pub(super) protocol: u64,
    /// Name: letters, digits, `-`, `_` and `.`, no more than 64.
    pub(super) name: String,
    /// Version of the solver.
    #[serde(default)]
    pub(super) version: String,
    /// Order in h of its displacements on a smooth solution.
    #[serde(default = "two")]
    pub(super) formal_order: f64,
    /// Precision of its numbers.
    #[serde(default)]
    #[schemars(schema_with = "precisions")]
    pub(super) precision: Precision,
    /// Abilities; what is not named is lacking.
    #[serde(default)]
    #[schemars(with = "Capabilities")]
    pub(super) capabilities: StatedCapabilities,
}

/// Abilities as a solver states them.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct StatedCapabilities {
    pub(super) known: Capabilities,
    /// All keys, those that mean nothing included.
    pub(super) keys: Vec<String>,
}

impl<'de> Deserialize<'de> for StatedCapabilities {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let all = Value::deserialize(from)?;
        let keys = all.as_object().map_or(Vec::new(), |all| all.keys().cloned().collect());
        let known = Capabilities::deserialize(all).map_err(D::Error::custom)?;
        Ok(Self { known, keys })
    }
}

fn precisions(_: &mut SchemaGenerator) -> Schema {
    let names: Vec<&str> = Precision::ALL.iter().map(|precision| precision.name()).collect();
    json_schema!({"enum": names})
}

fn two() -> f64 {
    2.0
}

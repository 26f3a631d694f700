//! Messages of a solver: answers, and requests for values.

use super::error::{ProgramError, plain, printable};
use super::frame::MessageFrame;
use crate::external::capabilities::Capabilities;
use crate::subject::Precision;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};
use serde_json::Value;
use std::collections::BTreeMap;

/// A message of a solver: an answer, or a request for values.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub(super) enum Answer {
    Hello(Hello),
    /// The problem is accepted.
    Ready {
        /// Points at which the solver reports its states; by default the particles of the problem.
        #[serde(default)]
        points: Option<Points>,
    },
    /// The problem is refused.
    Cannot {
        /// Reason of the refusal.
        reason: String,
    },
    State(Box<State>),
    /// The value of a functional of the final state, and its derivatives.
    Gradient {
        /// Value of the functional.
        value: f64,
        /// Derivatives, one for each entry of `with_respect_to`, in the same order.
        gradient: Vec<f64>,
    },
    /// The solver failed.
    Failed {
        /// Description of the failure.
        reason: String,
    },
    /// A request for the body force.
    BodyForce {
        /// Time (s).
        t: f64,
        /// Reference positions (m), D numbers each; by default those of the particles or sample
        /// points.
        #[serde(default)]
        reference_position: Option<ColumnText>,
        /// Displacements (m) at these positions, D numbers each, if the values depend on
        /// displacements.
        #[serde(default)]
        displacement: Option<ColumnText>,
        /// Index of the body that contains all positions.
        #[serde(default)]
        body: Option<usize>,
    },
    /// A request for values of a field.
    Values {
        /// The field: `body_force`, `displacement`, `velocity`, `deformation_gradient`, `stress`,
        /// `initial_stress`, `initial_stress_across`, `load:INDEX` or `face:NAME`.
        of: String,
        /// Time (s); fields of the initial state need none.
        #[serde(default)]
        t: Option<f64>,
        /// Reference positions (m), D numbers each; by default those of the particles or sample
        /// points.
        #[serde(default)]
        reference_position: Option<ColumnText>,
        /// Displacements (m) at these positions, D numbers each, if the values depend on
        /// displacements.
        #[serde(default)]
        displacement: Option<ColumnText>,
        /// Index of the body that contains all positions.
        #[serde(default)]
        body: Option<usize>,
    },
}

/// Sample points of a solver that does not use the particles of the problem.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
pub(super) struct Points {
    /// Reference positions (m), D numbers each.
    pub(super) reference_position: ColumnText,
    /// Reference volume (m^D) of each point.
    pub(super) weight: ColumnText,
}

/// A state after a step.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
pub(super) struct State {
    /// Columns by name: `displacement` (m), `velocity` (m/s), and the columns in `capabilities`.
    pub(super) columns: BTreeMap<String, ColumnText>,
    /// Total number of times that a particle has moved to another cell.
    #[serde(default)]
    pub(super) crossings: Option<u64>,
    /// Number of particles outside the grid.
    #[serde(default)]
    pub(super) left_domain: Option<u64>,
    /// Smallest determinant of F of any particle since the start.
    #[serde(default)]
    pub(super) min_j: Option<f64>,
}

pub(super) struct ValueRequest {
    /// Name of the requested field. A `body_force` request has no such name.
    pub(super) of: Option<String>,
    pub(super) t: Option<f64>,
    pub(super) reference_position: Option<ColumnText>,
    pub(super) displacement: Option<ColumnText>,
    pub(super) body: Option<usize>,
}

/// Identity and capabilities of a solver.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
pub(super) struct Hello {
    /// Version of the protocol.
    pub(super) protocol: u64,
    /// Name: at most 64 letters, digits, `-`, `_` and `.`.
    pub(super) name: String,
    /// Version of the solver.
    #[serde(default)]
    pub(super) version: String,
    /// Order in h of the displacement error for a smooth solution.
    #[serde(default = "two")]
    pub(super) formal_order: f64,
    /// Precision of the solver's numbers.
    #[serde(default)]
    #[schemars(schema_with = "precisions")]
    pub(super) precision: Precision,
    /// Capabilities; those that are not listed are missing.
    #[serde(default)]
    #[schemars(with = "Capabilities")]
    pub(super) capabilities: StatedCapabilities,
}

impl Hello {
    /// Returns the settings for reports.
    pub(super) fn settings(&self) -> Vec<(String, String)> {
        let version = printable(&self.version);
        let version = if version.is_empty() { "not stated".to_owned() } else { version };
        vec![
            ("solver".to_owned(), self.name.clone()),
            ("version".to_owned(), version),
            ("precision".to_owned(), self.precision.name().to_owned()),
            ("formal order".to_owned(), format!("{}, as stated by the solver", self.formal_order)),
        ]
    }
}

#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct StatedCapabilities {
    pub(super) known: Capabilities,
    /// All keys, including unknown ones.
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

/// A column: its numbers, or its position in the bytes after the message, as offset (bytes) and
/// number of doubles.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(untagged)]
pub(super) enum ColumnText {
    Numbers(Vec<f64>),
    Bytes { f64: (usize, usize) },
}

impl ColumnText {
    /// Returns the number of entries, without reading the bytes.
    pub(super) fn count(&self) -> usize {
        match self {
            Self::Numbers(numbers) => numbers.len(),
            Self::Bytes { f64: (_, length) } => *length,
        }
    }

    /// Returns the numbers of the column `name`. There must be exactly `count` numbers, all finite.
    pub(super) fn numbers(
        self,
        name: &str,
        count: usize,
        bytes: &[u8],
    ) -> Result<Vec<f64>, ProgramError> {
        let numbers = match self {
            Self::Numbers(numbers) => numbers,
            Self::Bytes { f64: (offset, length) } => {
                let end = length.checked_mul(8).and_then(|length| offset.checked_add(length));
                let part = end.and_then(|end| bytes.get(offset..end)).ok_or_else(|| {
                    ProgramError::Protocol(format!(
                        "sent the column `{name}` as {length} doubles from byte {offset}, but the \
                         message has {} bytes",
                        bytes.len()
                    ))
                })?;
                let number = |bytes: &[u8]| bytes.try_into().map_or(f64::NAN, f64::from_le_bytes);
                part.chunks_exact(8).map(number).collect()
            }
        };
        if numbers.len() != count {
            return Err(ProgramError::Protocol(format!(
                "sent {} numbers in the column `{name}`, expected {count}",
                numbers.len()
            )));
        }
        match numbers.iter().enumerate().find(|(_, number)| !number.is_finite()) {
            Some((index, value)) => Err(ProgramError::Protocol(format!(
                "sent {value} as number {index} of the column `{name}`"
            ))),
            None => Ok(numbers),
        }
    }
}

impl Answer {
    pub(super) fn read(frame: &MessageFrame) -> Result<Self, ProgramError> {
        serde_json::from_slice(&frame.line).map_err(|error| {
            let text = String::from_utf8_lossy(&frame.line);
            // Python and other languages write these texts for numbers that JSON cannot represent.
            for word in ["NaN", "Infinity"] {
                if text.contains(word) {
                    return ProgramError::NoNumber(word);
                }
            }
            let reason = if text.trim_start().starts_with('{') {
                plain(&error)
            } else {
                "not a JSON object; print other text on standard error".to_owned()
            };
            let excerpt = excerpt(&text);
            ProgramError::Protocol(format!("sent an invalid message ({reason}): `{excerpt}`"))
        })
    }

    pub(super) fn columns(self) -> Vec<(String, ColumnText)> {
        match self {
            Self::Ready { points: Some(points) } => vec![
                ("reference_position".to_owned(), points.reference_position),
                ("weight".to_owned(), points.weight),
            ],
            Self::State(state) => state.columns.into_iter().collect(),
            Self::BodyForce { reference_position, displacement, .. }
            | Self::Values { reference_position, displacement, .. } => {
                let places = reference_position.map(|column| ("reference_position", column));
                let moved = displacement.map(|column| ("displacement", column));
                let all = places.into_iter().chain(moved);
                all.map(|(name, column)| (name.to_owned(), column)).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Converts the answer to a request for values. The error is any other answer.
    pub(super) fn request(self) -> Result<ValueRequest, Box<Self>> {
        match self {
            Self::BodyForce { t, reference_position, displacement, body } => {
                Ok(ValueRequest { of: None, t: Some(t), reference_position, displacement, body })
            }
            Self::Values { of, t, reference_position, displacement, body } => {
                Ok(ValueRequest { of: Some(of), t, reference_position, displacement, body })
            }
            other => Err(Box::new(other)),
        }
    }

    pub(super) fn name(&self) -> &'static str {
        match self {
            Self::Hello(_) => "hello",
            Self::Ready { .. } => "ready",
            Self::Cannot { .. } => "cannot",
            Self::State(_) => "state",
            Self::Gradient { .. } => "gradient",
            Self::Failed { .. } => "failed",
            Self::BodyForce { .. } => "body_force",
            Self::Values { .. } => "values",
        }
    }
}

/// Returns the beginning of an untrusted text, safe to print.
fn excerpt(text: &str) -> String {
    let start = printable(&text.chars().take(60).collect::<String>());
    if text.chars().nth(60).is_some() { format!("{start}...") } else { start }
}

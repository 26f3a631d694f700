//! Answers of a solver.

use super::column::ColumnText;
use super::frame::MessageFrame;
use super::hello::Hello;
use super::printable::{plain, printable};
use super::request::ValueRequest;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

/// An answer of a solver.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub(super) enum Answer {
    Hello(Hello),
    /// The problem is taken.
    Ready {
        /// Places of the states to come; the particles, if there are none.
        #[serde(default)]
        points: Option<Points>,
    },
    /// The problem is not for this solver.
    Cannot {
        /// Why.
        reason: String,
    },
    State(Box<State>),
    /// The solver broke.
    Failed {
        /// How.
        reason: String,
    },
    /// Not an answer: a question for the body force.
    BodyForce {
        /// Time (s).
        t: f64,
        /// Reference positions (m), D numbers each; the particles or points, if there are none.
        #[serde(default)]
        reference_position: Option<ColumnText>,
        /// Displacements (m) there, D numbers each, for a force that depends on them.
        #[serde(default)]
        displacement: Option<ColumnText>,
        /// Index of the body that all places belong to.
        #[serde(default)]
        body: Option<usize>,
    },
    /// Not an answer: a request for values of a field.
    Values {
        /// The field: `body_force`, `displacement`, `velocity`, `deformation_gradient`, `stress`,
        /// `initial_stress`, `load:INDEX` or `face:NAME`.
        of: String,
        /// Time (s); fields of the initial state need none.
        #[serde(default)]
        t: Option<f64>,
        /// Reference positions (m), D numbers each; the particles or points, if there are none.
        #[serde(default)]
        reference_position: Option<ColumnText>,
        /// Displacements (m) there, D numbers each, for a force that depends on them.
        #[serde(default)]
        displacement: Option<ColumnText>,
        /// Index of the body that all places belong to.
        #[serde(default)]
        body: Option<usize>,
    },
}

/// Places of a solver that has no particles, or others.
#[derive(Debug, Deserialize, JsonSchema)]
pub(super) struct Points {
    /// Reference positions (m), D numbers each.
    pub(super) reference_position: ColumnText,
    /// Reference volume (m^D) that each stands for.
    pub(super) weight: ColumnText,
}

/// A state after a step.
#[derive(Debug, Deserialize, JsonSchema)]
pub(super) struct State {
    /// Columns by their names: `displacement` (m), `velocity` (m/s), and what `capabilities` names.
    pub(super) columns: BTreeMap<String, ColumnText>,
    /// How often particles changed their cells so far.
    #[serde(default)]
    pub(super) crossings: Option<u64>,
    /// Particles outside the grid.
    #[serde(default)]
    pub(super) left_domain: Option<u64>,
    /// Smallest determinant of F so far.
    #[serde(default)]
    pub(super) min_j: Option<f64>,
}

/// Size of the block of bytes that a message announces.
#[derive(Deserialize)]
struct Announced {
    #[serde(default)]
    bytes: usize,
}

impl Answer {
    /// Reads the answer in a frame.
    pub(super) fn read(frame: &MessageFrame) -> Result<Self, String> {
        serde_json::from_slice(&frame.line).map_err(|error| {
            let text = String::from_utf8_lossy(&frame.line);
            // What Python and others write for what JSON has no word for.
            for word in ["NaN", "Infinity"] {
                if text.contains(word) {
                    return format!("answered with {word}, which is no number");
                }
            }
            if !text.trim_start().starts_with('{') {
                let hint = "what else it prints belongs on its standard error";
                return format!("answered with what is no message ({hint}): `{}`", excerpt(&text));
            }
            format!("answered with what is no message ({}): `{}`", plain(&error), excerpt(&text))
        })
    }

    /// Its columns with their names.
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

    /// The request for values, if it is one.
    ///
    /// # Errors
    /// The answer itself.
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

    /// Its type, as messages spell it.
    pub(super) fn name(&self) -> &'static str {
        match self {
            Self::Hello(_) => "hello",
            Self::Ready { .. } => "ready",
            Self::Cannot { .. } => "cannot",
            Self::State(_) => "state",
            Self::Failed { .. } => "failed",
            Self::BodyForce { .. } => "body_force",
            Self::Values { .. } => "values",
        }
    }
}

/// How many bytes follow a line; none of a line that is no message, which [`Answer::read`] refuses.
pub(super) fn announced(line: &[u8]) -> usize {
    // Most lines announce none: they need not be read twice.
    if !line.windows(7).any(|word| word == b"\"bytes\"") {
        return 0;
    }
    serde_json::from_slice::<Announced>(line).map_or(0, |announced| announced.bytes)
}

/// The beginning of a stranger's text.
fn excerpt(text: &str) -> String {
    let start = printable(&text.chars().take(60).collect::<String>());
    if text.chars().nth(60).is_some() { format!("{start}...") } else { start }
}

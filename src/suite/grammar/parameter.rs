//! A parameter: a number, or a table (`{by: t, table: [[0, 0], [0.1, 1]]}`).

use crate::suite::yaml::{InPlaceOfNumber, NumberOr, NumberText};
use serde::Deserialize;

/// A number, a formula of the parameters above it, or a table.
pub(crate) type ParameterSpec = NumberOr<TableSpec>;

/// `{by: t, table: [[0, 0], [0.1, 1]]}`: values by another parameter or by a variable of formulas.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct TableSpec {
    /// A parameter, or a variable of formulas.
    pub(crate) by: String,
    /// Rows of a value of `by` and the parameter's value there.
    pub(crate) table: Vec<Vec<NumberText>>,
}

impl InPlaceOfNumber for TableSpec {
    const EXPECTED: &'static str = "a number, a formula, or `{by: t, table: [[0, 0], [0.1, 1]]}`";
}

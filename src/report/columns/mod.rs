//! Columns of tables, each declared once: heading, JSON key, meaning, and value.
//!
//! Text, JSON, Markdown and `docs/columns.md` read the same lists. To add a column is to add an
//! entry to a list.

mod cell;
mod column;
pub(crate) mod cost;
pub(crate) mod force;
pub(crate) mod level;
pub(crate) mod number;
pub(crate) mod stability;
#[cfg(test)]
mod tests;
pub(crate) mod timed_level;

pub(crate) use cell::{Cell, decimals, scientific, short};
pub(crate) use column::{TableColumn, json_object};

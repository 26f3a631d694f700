//! A column, declared once for all forms of a table.

use super::Cell;
use super::cell::Text;
use serde_json::{Map, Value};
use std::borrow::Cow;

/// A column of a table with rows of type `R`.
pub(crate) struct TableColumn<'a, R: ?Sized> {
    /// Heading in text and Markdown.
    pub(crate) heading: Cow<'a, str>,
    /// Key in the JSON object of a row: `errors.rms` is the key `rms` of the object `errors`; empty
    /// for a column of text only.
    pub(crate) key: &'static str,
    /// Meaning, with the unit.
    pub(crate) about: &'static str,
    /// Whether text is set flush left; numbers are set flush right.
    pub(crate) flush_left: bool,
    cell: Box<dyn Fn(&R) -> Cell + 'a>,
}

impl<'a, R: ?Sized + 'a> TableColumn<'a, R> {
    /// A column of text and JSON.
    pub(crate) fn new(
        heading: impl Into<Cow<'a, str>>,
        key: &'static str,
        about: &'static str,
        cell: impl Fn(&R) -> Cell + 'a,
    ) -> Self {
        Self { heading: heading.into(), key, about, flush_left: false, cell: Box::new(cell) }
    }

    /// A column of text only.
    pub(crate) fn text<V: Text>(
        heading: impl Into<Cow<'a, str>>,
        about: &'static str,
        text: impl Fn(&R) -> V + 'a,
    ) -> Self {
        Self::new(heading, "", about, move |row| Cell::text(text(row)))
    }

    /// A column of JSON only.
    pub(crate) fn json<V: Into<Value>>(
        key: &'static str,
        about: &'static str,
        json: impl Fn(&R) -> V + 'a,
    ) -> Self {
        Self::new("", key, about, move |row| Cell::json(json(row)))
    }

    /// The same column, set flush left.
    pub(crate) fn flush_left(self) -> Self {
        Self { flush_left: true, ..self }
    }

    /// The same column of a table whose rows hold an `R`; dashes in rows without one.
    pub(crate) fn within<S: 'a>(self, part: impl Fn(&S) -> Option<&R> + 'a) -> TableColumn<'a, S> {
        let Self { heading, key, about, flush_left, cell } = self;
        let cell = move |row: &S| part(row).map_or_else(|| Cell::json(Value::Null), &cell);
        TableColumn { heading, key, about, flush_left, cell: Box::new(cell) }
    }

    /// The value in a row.
    pub(crate) fn cell(&self, row: &R) -> Cell {
        (self.cell)(row)
    }
}

/// The JSON object of a row.
pub(crate) fn json_object<R: ?Sized>(columns: &[TableColumn<'_, R>], row: &R) -> Value {
    let mut object = Map::new();
    for column in columns.iter().filter(|column| !column.key.is_empty()) {
        let json = (column.cell)(row).json;
        match column.key.split_once('.') {
            None => _ = object.insert(column.key.to_owned(), json),
            Some((outer, inner)) => {
                let nested = object.entry(outer).or_insert_with(|| Map::new().into());
                nested[inner] = json;
            }
        }
    }
    object.into()
}

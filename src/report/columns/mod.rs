//! Columns of tables. Each column is declared once, with its heading, JSON key, meaning and value.
//!
//! Text, JSON and `docs/columns.md` use the same lists. A new column needs one entry in a list.

use crate::verify::Interval;
use serde_json::{Map, Value, json};
use std::borrow::{Borrow, Cow};

pub(crate) mod cost;
pub(crate) mod force;
pub(crate) mod gradient;
pub(crate) mod level;
pub(crate) mod spectrum;
pub(crate) mod stability;
#[cfg(test)]
mod tests;
pub(crate) mod timed_level;

#[derive(Debug, Clone)]
pub(crate) struct Cell {
    pub(crate) text: String,
    pub(crate) json: Value,
}

impl Cell {
    pub(crate) fn new(text: impl Text, json: impl Into<Value>) -> Self {
        Self { text: text.text(), json: json.into() }
    }

    pub(crate) fn text(text: impl Text) -> Self {
        Self::new(text, Value::Null)
    }

    pub(crate) fn json(json: impl Into<Value>) -> Self {
        Self::new(None::<String>, json)
    }

    /// Creates a cell with a number, whose text is formatted by `format`.
    pub(crate) fn number(value: impl Into<Option<f64>>, format: impl Fn(f64) -> String) -> Self {
        let value = value.into();
        Self::new(value.map(format), value.map(number))
    }

    pub(crate) fn or_failed(self, failure: Option<&String>) -> Self {
        if failure.is_some() { Self { text: "failed".to_owned(), ..self } } else { self }
    }
}

/// Converts a name or a count to text, and `None` to a dash.
pub(crate) trait Text {
    fn text(self) -> String;
}

macro_rules! text {
    ($($plain:ty),+) => {$(
        impl Text for $plain {
            fn text(self) -> String {
                self.to_string()
            }
        }
    )+};
}
text!(String, &str, u64, usize);

impl<T: Text> Text for Option<T> {
    fn text(self) -> String {
        self.map_or_else(|| "-".to_owned(), Text::text)
    }
}

pub(crate) fn decimals(count: usize) -> impl Fn(f64) -> String {
    move |value| format!("{value:.count$}")
}

/// Formats an error or a length with four significant digits and a two-digit exponent.
pub(crate) fn scientific(value: f64) -> String {
    if !value.is_finite() {
        return if value.is_nan() { "nan".to_owned() } else { "inf".to_owned() };
    }
    // Adding zero prevents the text `-0`.
    two_digit_exponent(&format!("{:.3e}", value + 0.0))
}

/// Formats a number with three significant digits and a two-digit exponent.
pub(crate) fn short(value: f64) -> String {
    two_digit_exponent(&format!("{value:.2e}"))
}

fn two_digit_exponent(text: &str) -> String {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let (sign, digits) = exponent.strip_prefix('-').map_or(("+", exponent), |digits| ("-", digits));
    format!("{mantissa}e{sign}{digits:0>2}")
}

pub(crate) struct TableColumn<'a, R: ?Sized> {
    pub(crate) heading: Cow<'a, str>,
    /// Key in JSON, empty for text only. `errors.rms` is the key `rms` of the object `errors`.
    pub(crate) key: &'static str,
    pub(crate) about: &'static str,
    /// Whether text is aligned to the left, as for names; numbers are aligned to the right.
    pub(crate) flush_left: bool,
    cell: Box<dyn Fn(&R) -> Cell + 'a>,
}

impl<'a, R: ?Sized + 'a> TableColumn<'a, R> {
    pub(crate) fn new(
        heading: impl Into<Cow<'a, str>>,
        key: &'static str,
        about: &'static str,
        cell: impl Fn(&R) -> Cell + 'a,
    ) -> Self {
        Self { heading: heading.into(), key, about, flush_left: false, cell: Box::new(cell) }
    }

    /// Creates a column of names or counts, which are equal in text and JSON.
    pub(crate) fn plain<V: Text + Clone + Into<Value>>(
        heading: impl Into<Cow<'a, str>>,
        key: &'static str,
        about: &'static str,
        value: impl Fn(&R) -> V + 'a,
    ) -> Self {
        Self::new(heading, key, about, move |row| {
            let value = value(row);
            Cell::new(value.clone(), value)
        })
    }

    /// Creates a column of numbers, whose text is formatted by `format`.
    pub(crate) fn number<V: Into<Option<f64>>>(
        heading: impl Into<Cow<'a, str>>,
        key: &'static str,
        about: &'static str,
        format: impl Fn(f64) -> String + 'a,
        value: impl Fn(&R) -> V + 'a,
    ) -> Self {
        Self::new(heading, key, about, move |row| Cell::number(value(row), &format))
    }

    pub(crate) fn text<V: Text>(
        heading: impl Into<Cow<'a, str>>,
        about: &'static str,
        text: impl Fn(&R) -> V + 'a,
    ) -> Self {
        Self::new(heading, "", about, move |row| Cell::text(text(row)))
    }

    pub(crate) fn json<V: Into<Value>>(
        key: &'static str,
        about: &'static str,
        json: impl Fn(&R) -> V + 'a,
    ) -> Self {
        Self::new("", key, about, move |row| Cell::json(json(row)))
    }

    pub(crate) fn flush_left(self) -> Self {
        Self { flush_left: true, ..self }
    }

    /// Adapts the column to a table whose rows may contain an `R`. Rows without an `R` show a dash.
    pub(crate) fn within<S: 'a>(self, part: impl Fn(&S) -> Option<&R> + 'a) -> TableColumn<'a, S> {
        let Self { heading, key, about, flush_left, cell } = self;
        let cell = move |row: &S| part(row).map_or_else(|| Cell::json(Value::Null), &cell);
        TableColumn { heading, key, about, flush_left, cell: Box::new(cell) }
    }

    pub(crate) fn cell(&self, row: &R) -> Cell {
        (self.cell)(row)
    }
}

/// Adds a column with the names of the cases in front of `columns`.
pub(crate) fn with_case<'a, R: 'a, B: Borrow<R> + 'a>(
    columns: impl IntoIterator<Item = TableColumn<'a, R>>,
) -> Vec<TableColumn<'a, (&'a str, B)>> {
    let name = TableColumn::text("case", "case", |(name, _): &(&'a str, B)| *name);
    let of_row =
        columns.into_iter().map(|column| column.within(|(_, row): &(_, B)| Some(row.borrow())));
    std::iter::once(name.flush_left()).chain(of_row).collect()
}

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

pub(crate) fn json_objects<R>(
    columns: &[TableColumn<'_, R>],
    rows: impl IntoIterator<Item = impl Borrow<R>>,
) -> Value {
    rows.into_iter().map(|row| json_object(columns, row.borrow())).collect()
}

/// Returns the number, or `"nan"`, `"inf"` or `"-inf"`.
pub(crate) fn number(value: f64) -> Value {
    match value {
        v if v.is_nan() => json!("nan"),
        v if v.is_infinite() => json!(if v > 0.0 { "inf" } else { "-inf" }),
        v => json!(v),
    }
}

pub(crate) fn interval(estimate: Interval) -> Value {
    let Interval { value, low, high } = estimate;
    json!({"value": number(value), "low": number(low), "high": number(high)})
}

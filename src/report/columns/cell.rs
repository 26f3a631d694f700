//! A value of a table, in both its forms.

use crate::report::columns::number::number;
use serde_json::Value;

/// A value as text and as JSON.
#[derive(Debug, Clone)]
pub(crate) struct Cell {
    pub(crate) text: String,
    pub(crate) json: Value,
}

impl Cell {
    /// Forms that differ.
    pub(crate) fn new(text: impl Text, json: impl Into<Value>) -> Self {
        Self { text: text.text(), json: json.into() }
    }

    /// A value of text only.
    pub(crate) fn text(text: impl Text) -> Self {
        Self::new(text, Value::Null)
    }

    /// A value of JSON only.
    pub(crate) fn json(json: impl Into<Value>) -> Self {
        Self::new(None::<String>, json)
    }

    /// A name or a count, the same in both forms.
    pub(crate) fn plain(value: impl Text + Clone + Into<Value>) -> Self {
        Self::new(value.clone(), value)
    }

    /// A number, in text as `format` writes it.
    pub(crate) fn number(value: impl Into<Option<f64>>, format: impl Fn(f64) -> String) -> Self {
        let value = value.into();
        Self::new(value.map(format), value.map(number))
    }

    /// The same with the word `failed` as text, if there is a failure.
    pub(crate) fn or_failed(self, failure: Option<&String>) -> Self {
        if failure.is_some() { Self { text: "failed".to_owned(), ..self } } else { self }
    }
}

/// A name or a count as text; a dash for none.
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

/// A number with so many decimals.
pub(crate) fn decimals(count: usize) -> impl Fn(f64) -> String {
    move |value| format!("{value:.count$}")
}

/// An error or a length: four significant digits, exponent of two digits.
pub(crate) fn scientific(value: f64) -> String {
    if !value.is_finite() {
        return if value.is_nan() { "nan".to_owned() } else { "inf".to_owned() };
    }
    // No minus before a zero.
    two_digit_exponent(&format!("{:.3e}", value + 0.0))
}

/// Three significant digits, exponent of two.
pub(crate) fn short(value: f64) -> String {
    two_digit_exponent(&format!("{value:.2e}"))
}

fn two_digit_exponent(text: &str) -> String {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let (sign, digits) = exponent.strip_prefix('-').map_or(("+", exponent), |digits| ("-", digits));
    format!("{mantissa}e{sign}{digits:0>2}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case(1.23456e-5, "1.235e-05")]
    #[case(0.0, "0.000e+00")]
    #[case(-0.0, "0.000e+00")]
    #[case(-2.5e12, "-2.500e+12")]
    #[case(1e-300, "1.000e-300")]
    #[case(f64::NAN, "nan")]
    #[case(f64::INFINITY, "inf")]
    fn numbers(#[case] value: f64, #[case] text: &str) {
        assert_eq!(scientific(value), text);
    }
}

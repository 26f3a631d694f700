//! Numbers of the JSON document, in which those that are not finite are strings.

use serde::{Deserialize, Deserializer, de};
use std::fmt;

/// A number, or one of `"nan"`, `"inf"`, `"-inf"`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct JsonNumber(pub(super) f64);

impl<'de> Deserialize<'de> for JsonNumber {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(NumberVisitor).map(Self)
    }
}

struct NumberVisitor;

impl de::Visitor<'_> for NumberVisitor {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, \"nan\", \"inf\" or \"-inf\"")
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<f64, E> {
        Ok(value)
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<f64, E> {
        match word {
            "nan" => Ok(f64::NAN),
            "inf" => Ok(f64::INFINITY),
            "-inf" => Ok(f64::NEG_INFINITY),
            other => Err(E::invalid_value(de::Unexpected::Str(other), &self)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case("0.1", Some(0.1))]
    #[case("3", Some(3.0))]
    #[case("-3", Some(-3.0))]
    #[case("\"inf\"", Some(f64::INFINITY))]
    #[case("\"-inf\"", Some(f64::NEG_INFINITY))]
    #[case("\"0.1\"", None)]
    #[case("true", None)]
    #[case("null", None)]
    fn numbers(#[case] text: &str, #[case] expected: Option<f64>) {
        assert_eq!(serde_json::from_str(text).ok().map(|JsonNumber(value)| value), expected);
    }

    #[test]
    fn what_is_written_reads_back() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.1, 1e-300, -0.0] {
            let text = crate::report::columns::number::number(value).to_string();
            let JsonNumber(read) = serde_json::from_str(&text).expect("a number");
            assert_eq!(read.to_bits(), value.to_bits(), "{text}");
        }
    }
}

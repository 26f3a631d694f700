//! Numbers in JSON, which has no word for those that are not finite.

use crate::verify::Interval;
use serde_json::{Value, json};

/// The number, or one of the strings `"nan"`, `"inf"`, `"-inf"`.
pub(crate) fn number(value: f64) -> Value {
    match value {
        v if v.is_nan() => json!("nan"),
        v if v.is_infinite() => json!(if v > 0.0 { "inf" } else { "-inf" }),
        v => json!(v),
    }
}

/// An estimate with both ends of its interval.
pub(crate) fn interval(estimate: Interval) -> Value {
    let Interval { value, low, high } = estimate;
    json!({"value": number(value), "low": number(low), "high": number(high)})
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case(f64::NAN, "\"nan\"")]
    #[case(f64::INFINITY, "\"inf\"")]
    #[case(f64::NEG_INFINITY, "\"-inf\"")]
    #[case(0.1, "0.1")]
    fn numbers(#[case] value: f64, #[case] text: &str) {
        assert_eq!(number(value).to_string(), text);
    }
}

//! Formats numbers for running text.

use super::fit::Interval;

const DIGITS: usize = 4;

/// Formats a number with four significant digits: `0.4167`, `25`, `1.563e-14`.
pub fn format_number(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return format!("{}", x + 0.0);
    }
    let scientific = format!("{:.*e}", DIGITS - 1, x);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-3..DIGITS as i32).contains(&exponent) {
        let decimals = (DIGITS as i32 - 1 - exponent) as usize;
        trimmed(&format!("{x:.decimals$}")).to_owned()
    } else {
        format!("{}e{exponent}", trimmed(mantissa))
    }
}

/// Rounds a number to this number of significant digits (at least 1).
pub fn rounded(x: f64, digits: usize) -> f64 {
    format!("{x:.*e}", digits - 1).parse().unwrap_or(x)
}

/// Formats a scalar or a vector: `0.5` or `(0, 0.5)`.
pub fn tuple(components: &[impl AsRef<str>]) -> String {
    let texts: Vec<&str> = components.iter().map(AsRef::as_ref).collect();
    if let [only] = texts[..] { only.to_owned() } else { format!("({})", texts.join(", ")) }
}

/// Formats an order with its interval, such as `2.003 [1.991, 2.015]`.
pub(crate) fn order(order: &Interval) -> String {
    let Interval { value, low, high } = order;
    format!("{value:.3} [{low:.3}, {high:.3}]")
}

fn trimmed(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case(0.0, "0")]
    #[case(-0.0, "0")]
    #[case(5.0, "5")]
    #[case(25.0 / 60.0, "0.4167")]
    #[case(9.999_96, "10")]
    #[case(1234.4, "1234")]
    #[case(100.0, "100")]
    #[case(12_345.0, "1.234e4")]
    #[case(-0.001_234_5, "-0.001234")]
    #[case(3.2e-9, "3.2e-9")]
    #[case(f64::MIN_POSITIVE / 2.0, "1.113e-308")]
    #[case(f64::NAN, "NaN")]
    #[case(f64::INFINITY, "inf")]
    fn four_significant_digits(#[case] x: f64, #[case] text: &str) {
        assert_eq!(format_number(x), text);
    }
}

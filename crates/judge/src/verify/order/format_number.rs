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

    #[test]
    fn four_significant_digits() {
        let numbers = [0.0, -0.0, 5.0, 25.0 / 60.0, 9.999_96, 1234.4, 100.0];
        assert_eq!(numbers.map(format_number), ["0", "0", "5", "0.4167", "10", "1234", "100"]);
        let numbers = [12_345.0, -0.001_234_5, 3.2e-9, f64::MIN_POSITIVE / 2.0];
        let texts = ["1.234e4", "-0.001234", "3.2e-9", "1.113e-308"];
        assert_eq!(numbers.map(format_number), texts);
        assert_eq!([f64::NAN, f64::INFINITY].map(format_number), ["NaN", "inf"]);
    }
}

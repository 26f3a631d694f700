//! Detects drift of a report: compares two texts number by number.
//!
//! Text and counters must be equal. Decimal numbers may differ by [`RELATIVE`] or by one unit in
//! the last printed digit, because the last bits differ between platforms. A number that is not
//! finite equals nothing, not even itself.

/// Maximum relative difference between decimal numbers that count as equal.
pub const RELATIVE: f64 = 1e-3;

/// Whether the texts are equal within the tolerances. Several spaces count as one, because a column
/// may become wider.
pub fn same(old: &str, new: &str) -> bool {
    let (old, new) = (old.trim_end(), new.trim_end());
    old.lines().count() == new.lines().count()
        && old.lines().zip(new.lines()).all(|(old, new)| {
            let (old, new) = (tokens(old), tokens(new));
            old.len() == new.len() && old.iter().zip(&new).all(|(old, new)| same_token(old, new))
        })
}

/// Whether a report equals its stored snapshot, which begins with a header of `insta`.
pub fn same_as_snapshot(snapshot: &str, report: &str) -> bool {
    same(contents(snapshot), report)
}

/// Returns a snapshot without its header.
pub fn contents(snapshot: &str) -> &str {
    snapshot.splitn(3, "---\n").last().unwrap_or_default()
}

fn same_token(old: &str, new: &str) -> bool {
    if matches!(old, "nan" | "inf") {
        return false;
    }
    match (number(old), number(new)) {
        (Some(a), Some(b)) if is_decimal(old) && is_decimal(new) => {
            let allowed = f64::max(RELATIVE * a.abs(), 1.000_001 * last_place(old));
            (a - b).abs() <= allowed
        }
        _ => old == new,
    }
}

/// Splits a line into numbers and the texts between them.
fn tokens(line: &str) -> Vec<&str> {
    let edge = |c: char| c.is_whitespace() || "[](),;:=".contains(c);
    let mut tokens = Vec::new();
    for word in line.split(char::is_whitespace) {
        let mut rest = word;
        while !rest.is_empty() {
            let end = rest.find(edge).unwrap_or(rest.len()).max(1);
            let (token, tail) = rest.split_at(end);
            tokens.push(token);
            rest = tail;
        }
    }
    tokens
}

fn number(token: &str) -> Option<f64> {
    let digits = token.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '.');
    token.parse::<f64>().ok().filter(|value| digits && value.is_finite())
}

fn is_decimal(token: &str) -> bool {
    token.contains(['.', 'e'])
}

/// Returns one unit in the last printed digit: 0.01 for `1.99`, 1e-8 for `1.235e-05`. The unit of a
/// zero in scientific notation is 0, because any other number would be printed differently.
fn last_place(token: &str) -> f64 {
    if token.contains('e') && number(token) == Some(0.0) {
        return 0.0;
    }
    let (mantissa, exponent) = token.split_once('e').unwrap_or((token, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let exponent: i32 = exponent.parse().unwrap_or(0);
    libm::pow(10.0, f64::from(exponent) - decimals as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case::same("rms 1.235e-05  order 1.99", "rms 1.235e-05  order 1.99", true)]
    #[case::last_place("1.235e-05", "1.236e-05", true)]
    #[case::two_units_of_the_last_place("1.99", "2.01", false)]
    #[case::within_a_thousandth("-2.00000e+06", "-2.00199e+06", true)]
    #[case::beyond_a_thousandth("-2.00000e+06", "-2.00201e+06", false)]
    #[case::small_is_not_zero("3.200e-09", "3.200e-07", false)]
    #[case::zero_is_exact("0.000e+00", "3.200e-09", false)]
    #[case::order_in_its_last_place("1.99 [1.95, 2.03]", "2.00 [1.95, 2.03]", true)]
    #[case::order("1.99 [1.95, 2.03]", "1.89 [1.95, 2.03]", false)]
    #[case::counter("transfers 300000", "transfers 300001", false)]
    #[case::word("converging", "divergent", false)]
    #[case::nan_equals_nothing("rms nan", "rms nan", false)]
    #[case::inf_equals_nothing("rms inf", "rms inf", false)]
    #[case::wider_column("a  1.0", "a 1.0", true)]
    #[case::sign("order -1.35", "order 1.35", false)]
    #[case::line_lost("a\nb", "a", false)]
    #[case::number_became_word("1.5", "-", false)]
    fn comparisons(#[case] old: &str, #[case] new: &str, #[case] equal: bool) {
        assert_eq!(same(old, new), equal);
    }
}

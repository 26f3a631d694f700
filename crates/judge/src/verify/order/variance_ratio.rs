//! The regularised incomplete beta function at half-integers: the p-value of an F-test.
//!
//! A model with `d` more parameters has the residual sum of squares `rss_fine` with `nu` degrees of
//! freedom; the simpler model has `rss_coarse`. If the simpler model holds,
//! `x = rss_fine / rss_coarse` has the distribution `I_x(nu/2, d/2)`, and a small `x` is evidence
//! against it. `I_x` is computed from closed forms by the recurrences DLMF 8.17.20 and 8.17.21,
//!
//! ```text
//! I_x(a+1, b) = I_x(a, b) - x^a (1-x)^b / (a B(a,b))
//! I_x(a, b+1) = I_x(a, b) + x^a (1-x)^b / (b B(a,b))
//! ```

use std::f64::consts::{FRAC_2_PI, PI};

/// Computes `I_x(nu/2, d/2)` for integers `nu, d >= 1` and `x` in `[0, 1]`; NaN if `x` is NaN. The
/// absolute error is a few units of round-off.
pub(crate) fn regularised(x: f64, nu: usize, d: usize) -> f64 {
    let (mut a, mut b) = (start(nu), start(d));
    let mut beta = complete(nu, d);
    let mut value = base(x, nu, d);
    let kernel = |a: f64, b: f64| libm::pow(x, a) * libm::pow(1.0 - x, b);
    while a < 0.5 * nu as f64 {
        value -= kernel(a, b) / (a * beta);
        beta *= a / (a + b);
        a += 1.0;
    }
    while b < 0.5 * d as f64 {
        value += kernel(a, b) / (b * beta);
        beta *= b / (a + b);
        b += 1.0;
    }
    value
}

/// Returns the smallest positive number that differs from `n/2` by an integer.
fn start(n: usize) -> f64 {
    if n.is_multiple_of(2) { 1.0 } else { 0.5 }
}

/// Computes `B(start(nu), start(d))`.
fn complete(nu: usize, d: usize) -> f64 {
    match (nu % 2, d % 2) {
        (0, 0) => 1.0,
        (1, 1) => PI,
        _ => 2.0,
    }
}

/// Computes `I_x(start(nu), start(d))`.
fn base(x: f64, nu: usize, d: usize) -> f64 {
    match (nu % 2, d % 2) {
        (0, 0) => x,
        (1, 1) => FRAC_2_PI * libm::asin(x.sqrt()),
        (0, _) => 1.0 - (1.0 - x).sqrt(),
        _ => x.sqrt(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;
    use rstest::rstest;

    /// Published 1 % points of the F distribution, `x = nu / (nu + d F)`.
    #[rstest]
    #[case(1, 2, 98.503)]
    #[case(1, 5, 16.258)]
    #[case(2, 4, 18.000)]
    #[case(3, 3, 29.457)]
    #[case(4, 2, 99.249)]
    #[case(4, 6, 9.148)]
    #[case(5, 5, 10.967)]
    fn published_f_values(#[case] d: usize, #[case] nu: usize, #[case] f: f64) {
        let x = nu as f64 / (nu as f64 + d as f64 * f);
        assert_abs_diff_eq!(regularised(x, nu, d), 0.01, epsilon = 2e-6);
    }

    #[test]
    fn ends_of_the_range() {
        for (nu, d) in [(1, 1), (2, 3), (5, 4), (6, 2), (7, 7)] {
            assert_abs_diff_eq!(regularised(0.0, nu, d), 0.0);
            assert_abs_diff_eq!(regularised(1.0, nu, d), 1.0, epsilon = 1e-14);
            assert!(regularised(f64::NAN, nu, d).is_nan());
        }
    }
}

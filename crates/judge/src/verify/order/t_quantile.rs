//! The quantile of Student's t for a 95 % confidence interval.
//!
//! `A(t|nu)` is the probability that a variable with `nu` degrees of freedom lies in `[-t, t]`.
//! With `theta = atan(t / sqrt(nu))` it is (Abramowitz & Stegun 1964, 26.7.3 and 26.7.4)
//!
//! ```text
//! nu odd:   2/pi (theta + sin theta (cos theta + 2/3 cos^3 theta + ...
//!                 + (2 4 ... (nu-3)) / (3 5 ... (nu-2)) cos^(nu-2) theta))
//! nu even:  sin theta (1 + 1/2 cos^2 theta + ...
//!                 + (1 3 ... (nu-3)) / (2 4 ... (nu-2)) cos^(nu-2) theta)
//! ```
//!
//! The sum has finitely many terms. `A(t|nu)` is inverted by bisection in `theta`.

use crate::exact::bisection::bisect;
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

/// The probability that a confidence interval contains the true value.
pub(crate) const CONFIDENCE: f64 = 0.95;

/// Returns the `t` with `A(t|nu) = 0.95`; NaN for `nu = 0`, which has no distribution.
pub fn two_sided_95(degrees_of_freedom: usize) -> f64 {
    if degrees_of_freedom == 0 {
        return f64::NAN;
    }
    let reaches = |theta: f64| !(probability_within(theta, degrees_of_freedom) < CONFIDENCE);
    (degrees_of_freedom as f64).sqrt() * libm::tan(bisect(0.0, FRAC_PI_2, reaches))
}

/// Computes `A(t|nu)` as a function of `theta`.
fn probability_within(theta: f64, nu: usize) -> f64 {
    let (sin, cos) = libm::sincos(theta);
    if nu.is_multiple_of(2) {
        sin * cosine_sum(1.0, 2, cos, nu)
    } else if nu == 1 {
        FRAC_2_PI * theta
    } else {
        FRAC_2_PI * (theta + sin * cosine_sum(cos, 3, cos, nu))
    }
}

/// Returns the sum in brackets, from the term `first` to the term in `cos^(nu-2)`. Each term is the
/// previous one times `cos^2 (k-1)/k`, with `k` in steps of two from `second` to `nu - 2`.
fn cosine_sum(first: f64, second: usize, cos: f64, nu: usize) -> f64 {
    let mut term = first;
    let mut sum = first;
    for k in (second..=nu - 2).step_by(2) {
        term *= cos * cos * (k - 1) as f64 / k as f64;
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    /// Published tables, to their printed digits.
    #[test]
    fn published_values() {
        let quantiles = [3.18245, 2.77645, 2.57058, 2.22814, 2.04227, 1.97993];
        for (nu, t) in [3, 4, 5, 10, 30, 120].into_iter().zip(quantiles) {
            assert_abs_diff_eq!(two_sided_95(nu), t, epsilon = 5e-6);
        }
    }

    /// `tan(0.95 pi/2)` for one degree of freedom, `0.95 sqrt(2 / (1 - 0.95^2))` for two.
    #[test]
    fn closed_forms() {
        let one = libm::tan(0.95 * FRAC_PI_2);
        assert_abs_diff_eq!(two_sided_95(1), one, epsilon = 1e-12);
        let two = 0.95 * (2.0 / (1.0 - 0.95 * 0.95_f64)).sqrt();
        assert_abs_diff_eq!(two_sided_95(2), two, epsilon = 1e-12);
    }

    #[test]
    fn quantile_tends_to_normal_and_is_nan_for_zero() {
        assert_abs_diff_eq!(two_sided_95(100_000), 1.959_964, epsilon = 5e-5);
        assert!(two_sided_95(0).is_nan());
    }
}

//! Richardson extrapolation from three values.
//!
//! If `u(h) = u0 + C h^p`, then spacings `h3 > h2 > h1` with `h3 = r32 h2`, `h2 = r21 h1` give
//!
//! ```text
//! ratio = (u2 - u3) / (u1 - u2) = (r32^p - 1) / (1 - r21^-p)        = 2^p for halvings
//! u0    = u1 + (u1 - u2) / (r21^p - 1)
//! ```
//!
//! (Roache 1994, 1998; unequal ratios as in Celik et al. 2008.) Only monotonically converging
//! values have an order `p`: their changes have one sign and shrink as a positive order requires.
//!
//! Three values always fit, so they give no interval; an interval requires a fourth value
//! (`limit_estimate`). The index `1.25 |(u1 - u2) / u1| / (r21^p - 1)` of Roache (1994) is not
//! offered, because it contains the true error of only 73 of 100 series of the suites. The
//! "asymptotic range ratio" `GCI_32 / (r^p GCI_21)` is not offered either: it is identically
//! `u1 / u2`, which is close to 1 even if the values do not converge.

use crate::exact::bisection::bisect;

/// Convergence of three values at one point and time, and their limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Richardson {
    /// `(u2 - u3) / (u1 - u2)`, the coarse change divided by the fine one; `2^p` for halvings.
    pub ratio: f64,
    /// Observed order, for monotone convergence only.
    pub order: Option<f64>,
    /// Extrapolated value, for monotone convergence only.
    pub extrapolated: Option<f64>,
}

impl Richardson {
    /// Extrapolates three values with their spacings, coarse to fine.
    pub fn new(h: [f64; 3], values: [f64; 3]) -> Self {
        let [coarse, medium, fine] = values;
        let change = fine - medium;
        let ratio = (medium - coarse) / change;
        let rates = [h[0] / h[1], h[1] / h[2]].map(libm::log);
        let are_refined = rates.iter().all(|rate| rate.is_finite() && *rate > 0.0);
        let are_finite = [medium - coarse, change, ratio].iter().all(|number| number.is_finite());
        // The ratio for order zero separates convergence from divergence.
        let converges = are_refined && are_finite && ratio > rates[0] / rates[1];
        let order = converges.then(|| solve(ratio, rates));
        let correction = order.map(|p| change / libm::expm1(p * rates[1]));
        Self { ratio, order, extrapolated: correction.map(|c| fine + c) }
    }
}

/// Solves `(r32^p - 1) / (1 - r21^-p) = ratio` by bisection. The left side increases with `p`.
fn solve(ratio: f64, [coarse, fine]: [f64; 2]) -> f64 {
    let reaches = |p: f64| -libm::expm1(p * coarse) / libm::expm1(-p * fine) >= ratio;
    let mut high = 1.0;
    while !reaches(high) {
        high *= 2.0;
    }
    bisect(0.0, high, reaches)
}

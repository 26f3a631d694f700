//! Richardson extrapolation from three values.
//!
//! If `u(h) = u0 + C h^p`, then for spacings `h3 > h2 > h1` with `h3 = r32 h2`, `h2 = r21 h1`
//!
//! ```text
//! ratio = (u2 - u3) / (u1 - u2) = (r32^p - 1) / (1 - r21^-p)        = 2^p for halvings
//! u0    = u1 + (u1 - u2) / (r21^p - 1)
//! ```
//!
//! (Roache 1994, 1998; unequal ratios as in Celik et al. 2008.) The classes are those of Eca &
//! Hoekstra (2014). The order is the solution `p` only if the values converge monotonically: the
//! logarithm of an absolute value would assign an order to oscillation and divergence.
//!
//! Three values always fit, so they have no interval: `limit_estimate` compares two triples. The
//! grid convergence index `1.25 |(u1 - u2) / u1| / (r21^p - 1)` (Roache 1994) is not offered: over
//! the suites with exact solutions it contains the true error of 73 of 100 series. Nor is the
//! "asymptotic range ratio" `GCI_32 / (r^p GCI_21)`: with the order fitted to the same three values
//! it is identically `u1 / u2`, close to 1 for any values.

use std::fmt;

/// Behaviour of three values under refinement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RichardsonClass {
    /// The change shrinks and has a constant sign, as for a positive order.
    MonotoneConvergent,
    /// The change shrinks and alternates.
    OscillatoryConvergent,
    /// The change has a constant sign, but does not shrink as for a positive order.
    MonotoneDivergent,
    /// The change alternates and does not shrink.
    OscillatoryDivergent,
    /// All three values are the same.
    Exact,
    /// One of the two changes is zero: the ratio is undefined.
    Degenerate,
    /// A figure is not finite, or the spacings do not shrink.
    Failed,
}

impl fmt::Display for RichardsonClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::MonotoneConvergent => "monotone convergent",
            Self::OscillatoryConvergent => "oscillatory convergent",
            Self::MonotoneDivergent => "monotone divergent",
            Self::OscillatoryDivergent => "oscillatory divergent",
            Self::Exact => "exact",
            Self::Degenerate => "degenerate",
            Self::Failed => "failed",
        })
    }
}

/// Convergence of three values at the same place and time, and their limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Richardson {
    /// `(u2 - u3) / (u1 - u2)`, the coarse change over the fine one; `2^p` for halvings.
    pub ratio: f64,
    /// Behaviour of the values.
    pub class: RichardsonClass,
    /// The observed order, only if monotone convergent.
    pub order: Option<f64>,
    /// The extrapolated value, only if monotone convergent.
    pub extrapolated: Option<f64>,
}

impl Richardson {
    /// From three values, coarse to fine, whose spacing shrinks by the same `ratio > 1` twice.
    pub fn equal_ratio(values: [f64; 3], ratio: f64) -> Self {
        Self::new([ratio * ratio, ratio, 1.0], values)
    }

    /// From three values and their spacings, coarse to fine.
    pub fn new(h: [f64; 3], values: [f64; 3]) -> Self {
        let [coarse, medium, fine] = values;
        let change = fine - medium;
        let ratio = (medium - coarse) / change;
        let rates = [h[0] / h[1], h[1] / h[2]].map(libm::log);
        let class = classify([medium - coarse, change], ratio, rates);
        let order = (class == RichardsonClass::MonotoneConvergent).then(|| solve(ratio, rates));
        let correction = order.map(|p| change / libm::expm1(p * rates[1]));
        Self { ratio, class, order, extrapolated: correction.map(|c| fine + c) }
    }
}

/// The limit of the ratio for an order of zero, `ln r32 / ln r21`, separates convergence from
/// divergence; it is one for equal ratios of spacing.
fn classify(changes: [f64; 2], ratio: f64, rates: [f64; 2]) -> RichardsonClass {
    let shrinks = rates.iter().all(|rate| rate.is_finite() && *rate > 0.0);
    if !(shrinks && changes.iter().all(|change| change.is_finite())) {
        return RichardsonClass::Failed;
    }
    match changes.map(|change| change == 0.0) {
        [true, true] => return RichardsonClass::Exact,
        [false, false] if ratio.is_finite() && ratio != 0.0 => {}
        _ => return RichardsonClass::Degenerate,
    }
    match (ratio > 0.0, ratio.abs() > rates[0] / rates[1]) {
        (true, true) => RichardsonClass::MonotoneConvergent,
        (false, true) => RichardsonClass::OscillatoryConvergent,
        (true, false) => RichardsonClass::MonotoneDivergent,
        (false, false) => RichardsonClass::OscillatoryDivergent,
    }
}

/// Solves `(r32^p - 1) / (1 - r21^-p) = ratio` by bisection; the left side is increasing in `p`.
fn solve(ratio: f64, [coarse, fine]: [f64; 2]) -> f64 {
    let reaches = |p: f64| -libm::expm1(p * coarse) / libm::expm1(-p * fine) >= ratio;
    let mut high = 1.0;
    while !reaches(high) {
        high *= 2.0;
    }
    let mut low = 0.0;
    loop {
        let middle = 0.5 * (low + high);
        if !(low < middle && middle < high) {
            return middle;
        }
        if reaches(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
}

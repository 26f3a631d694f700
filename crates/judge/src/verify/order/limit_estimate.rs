//! Estimates the limit of a series under refinement, with an interval and without exact solution.
//!
//! The four finest levels `h4 > h3 > h2 > h1` form two triples. Richardson extrapolation
//! ([`Richardson`]) yields an order and a limit for each: `p`, `u0` for the finest triple, and `q`,
//! `w0` for the next coarser one. With `delta = u0 - u1` and `r = h2 / h1`, the estimate is
//!
//! ```text
//! order = p -+ 3 |p - q|
//! limit = u0 -+ max(|delta|, 3 max(1, 1/(r^p - 1)) |u0 - w0|)
//! ```
//!
//! `docs/estimate.md` gives the reasons for the terms, their sources (Roache 1994, 1998; Eca &
//! Hoekstra 2014, J. Comput. Phys. 262, 104) and the measured coverage of the interval. Series that
//! Eca & Hoekstra classify as oscillating or divergent give no estimate here.

use crate::verify::{Interval, Richardson};
use serde::Serialize;
use thiserror::Error;

/// Number of levels in an estimate. The finest levels are used.
pub const LEVELS_OF_ESTIMATE: usize = 4;

/// Factor on the difference between two extrapolations, and between two orders.
const SAFETY_FACTOR: f64 = 3.0;

/// Maximum difference between the orders of the two triples.
const ORDER_SCATTER: f64 = 1.0;

/// Minimum order of a triple. At lower orders, the distance of the extrapolated from the finest
/// value is more than twice the last change.
const LEAST_ORDER: f64 = 0.5;

/// Maximum order of a triple, above the order of any method of this crate.
const LARGEST_ORDER: f64 = 4.5;

/// Minimum last change, in units of the rounding error of a value. Rounding then changes the ratio
/// of changes by at most an eighth.
const LEAST_CHANGE: f64 = 16.0;

/// Relative rounding error of a computed value, which is a sum of several terms.
const COMPUTED_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A value of a series under refinement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeriesPoint {
    /// Spacing on the refined axis, in any unit.
    pub h: f64,
    /// The value.
    pub value: f64,
    /// Distance between neighbouring numbers in the output with the value; 0 for double precision.
    pub resolution: f64,
}

/// Order and limit of a series of values.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LimitEstimate {
    /// Order of the finest three values. The width of the interval depends on the difference from
    /// the order of the next coarser triple.
    pub order: Interval,
    /// Extrapolated value, with an interval of nominally 95 %.
    pub limit: Interval,
    /// Value on the finest level.
    pub finest: f64,
}

impl LimitEstimate {
    /// Whether the interval of the limit contains `value`; false if `value` is NaN.
    pub fn covers(&self, value: f64) -> bool {
        self.limit.low <= value && value <= self.limit.high
    }
}

/// Reason why a series has no estimate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Error)]
#[serde(tag = "reason", rename_all = "snake_case")]
pub enum EstimateRefusal {
    /// Fewer than four levels.
    #[error("too few levels: {levels}, expected {LEVELS_OF_ESTIMATE} or more")]
    TooFewLevels {
        /// Number of levels.
        levels: usize,
    },
    /// A number is not finite, or two levels have the same spacing.
    #[error("unusable values: spacings must be positive and different, values finite")]
    Unusable,
    /// The last change is within the rounding errors of the values.
    #[error(
        "rounding: the last change, {change:.1e}, is below {LEAST_CHANGE} times the rounding of \
         the values, {rounding:.1e}"
    )]
    Rounding {
        /// Size of the last change.
        change: f64,
        /// Rounding error of the values.
        rounding: f64,
    },
    /// The changes alternate in sign.
    #[error("oscillation: the changes between the finest levels alternate in sign")]
    Oscillation,
    /// The changes do not shrink under refinement.
    #[error("no asymptotic range: the changes between the finest levels do not shrink")]
    Divergence,
    /// The orders of the two triples differ too much.
    #[error(
        "no asymptotic range: the orders of the two finest triples, {coarse:.2} and {fine:.2}, \
         differ by more than {ORDER_SCATTER}"
    )]
    OrderScatter {
        /// Order of the coarser triple.
        coarse: f64,
        /// Order of the finest triple.
        fine: f64,
    },
    /// The order of a triple is not plausible for a numerical method.
    #[error(
        "no asymptotic range: the order {order:.2} of three levels is outside [{LEAST_ORDER}, \
         {LARGEST_ORDER}]"
    )]
    OrderOutOfRange {
        /// The order.
        order: f64,
    },
}

impl EstimateRefusal {
    /// Returns the reason in two or three words, for tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::TooFewLevels { .. } => "too few levels",
            Self::Unusable => "unusable values",
            Self::Rounding { .. } => "rounding",
            Self::Oscillation => "oscillation",
            Self::Divergence | Self::OrderScatter { .. } | Self::OrderOutOfRange { .. } => {
                "no asymptotic range"
            }
        }
    }
}

/// Estimates the limit of a series of values. The levels may be in any order.
///
/// # Errors
/// Reason why the series gives no limit.
pub fn estimate_limit(series: &[SeriesPoint]) -> Result<LimitEstimate, EstimateRefusal> {
    let mut sorted = series.to_vec();
    sorted.sort_by(|a, b| b.h.total_cmp(&a.h));
    let usable = |point: &SeriesPoint| point.h > 0.0 && point.value.is_finite();
    let distinct = sorted.windows(2).all(|pair| pair[0].h > pair[1].h);
    if !(sorted.iter().all(usable) && distinct && sorted.iter().all(|point| point.h.is_finite())) {
        return Err(EstimateRefusal::Unusable);
    }
    let Some((_, finest)) = sorted.split_last_chunk::<LEVELS_OF_ESTIMATE>() else {
        return Err(EstimateRefusal::TooFewLevels { levels: series.len() });
    };
    of_four(finest)
}

fn of_four(levels: &[SeriesPoint; LEVELS_OF_ESTIMATE]) -> Result<LimitEstimate, EstimateRefusal> {
    let [_, _, medium, fine] = *levels;
    let change = (fine.value - medium.value).abs();
    let rounding = levels.iter().fold(0.0_f64, |all, point| {
        all.max(point.resolution).max(COMPUTED_ROUNDING * point.value.abs())
    });
    if !(change > LEAST_CHANGE * rounding) {
        return Err(EstimateRefusal::Rounding { change, rounding });
    }
    let triple = |k: usize| {
        let part = [levels[k], levels[k + 1], levels[k + 2]];
        Richardson::new(part.map(|point| point.h), part.map(|point| point.value))
    };
    let triples = [triple(0), triple(1)];
    if triples.iter().any(|triple| triple.ratio < 0.0) {
        return Err(EstimateRefusal::Oscillation);
    }
    let parts = triples.map(|triple| triple.order.zip(triple.extrapolated));
    let [Some((coarse_order, coarse_limit)), Some((order, limit))] = parts else {
        return Err(EstimateRefusal::Divergence);
    };
    let scatter = (order - coarse_order).abs();
    if !(scatter <= ORDER_SCATTER) {
        return Err(EstimateRefusal::OrderScatter { coarse: coarse_order, fine: order });
    }
    let in_range = |order: &f64| (LEAST_ORDER..=LARGEST_ORDER).contains(order);
    if let Some(order) = [coarse_order, order].into_iter().find(|order| !in_range(order)) {
        return Err(EstimateRefusal::OrderOutOfRange { order });
    }
    let reduction = libm::pow(medium.h / fine.h, order) - 1.0;
    let difference = (limit - coarse_limit).abs() * (1.0 / reduction).max(1.0);
    let correction = (limit - fine.value).abs();
    Ok(LimitEstimate {
        order: around(order, SAFETY_FACTOR * scatter),
        limit: around(limit, correction.max(SAFETY_FACTOR * difference)),
        finest: fine.value,
    })
}

fn around(value: f64, half_width: f64) -> Interval {
    Interval { value, low: value - half_width, high: value + half_width }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rstest::rstest;

    fn series(points: &[(f64, f64)]) -> Vec<SeriesPoint> {
        points.iter().map(|&(h, value)| SeriesPoint { h, value, resolution: 0.0 }).collect()
    }

    fn halvings(values: &[f64]) -> Vec<SeriesPoint> {
        let points: Vec<(f64, f64)> =
            values.iter().enumerate().map(|(k, value)| (libm::exp2(-(k as f64)), *value)).collect();
        series(&points)
    }

    /// For `3 + 2 h^p` the orders of the triples agree, and the interval ends at the finest value.
    #[rstest]
    fn a_power_of_h_gives_its_limit(
        #[values(0.51, 1.0, 2.0, 4.49)] order: f64,
        #[values([8.0, 4.0, 2.0, 1.0], [7.0, 5.0, 2.5, 2.0])] h: [f64; 4],
    ) {
        let value = |h: f64| 3.0 + 2.0 * libm::pow(h / 8.0, order);
        let estimate = estimate_limit(&series(&h.map(|h| (h, value(h))))).unwrap();
        assert_relative_eq!(estimate.order.value, order, max_relative = 1e-7);
        assert_relative_eq!(estimate.limit.value, 3.0, max_relative = 1e-7);
        let finest = value(h[3]);
        assert_relative_eq!(estimate.limit.half_width(), finest - 3.0, max_relative = 1e-6);
        assert_eq!(estimate.finest, finest);
    }

    /// By hand for 1 + h + h^2 at h = 1, 1/2, 1/4, 1/8: the changes are 5/4, 7/16 and 11/64, their
    /// ratios 20/7 and 28/11, and the limits 7/4 - (7/16)/(13/7) and 73/64 - (11/64)/(17/11).
    #[test]
    fn the_interval_by_hand() {
        let estimate = estimate_limit(&halvings(&[3.0, 1.75, 1.3125, 1.140_625])).unwrap();
        let coarse = 1.3125 - 0.4375 / (13.0 / 7.0);
        let fine = 1.140_625 - 0.171_875 / (17.0 / 11.0);
        assert_relative_eq!(estimate.limit.value, fine, max_relative = 1e-12);
        let half_width = (fine - 1.140_625).abs().max(3.0 * (fine - coarse).abs());
        assert_relative_eq!(estimate.limit.half_width(), half_width, max_relative = 1e-12);
        let orders = [20.0 / 7.0, 28.0 / 11.0].map(libm::log2);
        assert_relative_eq!(estimate.order.value, orders[1], max_relative = 1e-12);
        assert_relative_eq!(
            estimate.order.half_width(),
            3.0 * (orders[0] - orders[1]),
            max_relative = 1e-9
        );
        assert!(estimate.covers(1.0) && !estimate.covers(0.85) && !estimate.covers(f64::NAN));
    }

    /// Refinement by less than 2 leaves more of the second error term, so the interval is wider.
    #[test]
    fn the_interval_grows_for_small_ratios_of_spacing() {
        let value = |h: f64| 1.0 + h + h * h;
        let h = [1.25_f64.powi(3), 1.25_f64.powi(2), 1.25, 1.0];
        let estimate = estimate_limit(&series(&h.map(|h| (h, value(h))))).unwrap();
        let triple = |h: [f64; 3]| Richardson::new(h, h.map(value));
        let [coarse, fine] = [triple([h[0], h[1], h[2]]), triple([h[1], h[2], h[3]])];
        let reduction = libm::pow(1.25, fine.order.unwrap()) - 1.0;
        assert!(reduction < 1.0);
        let difference = (fine.extrapolated.unwrap() - coarse.extrapolated.unwrap()).abs();
        assert_relative_eq!(
            estimate.limit.half_width(),
            (3.0 * difference / reduction).max((value(1.0) - fine.extrapolated.unwrap()).abs()),
            max_relative = 1e-9
        );
    }

    #[test]
    fn only_the_finest_four_levels_count_in_any_order() {
        let mut points = halvings(&[-70.0, 17.0, 5.0, 2.0, 1.25, 1.0625]);
        points.reverse();
        points.swap(1, 4);
        let estimate = estimate_limit(&points).unwrap();
        assert_eq!(
            estimate,
            estimate_limit(&halvings(&[-70.0, 17.0, 5.0, 2.0, 1.25, 1.0625])).unwrap()
        );
        assert_relative_eq!(estimate.limit.value, 1.0, max_relative = 1e-12);
    }

    /// The ratios of successive changes are 2^p. The orders of the triples are 3.22 and 1.58.
    #[rstest]
    #[case::few(&[4.0, 2.0, 1.5], "too few levels: 3, expected 4 or more")]
    #[case::nan(&[4.0, 2.0, f64::NAN, 1.5], "unusable values: spacings must be positive and different, values finite")]
    #[case::constant(&[1.0, 1.0, 1.0, 1.0], "rounding: the last change, 0.0e0, is below 16 times the rounding of the values, 8.9e-16")]
    #[case::converged(&[-1.5e6, -1.25e6, -1.125e6, -1.125e6 - 1e-9], "rounding: the last change, 9.3e-10, is below 16 times the rounding of the values, 1.3e-9")]
    #[case::fine_oscillation(&[3.0, 1.0, 2.0, 1.5], "oscillation: the changes between the finest levels alternate in sign")]
    #[case::coarse_oscillation(&[1.0, 2.0, 1.5, 1.4], "oscillation: the changes between the finest levels alternate in sign")]
    #[case::growing(&[1.0, 2.0, 4.0, 8.0], "no asymptotic range: the changes between the finest levels do not shrink")]
    #[case::scatter(&[64.0, 8.0, 2.0, 0.0], "no asymptotic range: the orders of the two finest triples, 3.22 and 1.58, differ by more than 1")]
    #[case::slow(&halved(0.49), "no asymptotic range: the order 0.49 of three levels is outside [0.5, 4.5]")]
    #[case::fast(&halved(4.51), "no asymptotic range: the order 4.51 of three levels is outside [0.5, 4.5]")]
    fn a_series_without_a_limit_is_refused(#[case] values: &[f64], #[case] reason: &str) {
        let refusal = estimate_limit(&halvings(values)).unwrap_err().to_string();
        assert_eq!(refusal, reason);
    }

    /// Returns `2^-kp`, values of order p at halved spacings.
    fn halved(p: f64) -> [f64; 4] {
        [0.0, 1.0, 2.0, 3.0].map(|k| libm::exp2(-k * p))
    }

    /// Changes of 8, 2 2^(1-s) and 1 have the orders 1 + s and 2 - s, which differ by 1 - 2 s.
    #[rstest]
    #[case::less_than_one(0.01, true)]
    #[case::more_than_one(-0.01, false)]
    fn orders_of_the_triples_may_differ_by_one(#[case] s: f64, #[case] is_accepted: bool) {
        let change = libm::exp2(2.0 - s);
        let values = [9.0 + change, 1.0 + change, 1.0, 0.0];
        assert_eq!(estimate_limit(&halvings(&values)).is_ok(), is_accepted);
    }

    #[rstest]
    #[case::equal(&[(1.0, 4.0), (1.0, 2.0), (0.5, 1.0), (0.25, 0.5)])]
    #[case::zero(&[(1.0, 4.0), (0.5, 2.0), (0.25, 1.0), (0.0, 0.5)])]
    #[case::infinite(&[(f64::INFINITY, 4.0), (0.5, 2.0), (0.25, 1.0), (0.1, 0.5)])]
    fn spacings_must_be_positive_and_different(#[case] points: &[(f64, f64)]) {
        assert_eq!(estimate_limit(&series(points)), Err(EstimateRefusal::Unusable));
    }

    /// The last change, 0.03, must exceed 16 units in the last printed digit.
    #[test]
    fn values_with_few_digits_are_refused() {
        let mut points = halvings(&[1.64, 1.16, 1.04, 1.01]);
        points[0].resolution = 0.001_8;
        assert!(estimate_limit(&points).is_ok());
        points[0].resolution = 0.001_9;
        let refusal = estimate_limit(&points).unwrap_err();
        assert!(
            matches!(refusal, EstimateRefusal::Rounding { rounding: 0.001_9, .. }),
            "{refusal}"
        );
    }

    #[test]
    fn units_do_not_change_the_estimate() {
        let points = halvings(&[3.0, 1.75, 1.3125, 1.140_625]);
        let scaled: Vec<SeriesPoint> = points
            .iter()
            .map(|point| SeriesPoint { h: 1e-6 * point.h, value: 1e6 * point.value, ..*point })
            .collect();
        let [one, other] = [points, scaled].map(|points| estimate_limit(&points).unwrap());
        assert_relative_eq!(other.order.high, one.order.high, max_relative = 1e-9);
        assert_relative_eq!(other.limit.low, 1e6 * one.limit.low, max_relative = 1e-9);
    }
}

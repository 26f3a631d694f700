//! Selects the window: the asymptotic levels, to which an order is fitted.
//!
//! All usable levels count unless there is strong evidence against the coarsest or finest ones. A
//! shorter window replaces a longer one only if three conditions hold:
//!
//! - An F-test (Chow 1960, the test for predictive failure) rejects that the dropped levels lie on
//!   the line through the remaining ones. The risk of a wrong rejection is [`SELECTION_RISK`] for
//!   all shorter windows together, small compared with the 5 % of the confidence interval.
//! - The dropped levels depart systematically: all depart by more than [`MATERIAL`] to the same
//!   side, and the outermost level departs most. An outlier among good levels is therefore kept,
//!   and widens the interval.
//! - Levels are dropped at the fine end only if the error stops decreasing (a floor). The verdict
//!   is then `at floor`.
//!
//! Of all such windows the longest is selected; of two equally long ones, the finer. The test is
//! repeated on the selected window until no shorter one replaces it.

use super::fit::{FittedLine, LogPoint};
use super::variance_ratio;
use std::ops::Range;

/// Minimum number of levels for an order; the interval then has two degrees of freedom.
pub const FEWEST_LEVELS: usize = 4;

/// Probability that noise shortens the window in one step: a tenth of the interval's 5 %.
const SELECTION_RISK: f64 = 0.005;

/// Minimum departure, in `ln error`, of a dropped level: 5 %. In noise-free data round-off would
/// otherwise be statistically significant.
const MATERIAL: f64 = 0.05;

/// Maximum order of an error that counts as constant: halving `h` changes it by less than 15 %.
pub(crate) const FLAT_ORDER: f64 = 0.2;

/// On a floor, the order is below this fraction of the previous order and of the formal order.
const FLOOR_FRACTION: f64 = 0.5;

#[derive(Clone, Debug)]
pub(crate) struct Window {
    pub(crate) range: Range<usize>,
    pub(crate) line: FittedLine,
}

impl Window {
    fn over(points: &[LogPoint], range: Range<usize>) -> Option<Self> {
        let line = FittedLine::through(&points[range.clone()])?;
        Some(Self { range, line })
    }

    /// Whether the error departs from the line at the fine end because of a floor.
    pub(crate) fn meets_floor(&self, points: &[LogPoint], formal_order: f64) -> bool {
        let end = self.range.end;
        let above = points[end..].iter().all(|p| self.line.departure(p) > 0.0);
        let limit = FLOOR_FRACTION * self.line.slope.min(formal_order);
        end < points.len()
            && above
            && FittedLine::through(&points[end - 1..]).is_some_and(|tail| tail.slope.abs() < limit)
    }

    /// Whether levels outside this window may be dropped, provided that the F-test rejects them.
    fn may_drop_rest(&self, points: &[LogPoint], formal_order: f64) -> bool {
        let Range { start, end } = self.range;
        let departures = |rest: &[LogPoint]| -> Vec<f64> {
            rest.iter().map(|p| self.line.departure(p)).collect()
        };
        let mut coarse = departures(&points[..start]);
        coarse.reverse();
        let fine = departures(&points[end..]);
        self.line.slope > FLAT_ORDER
            && is_departing(&coarse)
            && is_departing(&fine)
            && (fine.is_empty() || self.meets_floor(points, formal_order))
    }

    /// Whether the F-test rejects, at `risk`, that levels dropped by `shorter` lie on its line.
    fn is_rejected_by(&self, shorter: &Self, risk: f64) -> bool {
        let dropped = self.range.len() - shorter.range.len();
        let freedom = shorter.range.len() - 2;
        variance_ratio::regularised(shorter.line.rss / self.line.rss, freedom, dropped) < risk
    }

    fn improved(&self, points: &[LogPoint], formal_order: f64) -> Option<Self> {
        let candidates = shorter_ranges(&self.range);
        let risk = SELECTION_RISK / candidates.len() as f64;
        candidates.into_iter().filter_map(|range| Self::over(points, range)).find(|shorter| {
            self.is_rejected_by(shorter, risk) && shorter.may_drop_rest(points, formal_order)
        })
    }
}

/// Returns the asymptotic window among the points before `end` (the beginning of a floor, if one is
/// known). `None` if there are too few points or if no line can be fitted to them.
pub(crate) fn asymptotic(points: &[LogPoint], end: usize, formal_order: f64) -> Option<Window> {
    if end < FEWEST_LEVELS {
        return None;
    }
    let mut window = Window::over(points, 0..end)?;
    while let Some(better) = window.improved(points, formal_order) {
        window = better;
    }
    Some(window)
}

/// Lists contiguous parts with enough levels, the longest and then the finest first.
fn shorter_ranges(range: &Range<usize>) -> Vec<Range<usize>> {
    (FEWEST_LEVELS..range.len())
        .rev()
        .flat_map(|length| {
            let starts = (range.start..=range.end - length).rev();
            starts.map(move |start| start..start + length)
        })
        .collect()
}

/// Whether all departures exceed [`MATERIAL`] on one side, and the outermost is the largest.
fn is_departing(outward: &[f64]) -> bool {
    let Some(last) = outward.last() else {
        return true;
    };
    outward
        .iter()
        .all(|d| d.abs() > MATERIAL && d.abs() <= last.abs() && (*d > 0.0) == (*last > 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    fn points(orders: &[f64]) -> Vec<LogPoint> {
        let mut y = 0.0;
        let mut points = vec![LogPoint { level: 0, x: 0.0, y }];
        for (k, order) in orders.iter().enumerate() {
            y -= order;
            let level = k + 1;
            points.push(LogPoint { level, x: -(level as f64), y });
        }
        points
    }

    #[rstest]
    #[case::straight(&[2.0, 2.0, 2.0, 2.0, 2.0], 0..6)]
    #[case::first_pair_superconvergent(&[4.0, 2.0, 2.0, 2.0], 1..5)]
    #[case::coarse_end_flat(&[0.0, 1.0, 2.0, 2.0, 2.0], 2..6)]
    #[case::floor(&[2.0, 2.0, 2.0, 0.5, 0.0], 0..4)]
    #[case::both_ends(&[4.0, 2.0, 2.0, 2.0, 0.5, 0.0], 1..5)]
    #[case::outlier_kept(&[2.0, 2.0, 0.4, 3.6, 2.0, 2.0, 2.0], 0..8)]
    #[case::two_outliers_to_either_side(&[3.3, 1.7, 2.0, 2.0, 2.0, 2.0], 0..7)]
    #[case::second_is_outlier(&[0.4, 3.6, 2.0, 2.0, 2.0, 2.0], 0..7)]
    #[case::last_but_one_is_outlier(&[2.0, 2.0, 2.0, 2.0, 0.4, 3.6], 0..7)]
    #[case::superconvergent_fine_end_kept(&[2.0, 2.0, 2.0, 2.0, 4.0], 0..6)]
    #[case::too_short_to_drop(&[4.0, 2.0, 2.0], 0..4)]
    fn windows(#[case] orders: &[f64], #[case] expected: Range<usize>) {
        let points = points(orders);
        let window = asymptotic(&points, points.len(), 2.0).unwrap();
        assert_eq!(window.range, expected);
    }
}

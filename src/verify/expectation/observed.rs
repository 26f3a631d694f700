//! An observed order beside a range that a suite could claim.

use crate::verify::convergence::{Convergence, LevelOutcome};
use crate::verify::order::fit::Interval;
use crate::verify::order::format_number::format_number;
use crate::verify::order::hypothesis::OrderHypothesis;

/// Share of the distance from the middle of an interval to its end that an order may take up.
const COMFORTABLE: f64 = 0.75;

/// Whether the usual range about `order` holds the observed one with room to spare.
pub(crate) fn is_inside(observed: &Interval, order: f64) -> bool {
    let room = OrderHypothesis::TOLERANCE - (observed.value - order).abs();
    let room = room.min(COMFORTABLE * OrderHypothesis::TOLERANCE);
    2.0 * observed.half_width() <= room
}

/// The usual range about an order, as a suite writes it.
pub(crate) fn range(order: f64) -> String {
    let (low, high) = OrderHypothesis::formal(order).range();
    format!("[{}, {}]", format_number(low), format_number(high))
}

/// The levels that count.
pub(crate) fn counted(study: &Convergence) -> impl Iterator<Item = &LevelOutcome> {
    study.levels.iter().filter(|level| level.usable)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case::clear(2.01, 0.01, true)]
    #[case::only_just(2.08, 0.015, false)]
    #[case::uncertain(2.0, 0.05, false)]
    #[case::outside(2.11, 0.0, false)]
    #[case::outside_below(1.89, 0.0, false)]
    #[case::far_below(1.0, 0.0, false)]
    #[case::nan(f64::NAN, 0.0, false)]
    #[case::no_interval(2.0, f64::NAN, false)]
    fn no_interval_is_met_only_just(
        #[case] value: f64,
        #[case] half_width: f64,
        #[case] is_met: bool,
    ) {
        let observed = Interval { value, low: value - half_width, high: value + half_width };
        assert_eq!(is_inside(&observed, 2.0), is_met);
    }
}

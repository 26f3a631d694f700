//! Detects divergence, oscillation and floors in a series of errors, by their ratios only.

use crate::verify::order::fit::{FittedLine, LogPoint};
use crate::verify::order::window::{FEWEST_LEVELS, FLAT_ORDER};
use std::f64::consts::LN_2;

/// Minimum total growth of a divergent series: a factor of two. Less may be noise on a floor.
const LEAST_GROWTH: f64 = LN_2;

/// Maximum range of ln(error) on a floor: a factor of two, to allow round-off noise of -+ 30 %.
const FLOOR_BAND: f64 = LN_2;

/// A constant error is a floor only if the formal order would at least halve it over these levels.
const LEAST_LOSS: f64 = LN_2;

/// Minimum number of levels of a floor or a divergence: two successive pairs.
const FEWEST_OF_TREND: usize = 3;

/// Minimum order before a floor, well above the order of a flat series.
const LEAST_FALL: f64 = 2.5 * FLAT_ORDER;

/// Minimum mean factor between successive errors of an oscillation, larger than noise on a floor.
const LEAST_SWING: f64 = 1.5;

/// Minimum ratio of total rise and fall, the smaller to the larger, of an error without trend.
const BALANCE: f64 = 1.0 / 3.0;

/// Minimum number of changes between rise and fall in an oscillation. One outlier causes two.
const TURNS: usize = 3;

/// Returns the index of the level from which the error grows until the fine end, if it does.
///
/// The first level is returned if the line through all points has an order below -0.2, with a
/// confidence interval that excludes zero. Otherwise the divergent part begins at the smallest
/// error, has at least three levels, and grows at least twofold. It must also meet one of three
/// conditions: the last error is at least twice the first error of the series, the error rises over
/// the last two pairs, or the line through the part has an order below -0.2, as above.
pub(crate) fn divergence(points: &[LogPoint]) -> Option<usize> {
    if points.len() < FEWEST_LEVELS {
        return None;
    }
    if line_rises(points) {
        return Some(0);
    }
    let start = lowest(points)?;
    let part = &points[start..];
    let (first, last) = (points.first()?, points.last()?);
    let grows = part.len() >= FEWEST_OF_TREND && last.y - part[0].y >= LEAST_GROWTH;
    let rises_twice = part.windows(2).rev().take(2).all(|pair| pair[1].y > pair[0].y);
    (grows && (last.y - first.y >= LEAST_GROWTH || rises_twice || line_rises(part)))
        .then_some(start)
}

fn lowest(points: &[LogPoint]) -> Option<usize> {
    (0..points.len()).min_by(|&a, &b| points[a].y.total_cmp(&points[b].y))
}

fn line_rises(part: &[LogPoint]) -> bool {
    FittedLine::through(part)
        .map(|line| line.order())
        .is_some_and(|order| order.value < -FLAT_ORDER && order.high < 0.0)
}

/// Returns the index of the first level of a flat fine end: the longest tail with an order below
/// 0.2 whose errors lie in a band of a factor of two. It must follow a decreasing part or begin at
/// the first level. `None` if even the formal order would change the error by less than a factor of
/// two over the tail.
pub(crate) fn flat_tail(points: &[LogPoint], formal_order: f64) -> Option<usize> {
    let starts = 0..=points.len().checked_sub(FEWEST_OF_TREND)?;
    starts.into_iter().find(|&start| {
        let tail = &points[start..];
        let run = tail[0].x - tail[tail.len() - 1].x;
        spread(tail) <= FLOOR_BAND
            && formal_order * run >= LEAST_LOSS
            && slope(tail).is_some_and(|order| order.abs() <= FLAT_ORDER)
            && (start == 0 || slope(&points[..=start]).is_some_and(|order| order >= LEAST_FALL))
    })
}

fn slope(points: &[LogPoint]) -> Option<f64> {
    FittedLine::through(points).map(|line| line.slope)
}

fn spread(points: &[LogPoint]) -> f64 {
    let ys = || points.iter().map(|p| p.y);
    ys().fold(f64::NEG_INFINITY, f64::max) - ys().fold(f64::INFINITY, f64::min)
}

pub(crate) fn oscillates(points: &[LogPoint]) -> bool {
    let steps: Vec<f64> = points.windows(2).map(|pair| pair[1].y - pair[0].y).collect();
    let turns = steps.windows(2).filter(|s| s[0] * s[1] < 0.0).count();
    let rises: f64 = steps.iter().filter(|s| **s > 0.0).sum();
    let falls: f64 = -steps.iter().filter(|s| **s < 0.0).sum::<f64>();
    let swing = (rises + falls) / steps.len() as f64;
    points.len() >= FEWEST_LEVELS
        && turns >= TURNS.min(steps.len() - 1)
        && swing >= libm::log(LEAST_SWING)
        && rises.min(falls) >= BALANCE * rises.max(falls)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    fn points(errors: &[f64]) -> Vec<LogPoint> {
        let place = |(level, error): (usize, &f64)| LogPoint {
            level,
            x: -LN_2 * level as f64,
            y: libm::log(*error),
        };
        errors.iter().enumerate().map(place).collect()
    }

    #[rstest]
    #[case::growing(&[1.0, 2.0, 4.0, 8.0], Some(0))]
    #[case::growing_slowly(&[1.0, 1.2, 1.44, 1.7], Some(0))]
    #[case::falls_then_grows(&[9.0, 3.0, 1.0, 2.0, 4.0], Some(2))]
    #[case::grows_then_stays(&[1.0, 2.0, 4.0, 4.0, 4.0], Some(0))]
    #[case::one_rise(&[9.0, 3.0, 1.0, 4.0], None)]
    #[case::small_rise(&[9.0, 3.0, 1.0, 1.2, 1.4], None)]
    #[case::rises_and_turns(&[9.0, 3.0, 1.0, 2.0, 4.0, 3.0], None)]
    #[case::low_outlier(&[9.0, 3.0, 0.01, 0.3, 0.1], None)]
    #[case::falling(&[8.0, 4.0, 2.0, 1.0], None)]
    #[case::three_levels(&[1.0, 2.0, 4.0], None)]
    fn divergences(#[case] errors: &[f64], #[case] start: Option<usize>) {
        assert_eq!(divergence(&points(errors)), start);
    }

    #[rstest]
    #[case::flat(&[1.0, 1.1, 0.9, 1.0], Some(0))]
    #[case::after_a_fall(&[16.0, 4.0, 1.0, 1.1, 0.9], Some(2))]
    #[case::one_flat_pair(&[64.0, 16.0, 4.0, 4.0], None)]
    #[case::slow_fall(&[4.0, 3.0, 2.2, 1.6], None)]
    #[case::slow_rise(&[16.0, 4.0, 1.0, 1.3, 1.6], None)]
    #[case::wide(&[1.0, 3.0, 1.0, 3.0], None)]
    #[case::after_a_rise(&[1.0, 3.0, 3.0, 3.0], None)]
    #[case::two_levels(&[1.0, 1.0], None)]
    fn flat_tails(#[case] errors: &[f64], #[case] start: Option<usize>) {
        assert_eq!(flat_tail(&points(errors), 2.0), start);
    }

    #[rstest]
    #[case::even(&[1.0, 2.0, 1.0, 2.0, 1.0], true)]
    #[case::just_above_the_noise(&[1.0, 1.6, 1.0, 1.6, 1.0], true)]
    #[case::four_levels(&[2.0, 1.0, 2.0, 1.0], true)]
    #[case::with_a_slight_trend(&[1.0, 0.1, 0.5, 0.05, 0.25, 0.025], true)]
    #[case::with_a_clear_trend(&[1.0, 0.1, 0.12, 0.01, 0.012], false)]
    #[case::noise_of_a_floor(&[1.0, 1.2, 0.9, 1.1, 0.8], false)]
    #[case::one_outlier(&[1.0, 0.5, 1.25, 0.125, 0.0625], false)]
    #[case::one_outlier_on_a_plateau(&[1.0, 0.5, 2.0, 1.0, 0.9], false)]
    #[case::growing(&[1.0, 2.0, 4.0, 8.0], false)]
    fn oscillations(#[case] errors: &[f64], #[case] expected: bool) {
        assert_eq!(oscillates(&points(errors)), expected);
    }
}

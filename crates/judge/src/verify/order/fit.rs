//! Computes the observed order by regression, with its confidence interval.
//!
//! An error `C h^p` with multiplicative noise is the straight line `ln error = ln C + p ln h`. A
//! least-squares fit to `n` points gives
//!
//! ```text
//! p   = Sxy / Sxx
//! s^2 = rss / (n - 2)
//! interval = p -+ t(0.975, n - 2) s / sqrt(Sxx)
//! ```
//!
//! If the noise is log-normal, the interval contains the true order with a probability of 95 %
//! (Draper & Smith, Applied Regression Analysis, 3rd ed., section 1.4); a drift also widens it.

use super::{t_quantile, variance_ratio};
use serde::{Deserialize, Serialize};

/// A value with its two-sided 95 % confidence interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// The estimate.
    pub value: f64,
    /// The lower end of the interval.
    pub low: f64,
    /// The upper end of the interval.
    pub high: f64,
}

impl Interval {
    /// Formats the interval to two decimals, as in tables of orders: `2.00 [1.99, 2.01]`.
    pub fn shown(&self) -> String {
        format!("{:.2} [{:.2}, {:.2}]", self.value, self.low, self.high)
    }

    /// Returns half of the width of the interval.
    pub fn half_width(&self) -> f64 {
        0.5 * (self.high - self.low)
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct LogPoint {
    /// Index of the level among the sorted levels.
    pub(crate) level: usize,
    /// `ln h`
    pub(crate) x: f64,
    /// `ln error`
    pub(crate) y: f64,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct FittedLine {
    pub(crate) slope: f64,
    pub(crate) rss: f64,
    mean_x: f64,
    mean_y: f64,
    sxx: f64,
    points: usize,
}

impl FittedLine {
    /// Fits a line; `None` unless two points have distinct `x`.
    pub(crate) fn through(points: &[LogPoint]) -> Option<Self> {
        let n = points.len() as f64;
        let mean_x = points.iter().map(|p| p.x).sum::<f64>() / n;
        let mean_y = points.iter().map(|p| p.y).sum::<f64>() / n;
        let sxx: f64 = points.iter().map(|p| square(p.x - mean_x)).sum();
        let sxy: f64 = points.iter().map(|p| (p.x - mean_x) * (p.y - mean_y)).sum();
        let mut line =
            Self { slope: sxy / sxx, rss: 0.0, mean_x, mean_y, sxx, points: points.len() };
        line.rss = points.iter().map(|p| square(line.departure(p))).sum();
        (sxx > 0.0 && line.slope.is_finite()).then_some(line)
    }

    /// Returns `ln` of the ratio of the error at a point to the error on the line.
    pub(crate) fn departure(&self, point: &LogPoint) -> f64 {
        (point.y - self.mean_y) - self.slope * (point.x - self.mean_x)
    }

    /// Returns the slope with its interval, whose ends are NaN for fewer than three points.
    pub(crate) fn order(&self) -> Interval {
        let freedom = self.points.saturating_sub(2);
        let deviation = (self.rss / freedom as f64 / self.sxx).sqrt();
        let half_width = t_quantile::two_sided_95(freedom) * deviation;
        Interval { value: self.slope, low: self.slope - half_width, high: self.slope + half_width }
    }

    /// Computes the drift of the order over the points of this line from a fit with a parabola.
    pub(crate) fn drift(&self, points: &[LogPoint]) -> Option<Trend> {
        let parabola: Vec<LogPoint> =
            points.iter().map(|p| LogPoint { y: square(p.x - self.mean_x), ..*p }).collect();
        let base = Self::through(&parabola)?;
        let sqy: f64 =
            parabola.iter().zip(points).map(|(q, p)| base.departure(q) * self.departure(p)).sum();
        let rest = (self.rss - sqy * sqy / base.rss).max(0.0);
        let span = points.last()?.x - points.first()?.x;
        Some(Trend {
            change: 2.0 * (sqy / base.rss) * span,
            p_value: variance_ratio::regularised(rest / self.rss, self.points.saturating_sub(3), 1),
        })
    }
}

/// A steady change of the order along a window.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Trend {
    /// Order at the finest level minus the order at the coarsest level.
    pub(crate) change: f64,
    /// Probability that noise about a straight line causes a change at least this large.
    pub(crate) p_value: f64,
}

fn square(x: f64) -> f64 {
    x * x
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    fn points(y: impl Fn(f64) -> f64) -> Vec<LogPoint> {
        (0..6)
            .map(|level| {
                let x = -f64::from(level);
                let level = level as usize;
                LogPoint { level, x, y: y(x) }
            })
            .collect()
    }

    #[test]
    fn a_straight_line_has_an_interval_of_no_width() {
        let order = FittedLine::through(&points(|x| 2.5 * x - 7.0)).unwrap().order();
        assert_abs_diff_eq!(order.value, 2.5, epsilon = 1e-14);
        assert_abs_diff_eq!(order.half_width(), 0.0, epsilon = 1e-13);
    }

    /// By hand: y = 0, 0, 3 at x = 0, 1, 2 gives slope 3/2, rss 3/2 and t(0.975, 1) = 12.7062.
    #[test]
    fn three_points_by_hand() {
        let y = [0.0, 0.0, 3.0];
        let points: Vec<LogPoint> =
            (0..3).map(|level| LogPoint { level, x: level as f64, y: y[level] }).collect();
        let order = FittedLine::through(&points).unwrap().order();
        assert_abs_diff_eq!(order.value, 1.5, epsilon = 1e-14);
        let half_width = 12.7062 * 0.75_f64.sqrt();
        assert_abs_diff_eq!(order.half_width(), half_width, epsilon = 1e-4);
    }

    #[test]
    fn a_parabola_drifts_and_a_line_does_not() {
        let curved = points(|x| 2.0 * x + 0.1 * x * x);
        let drift = FittedLine::through(&curved).unwrap().drift(&curved).unwrap();
        assert_abs_diff_eq!(drift.change, -1.0, epsilon = 1e-12);
        assert!(drift.p_value < 1e-9);
        let straight = points(|x| 2.0 * x);
        let drift = FittedLine::through(&straight).unwrap().drift(&straight).unwrap();
        assert_abs_diff_eq!(drift.change, 0.0, epsilon = 1e-12);
    }

    #[test]
    fn single_point_has_no_slope() {
        assert!(FittedLine::through(&points(|_| 0.0)[..1]).is_none());
        assert!(FittedLine::through(&[]).is_none());
    }
}

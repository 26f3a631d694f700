//! Cost of one more correct digit: the exponent of work ~ error^exponent, observed and theoretical.
//!
//! With error ~ h^p and work ~ h^-g the exponent is -g/p. Here g = D + 1 if cells and time steps
//! are refined together, g = D for constant steps, and g = 1 if only time steps are refined.
//!
//! The line is fitted to `ln error` over `ln work`, because work is counted and has no noise. The
//! exponent and the ends of its interval are the inverses of those of the slope (inverse
//! regression: Draper & Smith, Applied Regression Analysis, 3rd ed., section 3.2).

use super::sample::{ConvergingPart, Sample};
use crate::verify::order::fit::{FittedLine, Interval, LogPoint};

const FEWEST: usize = 3;

/// Minimum relative half-width of an interval, for series without noise.
const ROUNDING: f64 = 1e-9;

/// Maximum relative difference between observed and theoretical growth that count as equal.
const SAME: f64 = 0.02;

/// Marginal cost of accuracy: the exponent of work over error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exponent {
    /// Observed exponent of work over error, with its 95 % confidence interval.
    pub observed: Interval,
    /// Theoretical exponent of work over error.
    pub theory: f64,
    /// Observed order of the error over the same levels, and the formal order.
    pub order: (f64, f64),
    /// Growth of the work over these levels: observed, and that of the refinement plan.
    pub growth: (f64, f64),
}

/// Agreement of an exponent with theory, or the main cause of the difference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Agreement {
    /// The theoretical value is within the interval.
    Agrees,
    /// The order of the error differs from theory.
    Order,
    /// The growth of the work differs from theory.
    Growth,
}

impl Exponent {
    /// Returns the exponent over the asymptotic levels of `part`, or over all its levels if fewer
    /// than three are asymptotic. `order` and `growth` are the theoretical values. `None` with
    /// fewer than three levels, or if the interval of the slope contains zero.
    pub fn of(samples: &[Sample], part: &ConvergingPart, order: f64, growth: f64) -> Option<Self> {
        let levels = &samples[part.levels.clone()];
        let asymptotic: Vec<Sample> = levels.iter().filter(|one| one.asymptotic).copied().collect();
        let levels = if asymptotic.len() >= FEWEST { &asymptotic[..] } else { levels };
        if levels.len() < FEWEST {
            return None;
        }
        let slope = |x: fn(&Sample) -> f64, y: fn(&Sample) -> f64| {
            let point = |(level, one): (usize, &Sample)| LogPoint {
                level,
                x: libm::log(x(one)),
                y: libm::log(y(one)),
            };
            FittedLine::through(&levels.iter().enumerate().map(point).collect::<Vec<_>>())
        };
        let fall = slope(|one| one.work, |one| one.error)?.order();
        if !(fall.high < 0.0) {
            return None;
        }
        let errors = slope(|one| one.spacing, |one| one.error)?.slope;
        let works = slope(|one| one.spacing, |one| one.work)?.slope;
        Some(Self {
            // The slope is negative, so its steeper bound gives the lower cost.
            observed: Interval {
                value: 1.0 / fall.value,
                low: 1.0 / fall.high,
                high: 1.0 / fall.low,
            },
            theory: -growth / order,
            order: (errors, order),
            growth: (-works, growth),
        })
    }

    /// Returns whether the theoretical value is within the interval, and if not, the main cause.
    pub fn agreement(&self) -> Agreement {
        let Interval { low, high, .. } = self.observed;
        let spare = ROUNDING * self.theory.abs();
        if low - spare <= self.theory && self.theory <= high + spare {
            return Agreement::Agrees;
        }
        let off = |(observed, expected): (f64, f64)| libm::log(observed / expected).abs();
        if off(self.growth) > off(self.order).max(SAME) {
            Agreement::Growth
        } else {
            Agreement::Order
        }
    }
}

//! Predicts the error of a level that has not run, with an interval.
//!
//! For levels finer than the n levels of the judge's fit, with x = ln h:
//!
//! ```text
//! ln error = line(x) -+ (t(0.975, n - 2) s sqrt(1 + 1/n + (x - mean)^2 / Sxx) + 0.25 (finest - x))
//! ```
//!
//! The first term is the prediction interval of a regression (Draper & Smith, Applied Regression
//! Analysis, 3rd ed., section 3.1). The second term allows the order to change by 0.25 on finer
//! levels. Between two levels the error is interpolated on logarithmic axes, and the interval has
//! only the second term, with the distance to the nearer level.
//!
//! No error is predicted for finer levels if the errors do not converge or have stopped decreasing
//! (a floor), or if the order falls at the end, which is the first sign of a floor.

use super::sample::{ConvergingPart, End, Sample};
use crate::verify::order::fit::{FittedLine, Interval, LogPoint};
use crate::verify::order::hypothesis::OrderHypothesis;
use crate::verify::verdict::judge::SETTLED;
use crate::verify::verdict::name::Verdict;
use std::fmt;

/// Minimum number of levels for a prediction interval.
const FEWEST: usize = 3;

/// Predicted errors of a method.
#[derive(Debug, Clone)]
pub struct PredictedError {
    /// Levels over which the method converges.
    levels: Vec<Sample>,
    /// The fitted line, and the lower of the observed and the formal order; or the reason why no
    /// error is predicted for finer levels.
    beyond: Result<(FittedLine, f64), Unpredicted>,
}

/// Reason why no error is predicted for finer levels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unpredicted {
    /// The verdict on the levels is not `converging`.
    Verdict(Verdict),
    /// The converging part ends before the finest level.
    End(End),
    /// Fewer than three levels.
    TooFew,
    /// The order between the two finest levels is below the order of all levels.
    Falling,
}

impl fmt::Display for Unpredicted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Verdict(verdict) => write!(f, "the levels are judged {verdict}"),
            Self::End(end) => f.write_str(end.words()),
            Self::TooFew => f.write_str("fewer than three levels"),
            Self::Falling => f.write_str("the order falls on the finest level"),
        }
    }
}

impl PredictedError {
    /// Creates the prediction from all levels, the verdict on these levels, and the part over which
    /// the error converges.
    pub fn of(
        samples: &[Sample],
        part: &ConvergingPart,
        verdict: Verdict,
        formal_order: f64,
    ) -> Self {
        let levels = samples[part.levels.clone()].to_vec();
        let beyond = match (part.end, verdict) {
            (End::Levels, Verdict::Converging) => line(&levels, formal_order),
            (End::Levels, verdict) => Err(Unpredicted::Verdict(verdict)),
            (end, _) => Err(Unpredicted::End(end)),
        };
        Self { levels, beyond }
    }

    /// Returns the reason why no error is predicted for finer levels; `None` if one is predicted.
    pub fn obstacle(&self) -> Option<Unpredicted> {
        self.beyond.err()
    }

    /// Returns the predicted error at a spacing; `None` without a prediction.
    pub fn at(&self, spacing: f64) -> Option<Interval> {
        let finest = self.levels.last()?;
        if spacing < finest.spacing {
            let (line, order) = self.beyond.ok()?;
            let (x, end) = (libm::log(spacing), libm::log(finest.spacing));
            let Interval { value, low, high } = line.another(x);
            // An observed order above the formal order is not expected to continue on finer grids.
            let lost = (line.slope - order) * (end - x);
            let more = SETTLED * (end - x);
            return exp(Interval {
                value: value + lost,
                low: low - more,
                high: high + lost + more,
            });
        }
        let pair =
            self.levels.windows(2).find(|p| p[0].spacing >= spacing && spacing >= p[1].spacing)?;
        let (coarser, finer) =
            (libm::log(pair[0].spacing / spacing), libm::log(spacing / pair[1].spacing));
        let share = coarser / (coarser + finer);
        let value = libm::log(pair[0].error) * (1.0 - share) + libm::log(pair[1].error) * share;
        let distance = SETTLED * coarser.min(finer);
        exp(Interval { value, low: value - distance, high: value + distance })
    }
}

/// Fits the line that predicts errors on finer levels.
fn line(levels: &[Sample], formal_order: f64) -> Result<(FittedLine, f64), Unpredicted> {
    let fitted = levels.iter().enumerate().filter(|(_, one)| one.asymptotic);
    let points: Vec<LogPoint> = fitted
        .map(|(level, one)| LogPoint { level, x: libm::log(one.spacing), y: libm::log(one.error) })
        .collect();
    if points.len() < FEWEST {
        return Err(Unpredicted::TooFew);
    }
    let line = FittedLine::through(&points).ok_or(Unpredicted::TooFew)?;
    let last = FittedLine::through(&points[points.len() - 2..]).ok_or(Unpredicted::TooFew)?;
    let order = line.slope.min(formal_order);
    let holds = last.slope >= order - OrderHypothesis::TOLERANCE;
    holds.then_some((line, order)).ok_or(Unpredicted::Falling)
}

/// Returns the exponential of each value; `None` if a result is not finite.
fn exp(Interval { value, low, high }: Interval) -> Option<Interval> {
    let [value, low, high] = [value, low, high].map(libm::exp);
    (low <= value && value <= high).then_some(Interval { value, low, high })
}

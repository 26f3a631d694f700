//! The decision sequence that determines the verdict from levels.
//!
//! 1. Is every level valid, and the hypothesis testable? Otherwise `failed`.
//! 2. Are there four usable levels? Otherwise `too few levels`.
//! 3. Does the error oscillate, grow, or stop decreasing (a floor)? `oscillatory`, `divergent` or
//!    `at floor`, by the shapes of [`error_trend`]; an error of exactly zero is also a floor.
//! 4. Which levels are asymptotic? See [`window`]. If the window excludes levels at the fine end,
//!    the verdict is `at floor`.
//! 5. Has the order settled over these levels? A wide interval or a drift is `pre-asymptotic`.
//! 6. `too good` or `too low` if the order is outside the expected range; `converging` if the whole
//!    interval is inside; `pre-asymptotic` if only the order is inside.
//!
//! Unusable levels take part in step 1 only.

use super::error_trend;
use super::reason::Reason;
use crate::verify::order::fit::{FittedLine, Interval, LogPoint};
use crate::verify::order::level::{Level, arrange, pairwise};
use crate::verify::order::window;
use crate::verify::order::window::{FEWEST_LEVELS, Window};
use crate::verify::{OrderHypothesis, Verdict};
use std::ops::Range;

/// Maximum half-width of the interval of a settled order: half of 0.5, the typical difference
/// between the orders of two methods.
pub(crate) const SETTLED: f64 = 0.25;

/// Maximum half-width relative to the order above order 2, where it equals [`SETTLED`].
const SETTLED_FRACTION: f64 = SETTLED / 2.0;

/// Minimum change of the order along the window that is a drift: the default range's width.
const DRIFT: f64 = 2.0 * OrderHypothesis::TOLERANCE;

/// Significance level of a drift: noise alone causes a drift in one of a thousand series.
const DRIFT_RISK: f64 = 0.001;

/// Minimum number of levels before a floor for which an order is reported, as information only.
const FEWEST_BEFORE_FLOOR: usize = 3;

/// A verdict and the measured values that led to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// The verdict.
    pub verdict: Verdict,
    /// Observed order with its 95 % confidence interval, over the asymptotic levels, the levels
    /// before a floor, or the divergent levels. `None` if no order was fitted.
    pub order: Option<Interval>,
    /// Levels in the fit of the order, as indices into `levels`.
    pub window: Option<Vec<usize>>,
    /// Order between level `k - 1` and level `k`, for usable and unusable levels.
    pub pairwise: Vec<Option<f64>>,
    /// Levels from coarse to fine, with identical ones merged.
    pub levels: Vec<Level>,
    /// Reason of the verdict, in one line.
    pub reason: String,
}

impl Judgement {
    /// Creates the judgement of levels whose errors are not compared with a solution.
    pub(crate) fn without_comparison(levels: usize) -> Self {
        Self {
            verdict: Verdict::TooFewLevels,
            order: None,
            window: None,
            pairwise: vec![None; levels],
            levels: Vec::new(),
            reason: "errors are not compared".to_owned(),
        }
    }
}

/// Judges the errors of a refinement study against a claimed order.
pub fn judge(levels: &[Level], hypothesis: &OrderHypothesis) -> Judgement {
    let (levels, diagnostic) = arrange(levels, hypothesis.axis);
    let finding = match diagnostic.or_else(|| hypothesis.diagnostic()) {
        Some(diagnostic) => Finding::without_order(Verdict::Failed, Reason::Failed(diagnostic)),
        None => JudgedSeries::new(&levels).finding(hypothesis),
    };
    let window = finding.window.as_deref();
    Judgement {
        verdict: finding.verdict,
        order: finding.line.map(|line| line.order()),
        window: window.map(|points| points.iter().map(|p| p.level).collect()),
        pairwise: pairwise(&levels),
        reason: finding.reason.sentence(&levels, hypothesis.axis, window, finding.line.as_ref()),
        levels,
    }
}

struct Finding {
    verdict: Verdict,
    reason: Reason,
    window: Option<Vec<LogPoint>>,
    line: Option<FittedLine>,
}

impl Finding {
    fn without_order(verdict: Verdict, reason: Reason) -> Self {
        Self { verdict, reason, window: None, line: None }
    }

    fn over(
        verdict: Verdict,
        reason: Reason,
        points: &[LogPoint],
        line: Option<FittedLine>,
    ) -> Self {
        Self { verdict, reason, window: line.map(|_| points.to_vec()), line }
    }
}

struct JudgedSeries {
    /// Levels with a non-zero error, on logarithmic axes.
    points: Vec<LogPoint>,
    /// Indices of the levels with zero error.
    zeros: Vec<usize>,
}

impl JudgedSeries {
    fn new(levels: &[Level]) -> Self {
        let usable = || levels.iter().enumerate().filter(|(_, level)| level.usable);
        let (nonzero, zero): (Vec<_>, Vec<_>) = usable().partition(|(_, level)| level.error > 0.0);
        let point = |(k, level): (usize, &Level)| LogPoint {
            level: k,
            x: libm::log(level.h),
            y: libm::log(level.error),
        };
        Self {
            points: nonzero.into_iter().map(point).collect(),
            zeros: zero.into_iter().map(|(k, _)| k).collect(),
        }
    }

    fn finding(&self, hypothesis: &OrderHypothesis) -> Finding {
        let usable = self.points.len() + self.zeros.len();
        if usable < FEWEST_LEVELS {
            let reason = Reason::TooFew { usable };
            return Finding::without_order(Verdict::TooFewLevels, reason);
        }
        self.oscillatory()
            .or_else(|| self.divergent())
            .or_else(|| self.zero(hypothesis))
            .or_else(|| self.flat(hypothesis))
            .unwrap_or_else(|| self.asymptotic(hypothesis))
    }

    fn oscillatory(&self) -> Option<Finding> {
        (self.zeros.is_empty() && error_trend::oscillates(&self.points))
            .then(|| Finding::without_order(Verdict::Oscillatory, Reason::Oscillatory))
    }

    /// Detects a divergence. If the finest error is zero, there is none.
    fn divergent(&self) -> Option<Finding> {
        let finest = self.points.last()?.level;
        let start = error_trend::divergence(&self.points)?;
        let part = &self.points[start..];
        (self.zeros.iter().all(|&zero| zero < finest)).then(|| {
            let reason = Reason::Divergent { from: part[0].level, to: finest };
            Finding::over(Verdict::Divergent, reason, part, FittedLine::through(part))
        })
    }

    fn zero(&self, hypothesis: &OrderHypothesis) -> Option<Finding> {
        let from = *self.zeros.first()?;
        let end = self.points.partition_point(|p| p.level < from);
        let flat = error_trend::flat_tail(&self.points[..end], hypothesis.formal_order);
        Some(self.before_floor(from, flat.unwrap_or(end), hypothesis))
    }

    fn flat(&self, hypothesis: &OrderHypothesis) -> Option<Finding> {
        let start = error_trend::flat_tail(&self.points, hypothesis.formal_order)?;
        Some(self.before_floor(self.points[start].level, start, hypothesis))
    }

    /// Creates the judgement of a floor from level `from`; the order excludes points from `end` on.
    fn before_floor(&self, from: usize, end: usize, hypothesis: &OrderHypothesis) -> Finding {
        let window = window::asymptotic(&self.points, end, hypothesis.formal_order);
        self.floor(from, window.map_or(0..end, |window| window.range))
    }

    fn floor(&self, from: usize, range: Range<usize>) -> Finding {
        let points = &self.points[range];
        let enough = points.len() >= FEWEST_BEFORE_FLOOR;
        let line = FittedLine::through(points).filter(|_| enough);
        Finding::over(Verdict::AtFloor, Reason::Floor { from }, points, line)
    }

    fn asymptotic(&self, hypothesis: &OrderHypothesis) -> Finding {
        let Some(window) =
            window::asymptotic(&self.points, self.points.len(), hypothesis.formal_order)
        else {
            let diagnostic = "the spacings cannot be told apart".into();
            return Finding::without_order(Verdict::Failed, Reason::Failed(diagnostic));
        };
        if window.meets_floor(&self.points, hypothesis.formal_order) {
            let from = self.points[window.range.end].level;
            return self.floor(from, window.range);
        }
        let points = &self.points[window.range.clone()];
        let (verdict, reason) = settled(&window, points, hypothesis);
        Finding::over(verdict, reason, points, Some(window.line))
    }
}

/// Performs steps 5 and 6 of the decision sequence.
fn settled(
    window: &Window,
    points: &[LogPoint],
    hypothesis: &OrderHypothesis,
) -> (Verdict, Reason) {
    let order = window.line.order();
    let range @ (low, high) = hypothesis.range();
    let narrow = order.half_width() <= SETTLED.max(SETTLED_FRACTION * order.value);
    if !narrow {
        return (Verdict::PreAsymptotic, Reason::Wide);
    }
    if let Some(change) = drift(window, points) {
        return (Verdict::PreAsymptotic, Reason::Drift { change });
    }
    let verdict = if order.low >= low && order.high <= high {
        Verdict::Converging
    } else if order.value > high {
        Verdict::TooGood
    } else if order.value < low {
        Verdict::TooLow
    } else {
        Verdict::PreAsymptotic
    };
    let overlaps = order.low <= high && order.high >= low;
    (verdict, Reason::Against { verdict, range, overlaps })
}

/// Computes the change of the order along the window, if significant and larger than [`DRIFT`].
fn drift(window: &Window, points: &[LogPoint]) -> Option<f64> {
    let drift = window.line.drift(points)?;
    (drift.p_value < DRIFT_RISK && drift.change.abs() > DRIFT).then_some(drift.change)
}

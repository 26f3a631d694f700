//! States the reason of a verdict in one line, with the measured values that led to it.

use crate::verify::order::fit::{FittedLine, LogPoint};
use crate::verify::order::format_number::{format_number, order};
use crate::verify::{Axis, FEWEST_LEVELS, Level, Verdict};

/// Reason of a verdict. Levels are given as indices into the series.
pub(crate) enum Reason {
    Failed(String),
    TooFew {
        usable: usize,
    },
    Oscillatory,
    Divergent {
        from: usize,
        to: usize,
    },
    Floor {
        from: usize,
    },
    Wide,
    Drift {
        change: f64,
    },
    /// The order is compared with the expected range. `overlaps` is true if the order is outside
    /// the range but its interval overlaps the range.
    Against {
        verdict: Verdict,
        range: (f64, f64),
        overlaps: bool,
    },
}

impl Reason {
    pub(crate) fn sentence(
        &self,
        levels: &[Level],
        axis: Axis,
        window: Option<&[LogPoint]>,
        line: Option<&FittedLine>,
    ) -> String {
        let order = window.zip(line).map(|(points, line)| order_over(levels, axis, points, line));
        let cause = self.cause(levels, axis);
        match (self, order) {
            (Self::Floor { .. }, Some(order)) => {
                format!("{cause}; before that, the order is {order}")
            }
            (Self::Floor { .. }, None) => format!("{cause}; before that, there is no order"),
            (Self::Against { .. }, Some(order)) => format!("order {order}, {cause}"),
            (_, Some(order)) => format!("{cause}: order {order}"),
            (_, None) => cause,
        }
    }

    fn cause(&self, levels: &[Level], axis: Axis) -> String {
        match self {
            Self::Failed(diagnostic) => diagnostic.clone(),
            Self::TooFew { usable } => {
                let noun = if *usable == 1 { "level" } else { "levels" };
                format!("{usable} usable {noun}, but an order needs {FEWEST_LEVELS}")
            }
            Self::Oscillatory => oscillation(levels),
            Self::Divergent { from, to } => {
                let (from, to) = (place(&levels[*from], axis), place(&levels[*to], axis));
                format!("the error grows from {from} to {to}")
            }
            Self::Floor { from } => floor(&levels[*from..], axis),
            Self::Wide => "the order has not settled".into(),
            Self::Drift { change } => {
                format!("the order drifts by {change:.3} along the window")
            }
            Self::Against { verdict, range, overlaps } => against(*verdict, *range, *overlaps),
        }
    }
}

/// Formats an order, such as `2.003 [1.991, 2.015] over 5 levels, h = 5 ... 0.4167`.
fn order_over(levels: &[Level], axis: Axis, points: &[LogPoint], line: &FittedLine) -> String {
    let ends = [points.first(), points.last()];
    let [coarse, fine] = ends.map(|p| p.map_or(f64::NAN, |p| levels[p.level].h));
    let (order, count) = (order(&line.order()), points.len());
    let (coarse, fine) = (format_number(coarse), format_number(fine));
    format!("{order} over {count} levels, {} = {coarse} ... {fine}", axis.symbol())
}

/// Formats error and spacing of a level, such as `0.25 at h = 0.5`.
fn place(level: &Level, axis: Axis) -> String {
    format!("{} at {} = {}", format_number(level.error), axis.symbol(), format_number(level.h))
}

fn oscillation(levels: &[Level]) -> String {
    let usable = levels.iter().filter(|level| level.usable);
    let errors: Vec<String> = usable.map(|level| format_number(level.error)).collect();
    format!("the error goes up and down without a trend: {}", errors.join(", "))
}

fn floor(levels: &[Level], axis: Axis) -> String {
    let errors = || levels.iter().filter(|level| level.usable).map(|level| level.error);
    let low = errors().fold(f64::INFINITY, f64::min);
    let high = errors().fold(0.0, f64::max);
    let h = levels.first().map_or(f64::NAN, |level| level.h);
    let name = axis.symbol();
    let (h, low, high) = (format_number(h), format_number(low), format_number(high));
    if low == high {
        format!("the error stays at {low} for {name} <= {h}")
    } else {
        format!("the error stays between {low} and {high} for {name} <= {h}")
    }
}

fn against(verdict: Verdict, range: (f64, f64), overlaps: bool) -> String {
    let (low, high) = (format_number(range.0), format_number(range.1));
    let undecided =
        if overlaps { ", but the interval overlaps this range: not decided" } else { "" };
    match verdict {
        Verdict::Converging => format!("within [{low}, {high}]"),
        Verdict::TooGood => format!("above [{low}, {high}]{undecided}"),
        Verdict::TooLow => format!("below [{low}, {high}]{undecided}"),
        _ => format!("but the interval extends beyond [{low}, {high}]"),
    }
}

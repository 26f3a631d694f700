//! Events: positions and times at which conditions are checked, distributed over space-time boxes.

use crate::exact::random::Random;
use crate::exact::violation::Violation;

pub(crate) const AXES: [&str; 3] = ["X", "Y", "Z"];

#[derive(Debug, Clone)]
pub(crate) struct Event {
    pub(crate) label: Vec<f64>,
    pub(crate) t: f64,
}

impl Event {
    /// Returns a violation if the two `values`, expected and found, differ by more than `allowed`,
    /// or if their difference is infinite or NaN. `condition` describes the difference.
    pub(crate) fn judge(
        &self,
        allowed: f64,
        condition: String,
        values: (f64, f64),
        unit: &'static str,
    ) -> Result<(), Violation> {
        let (expected, found) = values;
        let off = (found - expected).abs();
        if off.is_finite() && off <= allowed {
            return Ok(());
        }
        Err(self.violation(condition, Some(expected), found, Some(allowed), unit))
    }

    /// Compares values like [`judge`](Self::judge), and reports the violated `condition`.
    pub(crate) fn judge_condition(
        &self,
        allowed: f64,
        condition: String,
        values: (f64, f64),
        unit: &'static str,
    ) -> Result<(), Violation> {
        self.judge(allowed, condition, values, unit).map_err(|violation| Violation {
            condition: violation.condition + " is violated",
            ..violation
        })
    }

    /// Returns a violation if `found` is greater than `most + allowed`, infinite or NaN.
    pub(crate) fn judge_most(
        &self,
        allowed: f64,
        condition: String,
        most: f64,
        found: f64,
        unit: &'static str,
    ) -> Result<(), Violation> {
        let over = found - most;
        if over.is_finite() && over <= allowed {
            return Ok(());
        }
        Err(self.violation(condition, Some(most), found, Some(allowed), unit))
    }

    /// Returns the position on the face of the box opposite the `high` or low face along `axis`.
    pub(crate) fn opposite(&self, from: &[f64], to: &[f64], axis: usize, high: bool) -> Vec<f64> {
        let mut label = self.label.clone();
        label[axis] = if high { from[axis] } else { to[axis] };
        label
    }

    pub(crate) fn violation(
        &self,
        condition: String,
        expected: Option<f64>,
        found: f64,
        allowed: Option<f64>,
        unit: &'static str,
    ) -> Violation {
        let label = self.label.clone();
        Violation { condition, label, t: self.t, expected, found, allowed, unit }
    }
}

/// Returns the largest magnitude, or NaN if any is NaN. NaN makes every later comparison fail.
pub(crate) fn greatest(magnitudes: impl Iterator<Item = f64>) -> f64 {
    magnitudes.fold(0.0, |a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { f64::max(a, b) })
}

pub(crate) fn largest(values: &[f64; 3]) -> f64 {
    values.iter().fold(0.0, |a, b| if f64::is_nan(a + b) { f64::NAN } else { f64::max(a, b.abs()) })
}

/// Returns the magnitude of the residual `left` relative to `size`; 0 if `left` is 0.
pub(super) fn share(left: f64, size: f64) -> f64 {
    if left == 0.0 { 0.0 } else { left.abs() / size }
}

/// Number of events in a body if only a small part of it has large terms.
pub(crate) const EVENTS: usize = 4096;

/// Number of events on a face (or an edge) if only a small part of the body has large terms.
pub(crate) const FACE_EVENTS: usize = 1024;

/// Divisor of [`EVENTS`] and [`FACE_EVENTS`] if terms are large in a large part of the body.
pub(crate) const BROAD: usize = 8;

pub(crate) struct SpaceTimeBox<'a> {
    pub(crate) from: &'a [f64],
    pub(crate) to: &'a [f64],
    pub(crate) start: f64,
    pub(crate) end: f64,
}

impl SpaceTimeBox<'_> {
    /// Returns a random event in each of at most `count` cells; only axes that vary are divided.
    pub(crate) fn spread(
        &self,
        count: usize,
        varies: impl Fn(usize) -> bool,
        random: &mut Random,
    ) -> Vec<Event> {
        let d = self.from.len();
        let ends: Vec<(f64, f64)> = (self.from.iter().zip(self.to).map(|(a, b)| (*a, *b)))
            .chain([(self.start, self.end)])
            .collect();
        let divided: Vec<bool> = ends
            .iter()
            .enumerate()
            .map(|(a, (low, high))| high > low && (a == d || varies(a)))
            .collect();
        let axes = divided.iter().filter(|divided| **divided).count() as u32;
        let per_axis = (1..=count).take_while(|n| n.pow(axes) <= count).last().unwrap_or(1);
        let total = per_axis.pow(axes);
        let event = |mut number: usize| {
            let mut coordinates = ends.iter().zip(&divided).map(|((low, high), divided)| {
                let (cell, cells) = if *divided { (number % per_axis, per_axis) } else { (0, 1) };
                number /= cells;
                low + (high - low) * ((cell as f64 + random.unit()) / cells as f64)
            });
            let label = coordinates.by_ref().take(d).collect();
            Event { label, t: coordinates.next().unwrap_or(self.end) }
        };
        (0..total).map(event).collect()
    }
}

pub(crate) struct OnFace {
    from: Vec<f64>,
    to: Vec<f64>,
}

impl OnFace {
    /// Returns the upper (`high`) or lower face of the box that is normal to `axis`.
    pub(crate) fn new(from: &[f64], to: &[f64], axis: usize, high: bool) -> Self {
        let (mut from, mut to) = (from.to_vec(), to.to_vec());
        if high {
            from[axis] = to[axis];
        } else {
            to[axis] = from[axis];
        }
        Self { from, to }
    }

    pub(crate) fn extent<'a>(&'a self, body: &SpaceTimeBox<'_>) -> SpaceTimeBox<'a> {
        SpaceTimeBox { from: &self.from, to: &self.to, start: body.start, end: body.end }
    }
}

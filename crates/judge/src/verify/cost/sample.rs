//! Levels of one method: error, work, converging part, Pareto front, and work to reach an error.
//!
//! Errors are interpolated in the converging part; elsewhere a small error may be accidental.

use std::ops::Range;

/// Error and work of one level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Spacing on the refined axis.
    pub spacing: f64,
    /// Error relative to the size of the solution.
    pub error: f64,
    /// Work: number of transfers, or seconds.
    pub work: f64,
    /// Whether the level may count for the verdict.
    pub usable: bool,
    /// Whether the judge uses the level in the fit of the order.
    pub asymptotic: bool,
    /// Whether the run failed.
    pub failed: bool,
}

impl Sample {
    /// Whether the level is usable, its run did not fail, and error and work are valid numbers.
    pub fn counts(&self) -> bool {
        let sound = self.error >= 0.0 && self.error.is_finite();
        self.usable && !self.failed && sound && self.work > 0.0 && self.work.is_finite()
    }

    pub(crate) fn has_logarithm(&self) -> bool {
        self.counts() && self.error > 0.0 && self.spacing > 0.0 && self.spacing.is_finite()
    }
}

/// Minimum order between neighbouring levels for which the error counts as decreasing.
const LEAST_ORDER: f64 = 0.2;

/// Minimum number of levels of a converging part: over two levels an error may decrease by chance.
const FEWEST: usize = 3;

/// Minimum ratio of an error to that of the previous level for which the error counts as growing.
const GROWS: f64 = 1.25;

/// A range of neighbouring levels over which the error decreases.
#[derive(Debug, Clone, PartialEq)]
pub struct ConvergingPart {
    /// Indices of the levels, from coarse to fine.
    pub levels: Range<usize>,
    /// Reason why the part ends.
    pub end: End,
}

/// Reason why a converging part ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// No finer level was run.
    Levels,
    /// The error stops decreasing.
    Floor,
    /// The error grows on the next level.
    Grows,
    /// The run of the next level failed.
    Failed,
    /// The next level does not count for the verdict.
    Crossings,
    /// There are no three consecutive levels over which the error decreases.
    NoTrend,
}

impl End {
    /// Describes the reason in tables.
    pub fn words(self) -> &'static str {
        match self {
            Self::Levels => "no finer level",
            Self::Floor => "floor",
            Self::Grows => "error grows",
            Self::Failed => "failed",
            Self::Crossings => "crossings",
            Self::NoTrend => "no trend",
        }
    }
}

impl ConvergingPart {
    /// Returns the converging part of levels sorted from coarse to fine, the one with the largest
    /// decrease of the error if there are several. Without one, `levels` is empty and `end` has the
    /// reason.
    pub fn of(samples: &[Sample]) -> Self {
        let mut best: Option<(f64, Range<usize>)> = None;
        let mut start = 0;
        for end in 1..=samples.len() {
            if end < samples.len() && falls(&samples[end - 1], &samples[end]) {
                continue;
            }
            if end - start >= FEWEST {
                let fall = samples[start].error / samples[end - 1].error;
                if best.as_ref().is_none_or(|(most, _)| fall > *most) {
                    best = Some((fall, start..end));
                }
            }
            start = end;
        }
        if let Some((_, levels)) = best {
            return Self { end: end(samples, levels.end), levels };
        }
        let broke = samples.iter().any(|one| one.failed);
        Self { levels: 0..0, end: if broke { End::Failed } else { End::NoTrend } }
    }
}

fn falls(coarse: &Sample, fine: &Sample) -> bool {
    if !(coarse.has_logarithm() && fine.has_logarithm()) {
        return false;
    }
    let refinement = libm::log(coarse.spacing / fine.spacing);
    libm::log(coarse.error / fine.error) >= LEAST_ORDER * refinement && refinement > 0.0
}

fn end(samples: &[Sample], next: usize) -> End {
    let Some(finer) = samples.get(next) else { return End::Levels };
    if finer.failed || !finer.error.is_finite() {
        End::Failed
    } else if !finer.usable {
        End::Crossings
    } else if finer.error > GROWS * samples[next - 1].error {
        End::Grows
    } else {
        End::Floor
    }
}

/// Minimum relative decrease of the error that justifies more work.
pub(super) const WORTH: f64 = 0.01;

/// Returns the indices of the samples on the Pareto front, from the least work.
pub fn pareto_front(samples: &[Sample]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..samples.len()).filter(|k| samples[*k].counts()).collect();
    let key = |k: usize| (samples[k].work, samples[k].error);
    order.sort_by(|a, b| {
        let ((work_a, error_a), (work_b, error_b)) = (key(*a), key(*b));
        work_a.total_cmp(&work_b).then(error_a.total_cmp(&error_b)).then(a.cmp(b))
    });
    let mut least = f64::INFINITY;
    order.retain(|k| {
        let better = samples[*k].error < least * (1.0 - WORTH);
        if better {
            least = samples[*k].error;
        }
        better
    });
    order
}

/// Work at which the error reaches a target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reach {
    /// The error is between two levels of the converging part, interpolated on logarithmic axes.
    At {
        /// Interpolated work.
        work: f64,
    },
    /// The coarsest level already reaches the error, so its work is an upper bound.
    Already {
        /// Work of the coarsest level.
        work: f64,
    },
    /// No level of the converging part reaches the error.
    Never,
}

impl Reach {
    /// Returns the work at which the levels, which converge over `part`, reach the error `target`.
    pub fn of(samples: &[Sample], part: &ConvergingPart, target: f64) -> Self {
        let mut counted = samples.iter().filter(|one| one.counts());
        let unbroken = samples.iter().all(|one| !one.failed);
        if let Some(first) = counted.next()
            && unbroken
            && first.error <= target
            && counted.all(|one| one.error <= target)
        {
            return Self::Already { work: first.work };
        }
        let levels = &samples[part.levels.clone()];
        let Some(k) = levels.iter().position(|one| one.error <= target) else {
            return Self::Never;
        };
        if k == 0 {
            return Self::Already { work: levels[0].work };
        }
        let (coarse, fine) = (&levels[k - 1], &levels[k]);
        let share = libm::log(coarse.error / target) / libm::log(coarse.error / fine.error);
        Self::At { work: coarse.work * libm::pow(fine.work / coarse.work, share) }
    }

    /// Returns the work at the error, if it is reached.
    pub fn work(&self) -> Option<f64> {
        match self {
            Self::At { work } | Self::Already { work } => Some(*work),
            Self::Never => None,
        }
    }
}

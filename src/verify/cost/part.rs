//! The converging part of a method: neighbouring levels over which its error falls.
//!
//! Between two of them an error may be interpolated; anywhere else it may be an accident (an error
//! that passes through zero, a floor that sways) which the next finer grid takes back.

use super::sample::Sample;
use std::ops::Range;

/// Least order between neighbours that is a fall.
const LEAST_ORDER: f64 = 0.2;

/// Two levels fall by chance: as many as the judge needs for an order before a floor.
const FEWEST: usize = 3;

/// An error that is this much larger than the level before grows; below, it sways on a floor.
const GROWS: f64 = 1.25;

/// Neighbouring levels over which the error falls.
#[derive(Debug, Clone, PartialEq)]
pub struct ConvergingPart {
    /// The levels, as indices from coarse to fine.
    pub levels: Range<usize>,
    /// Reason of its end.
    pub end: End,
}

/// Why a method goes no further.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// No finer level was run.
    Levels,
    /// The error falls no more.
    Floor,
    /// The error grows.
    Grows,
    /// The run broke.
    Failed,
    /// A level that does not count.
    Crossings,
    /// There are not three levels in a row over which the error falls.
    NoTrend,
}

impl End {
    /// In the words of tables.
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
    /// The converging part of levels from coarse to fine: of several the one with the largest fall.
    /// Empty if there is none; its end then says why.
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

/// Reason why the level `next` belongs to the part no more.
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

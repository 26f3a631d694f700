//! The work at which a method reaches an error.

use super::part::ConvergingPart;
use super::sample::Sample;

/// Where an error is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reach {
    /// Between two levels of the converging part, straight on logarithmic axes.
    At {
        /// The work.
        work: f64,
        /// The spacing.
        spacing: f64,
    },
    /// On the coarsest level that counts already, and perhaps for less.
    Already {
        /// Its work.
        work: f64,
        /// Its spacing.
        spacing: f64,
    },
    /// On no level of the converging part.
    Never,
}

impl Reach {
    /// Where levels from coarse to fine, converging over `part`, reach the error `target`.
    pub fn of(samples: &[Sample], part: &ConvergingPart, target: f64) -> Self {
        let mut counted = samples.iter().filter(|one| one.counts());
        let unbroken = samples.iter().all(|one| !one.failed);
        if let Some(first) = counted.next()
            && unbroken
            && first.error <= target
            && counted.all(|one| one.error <= target)
        {
            return Self::Already { work: first.work, spacing: first.spacing };
        }
        let levels = &samples[part.levels.clone()];
        let Some(k) = levels.iter().position(|one| one.error <= target) else {
            return Self::Never;
        };
        if k == 0 {
            return Self::Already { work: levels[0].work, spacing: levels[0].spacing };
        }
        let (coarse, fine) = (&levels[k - 1], &levels[k]);
        let share = libm::log(coarse.error / target) / libm::log(coarse.error / fine.error);
        let between = |a: f64, b: f64| a * libm::pow(b / a, share);
        Self::At {
            work: between(coarse.work, fine.work),
            spacing: between(coarse.spacing, fine.spacing),
        }
    }

    /// The work, if the error is reached.
    pub fn work(&self) -> Option<f64> {
        match self {
            Self::At { work, .. } | Self::Already { work, .. } => Some(*work),
            Self::Never => None,
        }
    }

    /// The spacing, if the error is reached.
    pub fn spacing(&self) -> Option<f64> {
        match self {
            Self::At { spacing, .. } | Self::Already { spacing, .. } => Some(*spacing),
            Self::Never => None,
        }
    }
}

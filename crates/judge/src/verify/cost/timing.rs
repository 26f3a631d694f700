//! Measured seconds: their spread, the machine, and a suite with timed levels.

use crate::verify::{Ranking, SuiteOutcome, rankings};

/// Work of a run, by kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Workload {
    /// Number of particle-node transfers.
    pub transfers: f64,
    /// Number of particles times number of steps.
    pub updates: f64,
    /// Number of steps.
    pub steps: f64,
}

/// Statistics of repeated measurements of one time (s).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timing {
    /// Median of the measurements (s).
    pub median: f64,
    /// Lower quartile (s).
    pub low: f64,
    /// Upper quartile (s).
    pub high: f64,
    /// Number of measurements.
    pub repeats: usize,
}

/// State of the machine during time measurements.
#[derive(Debug, Clone, PartialEq)]
pub struct Machine {
    /// Number of cores that the process may use.
    pub cores: usize,
    /// Load average over a minute, before and after, if the system reports it.
    pub load: Option<[f64; 2]>,
    /// Fraction of the time during which the measuring thread waited for a core. Measured seconds
    /// exclude this time, unless the system does not report it (`None`).
    pub waited: Option<f64>,
    /// Time (s) of a constant loop between measurements, whose spread is the noise of the machine.
    pub fixed_loop: Option<Timing>,
}

impl Timing {
    /// Computes median and quartiles; `None` without samples, or if one is not finite.
    pub fn of(samples: &[f64]) -> Option<Self> {
        if samples.is_empty() || samples.iter().any(|s| !s.is_finite()) {
            return None;
        }
        let mut sorted = samples.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let place = share * (sorted.len() - 1) as f64;
            let below = place as usize;
            let above = (below + 1).min(sorted.len() - 1);
            sorted[below] + (sorted[above] - sorted[below]) * (place - below as f64)
        };
        Some(Self { median: at(0.5), low: at(0.25), high: at(0.75), repeats: sorted.len() })
    }

    /// Returns the interquartile range divided by the median.
    pub fn spread(&self) -> f64 {
        (self.high - self.low) / self.median
    }
}

/// A suite with the measured times of its levels.
#[derive(Debug, Clone)]
pub struct TimedSuite {
    /// Results of the suite's cases and of their variants.
    pub outcome: SuiteOutcome,
    /// Workload and time of each level of each case; no time if the set-up failed. The time of a
    /// failed run ends at the failure.
    pub levels: Vec<Vec<(Workload, Option<Timing>)>>,
    /// State of the machine.
    pub machine: Machine,
}

impl TimedSuite {
    /// Ranks the cases by measured seconds.
    pub fn by_seconds(&self) -> Vec<Ranking> {
        rankings(&self.outcome.cases, |case, level, _| {
            self.timing(&case.case, level).map_or(f64::NAN, |timing| timing.median)
        })
    }

    /// Returns the measured time (s) of level number `level` of a case.
    pub fn timing(&self, case: &str, level: usize) -> Option<Timing> {
        let index = self.outcome.cases.iter().position(|known| known.case == case)?;
        self.levels.get(index)?.get(level)?.1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles() {
        let timing = Timing::of(&[5.0, 1.0, 3.0, 2.0, 4.0]).unwrap();
        assert_eq!((timing.low, timing.median, timing.high, timing.repeats), (2.0, 3.0, 4.0, 5));
        assert_eq!(timing.spread(), 2.0 / 3.0);
        let two = Timing::of(&[2.0, 1.0]).unwrap();
        assert_eq!((two.low, two.median, two.high), (1.25, 1.5, 1.75));
        let one = Timing::of(&[7.0]).unwrap();
        assert_eq!((one.low, one.median, one.high), (7.0, 7.0, 7.0));
    }

    #[test]
    fn no_measurements_give_no_time() {
        assert_eq!(Timing::of(&[]), None);
        assert_eq!(Timing::of(&[1.0, f64::NAN]), None);
    }
}

//! Measured seconds: their spread, the machine, and a suite with timed levels.

use super::model::{Model, Workload};
use super::ranking::{Ranking, by_transfers, rankings};
use crate::verify::order::fit::Interval;
use crate::verify::outcome::SuiteOutcome;

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
    /// Time (s) of a constant loop that runs between all other measurements. Its spread is the
    /// noise due to the clock frequency and other processes.
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
    /// Workload and time of each level of each case. The time is `None` if the set-up of the level
    /// failed. The time of a failed run ends at the failure.
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

    /// Ranks the cases by transfers.
    pub fn by_transfers(&self) -> Vec<Ranking> {
        by_transfers(&self.outcome.cases)
    }

    /// Returns the measured time (s) of level number `level` of a case.
    pub fn timing(&self, case: &str, level: usize) -> Option<Timing> {
        let index = self.outcome.cases.iter().position(|known| known.case == case)?;
        self.levels.get(index)?.get(level)?.1
    }

    /// Fits the cost model of a case to all its levels. Also returns a relative error: the finest
    /// level is predicted by a fit to the other levels.
    pub fn model(&self, case: usize) -> Option<(Model, Option<f64>)> {
        let levels = self.levels.get(case)?.iter();
        let runs: Vec<(Workload, f64)> =
            levels.filter_map(|(load, timing)| Some((*load, timing.as_ref()?.median))).collect();
        let off = runs.split_last().and_then(|((finest, seconds), coarser)| {
            Some(Model::fit(coarser)?.predict(finest) / seconds - 1.0)
        });
        Some((Model::fit(&runs)?, off))
    }
}

/// The most accurate setting whose predicted time is within a budget, with its measured result.
#[derive(Debug, Clone, PartialEq)]
pub struct BestCandidate {
    /// Time budget (s).
    pub budget: f64,
    /// Name of the case whose method is chosen.
    pub case: String,
    /// Cells along the first axis.
    pub cells: u64,
    /// Time step (s).
    pub dt: f64,
    /// Particles per cell.
    pub ppc: Option<u64>,
    /// Predicted and measured time (s) of all steps.
    pub seconds: [f64; 2],
    /// Predicted and measured error relative to the size of the solution.
    pub error: (Interval, f64),
    /// Whether the setting is finer than all levels of the suite.
    pub beyond: bool,
    /// Reason why no finer setting was considered, if the budget is not the reason.
    pub limit: Option<String>,
    /// Reason why the run ended early, if it did.
    pub failure: Option<String>,
    /// Cost model of the prediction.
    pub model: Model,
    /// Number of levels in the fit of the cost model.
    pub fitted: usize,
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

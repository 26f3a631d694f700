//! A suite whose levels have been timed.

use super::model::{Model, Workload};
use super::ranking::{Ranking, by_transfers, rankings};
use super::timing::{Machine, Timing};
use crate::verify::order::fit::Interval;
use crate::verify::outcome::SuiteOutcome;

/// A suite with the seconds of its levels.
#[derive(Debug, Clone)]
pub struct TimedSuite {
    /// Results. Cases besides the suite's own are variants of them.
    pub outcome: SuiteOutcome,
    /// For each case and level what it has to do, and how long that took; none of what could not be
    /// set up. A run that broke took as long as until then.
    pub levels: Vec<Vec<(Workload, Option<Timing>)>>,
    /// Where.
    pub machine: Machine,
}

impl TimedSuite {
    /// The rankings by seconds.
    pub fn by_seconds(&self) -> Vec<Ranking> {
        rankings(&self.outcome.cases, |case, level, _| {
            self.timing(&case.case, level).map_or(f64::NAN, |timing| timing.median)
        })
    }

    /// The rankings by transfers.
    pub fn by_transfers(&self) -> Vec<Ranking> {
        by_transfers(&self.outcome.cases)
    }

    /// How long a level took.
    pub fn timing(&self, case: &str, level: usize) -> Option<Timing> {
        let index = self.outcome.cases.iter().position(|known| known.case == case)?;
        self.levels.get(index)?.get(level)?.1
    }

    /// The cost model of a case, and how far it is off at the finest level when it is fitted to the
    /// others only: a prediction before that level runs.
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

/// The most accurate setting that a cost model predicts to be done within a budget, and what came.
#[derive(Debug, Clone, PartialEq)]
pub struct BestCandidate {
    /// The budget (s).
    pub budget: f64,
    /// The method.
    pub case: String,
    /// Cells along the first axis.
    pub cells: u64,
    /// Time step (s).
    pub dt: f64,
    /// Particles per cell.
    pub ppc: Option<u64>,
    /// Seconds of the steps, predicted and measured.
    pub seconds: [f64; 2],
    /// Error over the size of the solution: predicted, and measured.
    pub error: (Interval, f64),
    /// Whether the setting is finer than all levels that the suite lists.
    pub beyond: bool,
    /// Why nothing finer was considered, if that is not for the budget.
    pub limit: Option<String>,
    /// Why the run ended early, if it did.
    pub failure: Option<String>,
    /// The model that predicted.
    pub model: Model,
    /// Levels that the model was fitted to.
    pub fitted: usize,
}

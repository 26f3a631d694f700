//! Runs a suite with a study of any kind.

use super::cache::ResultCache;
use super::kind::{CaseRunner, Progress, RunContext, StepWarning, statement, study};
use super::preflight::{UNKNOWN, estimates};
use super::time_series::{SeriesError, SeriesFile, time_series};
use crate::external::SolverFactory;
use crate::suite::Extent;
use crate::suite::model::Suite;
use crate::suite::model::fingerprint::fingerprint;
use crate::verify::{CaseOutcome, SuiteOutcome};
use rayon::prelude::*;
use std::io;
use std::str::FromStr;

/// Runs the cases of one suite.
pub struct Runner<'a> {
    suite: &'a Suite,
    context: RunContext<'a>,
    cases: Box<dyn CaseRunner + 'a>,
}

impl<'a> Runner<'a> {
    /// Creates a runner of the usual levels ([`Extent::Usual`]), without starting any run.
    pub fn new(suite: &'a Suite) -> Self {
        Self::over(suite, Extent::Usual)
    }

    /// Creates a runner of the levels in `extent`.
    pub fn over(suite: &'a Suite, extent: Extent) -> Self {
        let (name, fingerprint) = (suite.name.as_str(), suite.fingerprint);
        let (cache, solver, repeat) = (None, None, 1);
        Self::with(suite, RunContext { suite: name, fingerprint, extent, cache, repeat, solver })
    }

    /// Sets the solver for the cases of [`Suite::of_external`], whose method is external.
    #[must_use]
    pub fn judging(self, solver: &'a dyn SolverFactory) -> Self {
        Self::with(self.suite, RunContext { solver: Some(solver), ..self.context })
    }

    /// Stores finished levels in a cache, and reuses stored ones.
    #[must_use]
    pub fn keeping(self, cache: Option<&'a ResultCache>) -> Self {
        Self::with(self.suite, RunContext { cache, ..self.context })
    }

    /// Runs each level of a convergence study `count` times and reports the spread of the runs; 0
    /// or 1 means one run without a spread. An external solver starts a new process each time. The
    /// cache is then neither read nor written.
    #[must_use]
    pub fn repeating(self, count: usize) -> Self {
        Self::with(self.suite, RunContext { repeat: count.max(1), ..self.context })
    }

    fn with(suite: &'a Suite, context: RunContext<'a>) -> Self {
        Self { suite, context, cases: study(suite).runner(context) }
    }

    /// Returns the number of progress units of all cases together.
    pub fn units(&self) -> u64 {
        self.cases.units()
    }

    /// Returns warnings, found without a run, about time steps that are longer than the predicted
    /// stable step or differ from the requested step.
    pub fn warnings(&self) -> Vec<StepWarning> {
        let text = |warning: &StepWarning| format!("{}::{}", self.suite.name, warning.text);
        let named = |warning| StepWarning { text: text(&warning), ..warning };
        self.cases.warnings().into_iter().map(named).collect()
    }

    /// Runs all cases in parallel. The outcomes are in suite order and do not depend on the number
    /// of threads.
    pub fn run(&self, progress: Progress<'_>) -> SuiteOutcome {
        let count = self.suite.case_names().len();
        self.outcome((0..count).into_par_iter().map(|i| self.case(i, progress)).collect())
    }

    /// Creates the outcome of the suite from the outcomes of its cases.
    pub fn outcome(&self, cases: Vec<CaseOutcome>) -> SuiteOutcome {
        let statement = statement(self.suite);
        let words: Vec<String> =
            statement.iter().map(|(key, value)| format!("{key}\n{value}\n")).collect();
        SuiteOutcome {
            suite: self.suite.name.clone(),
            group: self.suite.group.clone(),
            title: self.suite.title.clone(),
            source: self.suite.source.clone(),
            about: self.suite.about.trim().to_owned(),
            meaning: fingerprint(words.concat().as_bytes()),
            statement,
            cases,
        }
    }

    /// Runs a case again and passes its particles and grid over time to `write`, as files for
    /// ParaView. The level (or row) is the first one that failed in `outcome` or whose energy grew,
    /// otherwise the finest level (or last row).
    ///
    /// # Errors
    /// [`SeriesError`] if the case has no run to write, or `write` returns an error.
    pub fn time_series(
        &self,
        outcome: &CaseOutcome,
        write: &mut dyn FnMut(&SeriesFile) -> io::Result<()>,
    ) -> Result<(), SeriesError> {
        let known = self.suite.case_names().into_iter().position(|name| name == outcome.case);
        let index = known.ok_or("there is no such case")?;
        let name = format!("{}/{}", self.suite.name, outcome.case);
        self.cases.shown(index, outcome, &mut |run| time_series(&name, run, write))
    }

    /// Runs the case number `index`.
    ///
    /// # Panics
    /// If there is no case with this index.
    pub fn case(&self, index: usize, progress: Progress<'_>) -> CaseOutcome {
        self.cases.case(index, progress)
    }
}

/// Maximum number of parts into which a run can be divided.
const MOST: usize = 10_000;

/// Predicted time (s) of a case, excluding its steps.
const SET_UP: f64 = 1e-3;

/// One of several parts of a run, such as `2/5`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    number: usize,
    count: usize,
}

/// Error for a text that does not have the form `K/N`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("expected a number and a count, such as `2/5`, up to {MOST}")]
pub struct ShardError;

impl FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Self, ShardError> {
        let parts = text.split_once('/').map(|(number, count)| (number.parse(), count.parse()));
        match parts {
            Some((Ok(number), Ok(count))) if (1..=count).contains(&number) && count <= MOST => {
                Ok(Self { number, count })
            }
            _ => Err(ShardError),
        }
    }
}

impl Shard {
    /// Returns the cases of `suites` in this part; suites without such a case are excluded. The
    /// most expensive remaining case is always assigned to the part with the lowest cost so far. By
    /// this rule, no part takes more than 4/3 of the time in the best division (Graham 1969, SIAM
    /// J. Appl. Math. 17, 416). All parts compute the same assignment.
    pub fn of(self, suites: &[Suite], extent: Extent) -> Vec<Suite> {
        let costs: Vec<Vec<f64>> = suites.iter().map(|suite| seconds(suite, extent)).collect();
        let mut all: Vec<(usize, usize)> = Vec::new();
        for (suite, costs) in costs.iter().enumerate() {
            all.extend((0..costs.len()).map(|case| (suite, case)));
        }
        let cost = |(suite, case): (usize, usize)| costs[suite][case];
        all.sort_by(|a, b| cost(*b).total_cmp(&cost(*a)).then(a.cmp(b)));
        let mut loads = vec![0.0; self.count];
        let mut own: Vec<Vec<bool>> = costs.iter().map(|costs| vec![false; costs.len()]).collect();
        for at in all {
            let least = (0..self.count).min_by(|a, b| f64::total_cmp(&loads[*a], &loads[*b]));
            let least = least.unwrap_or(0);
            loads[least] += cost(at);
            own[at.0][at.1] = least + 1 == self.number;
        }
        let parts = suites.iter().zip(&own).filter(|(_, own)| own.contains(&true));
        parts.map(|(suite, own)| suite.only(&|case| own[case])).collect()
    }
}

fn seconds(suite: &Suite, extent: Extent) -> Vec<f64> {
    let predicted = estimates(suite, extent).into_iter();
    predicted.map(|cost| SET_UP + cost.map_or(UNKNOWN, |cost| cost.seconds)).collect()
}

//! The interface of all kinds of study, and the list of kinds.

use super::cache::ResultCache;
use super::describe::{Dispensable, Rows, head};
use super::time_series::{SeriesError, ShownRun};
use crate::external::{ProblemNeeds, SolverFactory};
use crate::subject::{Profile, SubjectError};
use crate::suite::model::refine_plan::Extent;
use crate::suite::model::{StudyPlan, Suite};
use crate::verify::CaseOutcome;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Callback that is called after each finished unit of work: a level, a row or a case.
pub type Progress<'a> = &'a (dyn Fn() + Sync);

pub(crate) trait Study {
    fn statement(&self) -> Rows;

    /// Returns the capabilities that an external solver needs; `None` if none can run the study.
    fn needs(&self) -> Option<ProblemNeeds> {
        None
    }

    /// Returns the profile of a step on the coarsest level; `None` if there is none.
    fn profile(&self, _case: usize, _without: Option<Dispensable>) -> Option<Profile> {
        None
    }

    fn runner<'a>(&'a self, context: RunContext<'a>) -> Box<dyn CaseRunner + 'a>;
}

/// Warning about the time step of a level, found before anything runs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StepWarning {
    /// Index of the case.
    pub case: usize,
    /// Text of the warning.
    pub text: String,
    /// Whether the step is too long. A suite may use such a step deliberately.
    pub is_too_long: bool,
}

pub(crate) type ShowRun<'a> = &'a mut dyn FnMut(ShownRun<'_>) -> Result<(), SeriesError>;

pub(crate) trait CaseRunner: Send + Sync {
    fn units(&self) -> u64;

    /// Returns the warnings that are found without a run. Their texts do not name the suite.
    fn warnings(&self) -> Vec<StepWarning> {
        Vec::new()
    }

    /// Passes the first run that failed or gained energy, or else the last run, to the callback.
    fn shown(&self, _: usize, _: &CaseOutcome, _: ShowRun<'_>) -> Result<(), SeriesError> {
        Err("its study has no runs to show".into())
    }

    fn case(&self, index: usize, progress: Progress<'_>) -> CaseOutcome;
}

#[derive(Clone, Copy)]
pub(crate) struct RunContext<'a> {
    pub(crate) suite: &'a str,
    pub(crate) fingerprint: u64,
    pub(crate) extent: Extent,
    pub(crate) cache: Option<&'a ResultCache>,
    /// Number of times that each level of a convergence study runs.
    pub(crate) repeat: usize,
    pub(crate) solver: Option<&'a dyn SolverFactory>,
}

pub(crate) struct PlanRunner<'a, P> {
    pub(crate) plan: &'a P,
    pub(crate) context: RunContext<'a>,
}

impl RunContext<'_> {
    /// Returns the cached result of `key`, called `name` in messages, or caches that of `run`. A
    /// result of an external solver is not cached if `broken` returns true: the solver may succeed
    /// next time.
    pub(crate) fn cached<T: Serialize + DeserializeOwned>(
        &self,
        key: &str,
        name: &str,
        broken: impl FnOnce(&T) -> bool,
        run: impl FnOnce() -> Result<T, SubjectError>,
    ) -> Result<T, SubjectError> {
        let Some(cache) = self.cache else { return run() };
        let solver = match self.solver.map(SolverFactory::identity) {
            None => String::new(),
            Some(Some(identity)) => format!(" {identity:016x}"),
            // A solver that reports no identity may have changed since the result was cached.
            Some(None) => return run(),
        };
        let mut uncached = None;
        let run = || {
            let result = run()?;
            if self.solver.is_none() || !broken(&result) {
                return Ok(result);
            }
            uncached = Some(result);
            Err(SubjectError::Unsupported(String::new()))
        };
        let result = cache.level(&format!("{key}{solver}"), name, run);
        uncached.map_or(result, Ok)
    }
}

pub(crate) fn study(suite: &Suite) -> &dyn Study {
    match &suite.study {
        StudyPlan::Convergence(plan) => plan.as_ref(),
        StudyPlan::InternalForce(plan) => plan.as_ref(),
        StudyPlan::Stability(plan) => plan.as_ref(),
        StudyPlan::Gradient(plan) => plan.as_ref(),
        StudyPlan::Spectrum(plan) => plan.as_ref(),
    }
}

/// Returns the capabilities that a suite requires of a solver; `None` if its study cannot be passed
/// to an external solver.
pub fn needs_of_suite(suite: &Suite) -> Option<ProblemNeeds> {
    study(suite).needs()
}

/// Returns the rows of name and value that describe the problem of a suite, for reports.
pub fn statement(suite: &Suite) -> Vec<(String, String)> {
    let mut rows = head(suite);
    rows.extend(study(suite).statement());
    rows
}

/// Returns the profile of a step of the case `name` on the coarsest level, optionally without one
/// effect. `None` for a case without levels, or if the solver reports no profile.
pub fn profile(suite: &Suite, name: &str, without: Option<Dispensable>) -> Option<Profile> {
    let case = suite.case_names().into_iter().position(|case| case == name)?;
    study(suite).profile(case, without)
}

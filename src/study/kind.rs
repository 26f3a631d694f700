//! Kinds of study: the interface of each, and the list of all.

use super::cache::ResultCache;
use super::describe::Dispensable;
use super::describe::statement::{Rows, head};
use super::time_series::{SeriesError, ShownRun};
use crate::external::{ProblemNeeds, SolverFactory};
use crate::subject::{Profile, SubjectError};
use crate::suite::model::StudyPlan;
use crate::suite::model::gradient::GradientPlan;
use crate::suite::model::refine_plan::Extent;
use crate::suite::model::spectrum::SpectrumPlan;
use crate::suite::model::stability::StabilityPlan;
use crate::suite::model::{ConvergencePlan, ForcePlan, Suite};
use crate::verify::CaseOutcome;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::any::Any;

/// Callback after each unit of work that is done: a level, a row or a case.
pub type Progress<'a> = &'a (dyn Fn() + Sync);

/// A plan whose cases can be stated and run.
pub(crate) trait Study: StudyPlan {
    /// Rows of name and value that state the study.
    fn statement(&self) -> Rows;

    /// Capabilities that it requires of an external solver; `None` if no external solver can run
    /// the study.
    fn needs(&self) -> Option<ProblemNeeds> {
        None
    }

    /// Profile of a step of the case with this index on the coarsest level, optionally without one
    /// effect; `None` for a study without levels, or if the subject gives none.
    fn profile(&self, _case: usize, _without: Option<Dispensable>) -> Option<Profile> {
        None
    }

    /// Runner of the cases. It does not start any run.
    fn runner<'a>(&'a self, context: RunContext<'a>) -> Box<dyn CaseRunner + 'a>;
}

/// Warning about the time step of a level, before anything runs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StepWarning {
    /// Index of the case.
    pub case: usize,
    /// Text of the warning.
    pub text: String,
    /// Whether the step is too long. A suite may intend this, with an expectation of it.
    pub is_too_long: bool,
}

/// Callback that shows a run.
pub(crate) type ShowRun<'a> = &'a mut dyn FnMut(ShownRun<'_>) -> Result<(), SeriesError>;

/// Runs the cases of one study.
pub(crate) trait CaseRunner: Send + Sync {
    /// Units of progress of all cases.
    fn units(&self) -> u64;

    /// Warnings that need no run, without the name of the suite.
    fn warnings(&self) -> Vec<StepWarning> {
        Vec::new()
    }

    /// Calls `then` with the most informative run of a case: the first one that failed or grew in
    /// `outcome`, or the last one.
    ///
    /// # Errors
    /// The errors of `then`, or one line with the reason why there is no such run.
    fn shown(&self, _: usize, _: &CaseOutcome, _: ShowRun<'_>) -> Result<(), SeriesError> {
        Err("its study has no runs to show".into())
    }

    /// Runs the case with this index.
    fn case(&self, index: usize, progress: Progress<'_>) -> CaseOutcome;
}

/// All inputs of the runs of a suite in addition to its plan.
#[derive(Clone, Copy)]
pub(crate) struct RunContext<'a> {
    /// Name of the suite.
    pub(crate) suite: &'a str,
    /// Hash of its text.
    pub(crate) fingerprint: u64,
    /// Levels that run.
    pub(crate) extent: Extent,
    /// Results of earlier runs.
    pub(crate) cache: Option<&'a ResultCache>,
    /// Number of times that each level of a convergence study runs.
    pub(crate) repeat: usize,
    /// The solver of cases whose method is not of this crate.
    pub(crate) solver: Option<&'a dyn SolverFactory>,
}

impl RunContext<'_> {
    /// The cached result of `key`, which messages call `name`, or that of `run`, which is then
    /// cached. A result of an external solver is not cached if it is `broken`: a solver that fails,
    /// or does not answer in time, may succeed the next time.
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
            // A solver without an identity may be another one the next time.
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

/// Downcast of a plan to a study of one kind.
type AsStudy = for<'a> fn(&'a (dyn StudyPlan + 'static)) -> Option<&'a dyn Study>;

/// Every kind of study.
const KINDS: [AsStudy; 5] = [
    of::<ConvergencePlan>,
    of::<ForcePlan>,
    of::<StabilityPlan>,
    of::<GradientPlan>,
    of::<SpectrumPlan>,
];

fn of<'a, P: Study>(plan: &'a (dyn StudyPlan + 'static)) -> Option<&'a dyn Study> {
    let plan: &dyn Any = plan;
    plan.downcast_ref::<P>().map(|plan| plan as &dyn Study)
}

/// The study of a suite.
///
/// # Panics
/// If the kind of the plan is not in [`KINDS`].
pub(crate) fn study(suite: &Suite) -> &dyn Study {
    let found = KINDS.iter().find_map(|kind| kind(suite.study.as_ref()));
    found.unwrap_or_else(|| panic!("`{}` is of a kind of study that is not listed", suite.name))
}

/// Rows of name and value that state the problem of a suite, for reports.
pub fn statement(suite: &Suite) -> Vec<(String, String)> {
    let mut rows = head(suite);
    rows.extend(study(suite).statement());
    rows
}

/// Profile of a step of the case named `name` on the coarsest level, optionally without one effect;
/// `None` for a case without levels, or if the subject gives none.
pub fn profile(suite: &Suite, name: &str, without: Option<Dispensable>) -> Option<Profile> {
    let case = suite.case_names().into_iter().position(|case| case == name)?;
    study(suite).profile(case, without)
}

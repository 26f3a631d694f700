//! Finds the most accurate setting whose run finishes within a time budget (s).
//!
//! For every method, the time of its finest level predicts the finest grid within the budget, and
//! the errors of its levels predict the error on that grid. Errors on grids finer than the levels
//! of the suite are predicted only if the method still converges. The best method then runs on
//! increasingly fine grids, until a grid twice as fine as the last one would exceed the budget. The
//! times of these runs give a cost model, and their errors are judged together with those of the
//! suite. If the new prediction is worse than that of another method, the other method is tried
//! too. The best of the tried methods runs on the finest grid within the budget.
//!
//! Methods are compared by the upper bounds of their predicted errors.

use super::candidate::{Candidate, REACH, candidate, run};
use super::measure::seconds;
use crate::study::runner::Runner;
use crate::subject::SubjectError;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{ConvergencePlan, Suite};
use crate::verify::{Axis, BestCandidate, Interval, Model, Workload, by_transfers};
use thiserror::Error;

/// Number of runs, counted from the finest, in the fit of a cost model.
const FITTED: usize = 6;

const REPEATS: usize = 3;

/// Fraction of the budget above which a run is measured only once.
const LONG: f64 = 0.05;

/// Reason why no setting was chosen for a budget.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum BudgetError {
    /// The suite has no levels.
    #[error("the suite refines nothing")]
    NoLevels,
    /// The suite refines another axis than its cells.
    #[error("the suite does not refine its cells")]
    NotInSpace,
    /// No error of the suite can be related to the size of its solution.
    #[error("none of its errors has a scale")]
    NoScale,
    /// No method has an error that can be extrapolated.
    #[error("no error is predicted: no method converges on three levels")]
    NoPrediction,
    /// Every prediction exceeds the budget.
    #[error("no setting is predicted to run within {budget} s; the fastest takes {least:.2e} s")]
    TooShort {
        /// The budget (s).
        budget: f64,
        /// Smallest predicted time of a level (s).
        least: f64,
    },
    /// A level could not be set up.
    #[error(transparent)]
    NoRun(#[from] SubjectError),
}

/// Chooses a setting of `suite` for a budget (s), runs it, and returns the result.
///
/// # Errors
/// [`BudgetError`] if no setting can be chosen.
pub fn best_candidate(suite: &Suite, budget: f64) -> Result<BestCandidate, BudgetError> {
    let Some(plan) = suite.plan::<ConvergencePlan>() else {
        return Err(BudgetError::NoLevels);
    };
    if plan.refine.axis != Axis::Space {
        return Err(BudgetError::NotInSpace);
    }
    let cases = Runner::new(suite).run(&|| ()).cases;
    let ranked = by_transfers(&cases);
    let ranking = ranked.first().ok_or(BudgetError::NoScale)?;
    let candidates: Vec<Candidate> =
        ranking.rows.iter().filter_map(|ranked| candidate(plan, &cases, ranked)).collect();
    if candidates.is_empty() {
        return Err(BudgetError::NoPrediction);
    }
    let mut least = f64::INFINITY;
    let mut open = Vec::new();
    for candidate in candidates {
        let Ok((model, cheapest)) = candidate.rough_model() else { continue };
        least = least.min(cheapest);
        open.extend(Setting::of(candidate, (model, None), budget));
    }
    let none = BudgetError::TooShort { budget, least };
    loop {
        let most = |setting: &Setting| setting.error.high;
        let best = (0..open.len()).min_by(|a, b| most(&open[*a]).total_cmp(&most(&open[*b])));
        let best = open.swap_remove(best.ok_or_else(|| none.clone())?);
        if let (model, Some(fitted)) = best.model {
            return best.run(suite, model, fitted, budget, ranking.size);
        }
        let (candidate, runs) = best.candidate.judged_within(suite, budget)?;
        let fitted = &runs[runs.len().saturating_sub(FITTED)..];
        let model = Model::fit(fitted).ok_or_else(|| none.clone())?;
        open.extend(Setting::of(candidate, (model, Some(fitted.len())), budget));
    }
}

/// A method and the finest grid that it can compute within the budget.
struct Setting {
    candidate: Candidate,
    /// Cost model, and the number of runs in its fit; `None` before the method has run.
    model: (Model, Option<usize>),
    level: LevelPlan,
    error: Interval,
}

impl Setting {
    /// Finds the finest grid of `candidate` within the budget; `None` if there is none.
    fn of(candidate: Candidate, model: (Model, Option<usize>), budget: f64) -> Option<Self> {
        let level = candidate.finest_within(&model.0, budget)?;
        let error = candidate.error.at(level.h)?;
        Some(Self { candidate, model, level, error })
    }

    fn run(
        self,
        suite: &Suite,
        model: Model,
        fitted: usize,
        budget: f64,
        size: f64,
    ) -> Result<BestCandidate, BudgetError> {
        let Self { candidate, level, error, .. } = self;
        let predicted = candidate.load(level).map_or(f64::NAN, |load| model.predict(&load));
        let took = seconds(&candidate.plan, &candidate.case, level)?;
        let mut plan = candidate.plan.clone();
        plan.refine.levels = vec![level];
        plan.refine.usual = 1;
        let outcome = run(suite, plan);
        let study =
            outcome.convergence().ok_or_else(|| SubjectError::from(outcome.reason.clone()))?;
        let found = study.levels.first().ok_or(BudgetError::NoLevels)?;
        let listed = suite.plan::<ConvergencePlan>().map(|plan| &plan.refine.levels);
        Ok(BestCandidate {
            budget,
            case: candidate.case.name.clone(),
            cells: level.cells,
            dt: found.dt,
            ppc: found.ppc,
            seconds: [predicted, took],
            error: (error, found.error / size),
            beyond: listed.is_some_and(|all| all.iter().all(|one| one.cells < level.cells)),
            limit: candidate.limit(level),
            failure: found.run.failure.clone(),
            model,
            fitted,
        })
    }
}

impl Candidate {
    /// Runs the candidate on increasingly fine levels and adds their errors to it. Returns the
    /// candidate and the times of the levels.
    fn judged_within(
        self,
        suite: &Suite,
        budget: f64,
    ) -> Result<(Self, Vec<(Workload, f64)>), BudgetError> {
        let listed = &self.study.levels[self.ranked.part.levels.clone()];
        let mut cells: Vec<u64> = listed.iter().map(|level| level.cells).collect();
        let listed = cells.len();
        let mut runs = Vec::new();
        loop {
            let next = runs.len();
            if next == cells.len() {
                // With a ratio above 1.5, three levels in 3-D would be too expensive.
                let grown = (cells[next - 1] as f64 * 1.5 / self.stride as f64) as u64;
                cells.push((grown * self.stride).max(cells[next - 1] + self.stride));
            }
            let level = self.level(cells[next]);
            if cells[next] > self.most_cells() || level.too_large(&self.plan.scene).is_some() {
                break;
            }
            let Some(load) = self.load(level) else { break };
            let took = median(LONG * budget, || seconds(&self.plan, &self.case, level))?;
            runs.push((load, took));
            let Some(rough) = Model::fit(&[(load, took)]) else { break };
            let farthest = self.load(self.level(cells[next].saturating_mul(REACH)));
            if !farthest.is_some_and(|load| rough.predict(&load) <= budget) {
                break;
            }
        }
        let finer = cells.get(listed..runs.len()).unwrap_or_default();
        if finer.is_empty() {
            return Ok((Self { reach: REACH, ..self }, runs));
        }
        let judged = self.judged_with(suite, finer).ok_or(BudgetError::NoScale)?;
        Ok((judged, runs))
    }
}

/// Returns the median of several measured times, or the first time if it exceeds `long` (s).
fn median(
    long: f64,
    mut time: impl FnMut() -> Result<f64, SubjectError>,
) -> Result<f64, SubjectError> {
    let first = time()?;
    if first >= long {
        return Ok(first);
    }
    let mut all = vec![first];
    for _ in 1..REPEATS {
        all.push(time()?);
    }
    all.sort_by(f64::total_cmp);
    Ok(all[REPEATS / 2])
}

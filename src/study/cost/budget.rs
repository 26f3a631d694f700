//! The most accurate setting that is done within a budget of seconds.
//!
//! For every method, the time of its finest level predicts the finest grid within the budget, and
//! the errors of its levels predict the error there. Only a method that still converges is
//! extrapolated beyond the levels of the suite. The best method is then run on finer and finer
//! grids, until a grid twice as fine as the last one exceeds the budget. These runs give a cost
//! model, and their errors are judged together with those of the suite. If the new prediction is
//! worse than that of another method, this method is tried too. The best method of those tried is
//! run at the finest grid within the budget.
//!
//! Methods are compared by the upper ends of their errors.

use super::candidate::{Candidate, REACH, candidate, run};
use super::measure::seconds;
use crate::study::runner::Runner;
use crate::subject::SubjectError;
use crate::suite::compile::check::size::too_large;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{ConvergencePlan, Suite};
use crate::verify::{Axis, BestCandidate, Interval, Model, Workload, by_transfers};
use thiserror::Error;

/// Number of finest runs to which a model is fitted: coarse runs are not representative of long
/// runs.
const FITTED: usize = 6;

/// Repeats of each,
const REPEATS: usize = 3;

/// unless it takes this share of the budget: then it is run once.
const LONG: f64 = 0.05;

/// Reason why no setting is chosen for a budget.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum BudgetError {
    /// The suite has no levels.
    #[error("the suite refines nothing")]
    NoLevels,
    /// The suite refines something other than its cells.
    #[error("the suite does not refine its cells")]
    NotInSpace,
    /// No error of the suite can be compared with the size of its solution.
    #[error("none of its errors has a scale")]
    NoScale,
    /// The error of no method can be extrapolated.
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
/// [`BudgetError`] if nothing can be chosen.
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

/// A method on the finest grid within the budget.
struct Setting {
    candidate: Candidate,
    /// Cost model, and the number of runs to which it is fitted; `None` before the method is tried.
    model: (Model, Option<usize>),
    level: LevelPlan,
    error: Interval,
}

impl Setting {
    /// None if no grid is within the budget.
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
    /// The candidate with the errors of finer and finer levels, and their times.
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
                // In space three levels are a long way.
                let grown = (cells[next - 1] as f64 * 1.5 / self.stride as f64) as u64;
                cells.push((grown * self.stride).max(cells[next - 1] + self.stride));
            }
            let level = self.level(cells[next]);
            if cells[next] > self.most_cells() || too_large(&self.plan.scene, level).is_some() {
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

/// The median of several times, or the first one if it is long.
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

//! The most accurate setting that is done within a budget of seconds.
//!
//! For every method the seconds of its finest level predict the finest grid within the budget, and
//! its order the error there; only a method that still converges is taken beyond the levels that
//! the suite lists. The best one is then measured on ever finer grids, until one takes a twentieth
//! of the budget; a cost model is fitted, the grid chosen, and run.

use super::candidate::{Candidate, candidate};
use super::measure::seconds;
use crate::study::runner::Runner;
use crate::suite::compile::check::size::too_large;
use crate::suite::model::refine_plan::{Extent, LevelPlan};
use crate::suite::model::{ConvergencePlan, Suite};
use crate::verify::{Axis, BestCandidate, CaseOutcome, LevelOutcome, Model, Workload, rankings};
use std::sync::Arc;

/// The largest run that a model is fitted to takes this share of the budget at least, so that
/// predictions do not reach far.
const SHARE: f64 = 0.05;

/// Runs that a model is fitted to: the finest ones, the others say little of a long run.
const FITTED: usize = 6;

/// Repeats of each.
const REPEATS: usize = 3;

/// Chooses a setting of `suite` for a budget of so many seconds, runs it, and says what came.
///
/// # Errors
/// One line that says why nothing can be chosen.
pub fn best_candidate(suite: &Suite, budget: f64) -> Result<BestCandidate, String> {
    let Some(plan) = suite.plan::<ConvergencePlan>() else {
        return Err("the suite refines nothing".to_owned());
    };
    if plan.refine.axis != Axis::Space {
        return Err("the suite does not refine its cells".to_owned());
    }
    let cases = Runner::new(suite).run(&|| ()).cases;
    let transfers =
        |_: &CaseOutcome, _: usize, level: &LevelOutcome| level.run.counters.transfers as f64;
    let ranked = rankings(&cases, transfers);
    let ranking = ranked.first().ok_or("no error of it has a size to be compared with")?;
    let candidates: Vec<Candidate<'_>> =
        ranking.rows.iter().filter_map(|ranked| candidate(plan, &cases, ranked)).collect();
    let mut best: Option<(f64, &Candidate<'_>)> = None;
    let mut least = f64::INFINITY;
    for candidate in &candidates {
        let Ok((model, cheapest)) = candidate.rough_model() else { continue };
        least = least.min(cheapest);
        let Some(level) = candidate.finest_within(&model, budget) else { continue };
        let Some(error) = candidate.error(level.h) else { continue };
        if best.as_ref().is_none_or(|(known, _)| error < *known) {
            best = Some((error, candidate));
        }
    }
    let none =
        || format!("nothing is predicted to be done in {budget} s; the least is {least:.2e} s");
    let (_, chosen) = best.ok_or_else(none)?;
    let runs = chosen.ladder(budget)?;
    let model = Model::fit(&runs[runs.len().saturating_sub(FITTED)..]).ok_or_else(none)?;
    let level = chosen.finest_within(&model, budget).ok_or_else(none)?;
    chosen.run(suite, &model, runs.len().min(FITTED), level, budget, ranking.size)
}

impl Candidate<'_> {
    /// Ever finer levels with the seconds that they take, up to a share of the budget.
    fn ladder(&self, budget: f64) -> Result<Vec<(Workload, f64)>, String> {
        let listed = &self.study.levels[self.ranked.part.levels.clone()];
        let mut cells: Vec<u64> = listed.iter().map(|level| level.cells).collect();
        let mut runs = Vec::new();
        let mut next = 0;
        loop {
            let level = self.level(cells[next]);
            let Some(load) = self.load(level) else { break };
            let took = median(|| seconds(self.plan, self.case, level))?;
            runs.push((load, took));
            let Some(rough) = Model::fit(&[(load, took)]) else { break };
            next += 1;
            if next == cells.len() {
                // In space three levels are a long way.
                let grown = (cells[next - 1] as f64 * 1.5 / self.stride as f64) as u64;
                cells.push((grown * self.stride).max(cells[next - 1] + self.stride));
            }
            let finer = self.level(cells[next]);
            let predicted = self.load(finer).map(|load| rough.predict(&load));
            let small = predicted.is_some_and(|seconds| seconds <= 0.5 * budget);
            if took >= SHARE * budget || !small || too_large(&self.plan.scene, finer).is_some() {
                break;
            }
        }
        Ok(runs)
    }

    fn run(
        &self,
        suite: &Suite,
        model: &Model,
        fitted: usize,
        level: LevelPlan,
        budget: f64,
        size: f64,
    ) -> Result<BestCandidate, String> {
        let predicted = self.load(level).map_or(f64::NAN, |load| model.predict(&load));
        let took = seconds(self.plan, self.case, level)?;
        let mut plan = self.plan.clone();
        plan.refine.levels = vec![level];
        plan.refine.usual = 1;
        plan.cases = vec![self.case.clone()];
        let study = Arc::new(plan);
        let one = Suite { study, ..suite.clone() };
        let outcome = Runner::over(&one, Extent::Usual).case(0, &|| ());
        let study = outcome.convergence().ok_or_else(|| outcome.reason.clone())?;
        let found = study.levels.first().ok_or("no level")?;
        Ok(BestCandidate {
            budget,
            case: self.case.name.clone(),
            cells: level.cells,
            dt: found.dt,
            ppc: found.ppc,
            seconds: [predicted, took],
            error: [self.error(level.h).unwrap_or(f64::NAN), found.error / size],
            beyond: level.h < self.finest().h * (1.0 - 1e-9),
            limit: self.limit(level),
            failure: found.run.failure.clone(),
            model: *model,
            fitted,
        })
    }
}

fn median(mut measure: impl FnMut() -> Result<f64, String>) -> Result<f64, String> {
    let mut all = (0..REPEATS).map(|_| measure()).collect::<Result<Vec<f64>, String>>()?;
    all.sort_by(f64::total_cmp);
    Ok(all[REPEATS / 2])
}

//! A method that may be chosen for a budget, with the predicted time and error of its levels.

use super::measure::{load, seconds};
use crate::study::runner::Runner;
use crate::subject::SubjectError;
use crate::suite::model::refine_plan::FINE_GRID;
use crate::suite::model::refine_plan::{Extent, LevelPlan};
use crate::suite::model::{Case, ConvergencePlan, Suite};
use crate::suite::scene::nodes;
use crate::verify::{
    CaseOutcome, Convergence, LevelOutcome, Model, PredictedError, Ranked, Workload, by_transfers,
};
use std::sync::Arc;

/// Maximum refinement of a grid relative to the levels of the suite.
const FINER: u64 = 8;

/// Maximum refinement relative to the judged levels for which an error is predicted.
pub(crate) const REACH: u64 = 2;

pub(crate) struct Candidate {
    /// A plan with only this case.
    pub(crate) plan: ConvergencePlan,
    pub(crate) case: Case,
    pub(crate) study: Convergence,
    pub(crate) ranked: Ranked,
    pub(crate) error: PredictedError,
    /// Common divisor of the numbers of cells in the suite.
    pub(crate) stride: u64,
    /// Maximum refinement relative to the levels that the method has run.
    pub(crate) reach: u64,
}

/// Creates a candidate from a method of a ranking; `None` if the method does not converge.
pub(crate) fn candidate(
    plan: &ConvergencePlan,
    cases: &[CaseOutcome],
    ranked: &Ranked,
) -> Option<Candidate> {
    let name = &ranked.method.name;
    let case = plan.cases.iter().find(|case| case.name == *name)?.clone();
    let study = cases.iter().find(|case| case.case == *name)?.convergence()?.clone();
    let cells = plan.refine.levels.iter().map(|level| level.cells);
    let stride = cells.reduce(common_divisor)?;
    let (method, part) = (&ranked.method, &ranked.part);
    let error = PredictedError::of(&method.samples, part, study.verdict(), method.formal_order);
    let plan = ConvergencePlan { cases: vec![case.clone()], ..plan.clone() };
    let ranked = ranked.clone();
    let converges = !ranked.part.levels.is_empty();
    converges.then_some(Candidate { plan, case, study, ranked, error, stride, reach: FINER })
}

fn common_divisor(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { common_divisor(b, a % b) }
}

impl Candidate {
    /// Returns the finest of the levels over which the error converges.
    pub(crate) fn finest(&self) -> &LevelOutcome {
        &self.study.levels[self.ranked.part.levels.end - 1]
    }

    /// Returns the level with `cells` cells. If the suite has no such level, the time step is
    /// extrapolated from the two finest levels of the suite.
    pub(crate) fn level(&self, cells: u64) -> LevelPlan {
        let levels = &self.plan.refine.levels;
        if let Some(known) = levels.iter().find(|level| level.cells == cells) {
            return *known;
        }
        let last = levels[levels.len() - 1];
        let before = levels[levels.len().saturating_sub(2)];
        let h = last.h * last.cells as f64 / cells as f64;
        let rule = libm::log(before.dt / last.dt) / libm::log(before.h / last.h);
        let rule = if rule.is_finite() { rule } else { 0.0 };
        // A step that does not decrease with h would exceed the Courant limit on a fine grid.
        let rule = if h < last.h { rule.max(1.0) } else { rule };
        LevelPlan { cells, h, dt: last.dt * libm::pow(h / last.h, rule), ..last }
    }

    /// Predicts the workload of a level from the workload of the finest level that has run.
    pub(crate) fn load(&self, level: LevelPlan) -> Option<Workload> {
        let clock = self.case.clock(&self.plan, level.dt)?;
        let finest = self.finest();
        let known = load(&self.plan, finest);
        let d = self.plan.scene.dimension() as f64;
        let steps = clock.steps as f64;
        let more = libm::pow(finest.h / level.h, d) * (steps / known.steps);
        Some(Workload {
            transfers: known.transfers * more,
            updates: known.updates * more,
            node_steps: nodes(&self.plan.scene, level.h) * steps,
            steps,
        })
    }

    /// Creates a cost model from one timed run. Also returns the predicted time (s) of the coarsest
    /// level.
    pub(crate) fn rough_model(&self) -> Result<(Model, f64), SubjectError> {
        let level = self.level(self.finest().cells);
        seconds(&self.plan, &self.case, level)?;
        let took = seconds(&self.plan, &self.case, level)?;
        let load = self.load(level).ok_or("the time step is invalid")?;
        let model = Model::fit(&[(load, took)]).ok_or("no time at all")?;
        let coarsest = self.load(self.plan.refine.levels[0]).ok_or("no steps")?;
        Ok((model, model.predict(&coarsest)))
    }

    /// Adds one level to the method for each number of cells in `cells`. All levels, also those of
    /// the suite, run and are judged together.
    pub(crate) fn judged_with(&self, suite: &Suite, cells: &[u64]) -> Option<Self> {
        let mut plan = self.plan.clone();
        plan.refine.levels.truncate(self.study.levels.len());
        plan.refine.levels.extend(cells.iter().map(|cells| self.level(*cells)));
        plan.refine.usual = plan.refine.levels.len();
        let outcome = run(suite, plan.clone());
        let rankings = by_transfers(std::slice::from_ref(&outcome));
        let ranked = rankings.first()?.rows.first()?;
        let judged = candidate(&plan, &[outcome], ranked)?;
        Some(Self { stride: self.stride, reach: REACH, ..judged })
    }

    /// Returns the maximum number of cells of a level that is considered.
    pub(crate) fn most_cells(&self) -> u64 {
        let finest = self.finest().cells;
        let reach = if self.error.obstacle().is_none() { self.reach } else { 1 };
        finest.saturating_mul(reach).min(self.most_known())
    }

    /// Returns the maximum number of cells for which the reference is accurate enough.
    fn most_known(&self) -> u64 {
        self.case.against.fine_grid().map_or(u64::MAX, |level| level.cells / FINE_GRID)
    }

    /// Returns the reason why no level finer than `level` is considered; `None` if one is.
    pub(crate) fn limit(&self, level: LevelPlan) -> Option<String> {
        let next = level.cells.saturating_add(self.stride);
        let last = next > self.most_cells();
        last.then(|| match self.error.obstacle() {
            Some(obstacle) => format!("no error is predicted: {obstacle}"),
            None if next > self.most_known() => {
                format!(
                    "no error is defined beyond 1/{FINE_GRID} of the fine grid of the \
                         reference"
                )
            }
            None => format!("no error is predicted beyond {} times as fine a grid", self.reach),
        })
    }

    /// Returns the finest level with a predicted time within the budget. A level finer than all
    /// levels that have run is considered only if its error can be predicted.
    pub(crate) fn finest_within(&self, model: &Model, budget: f64) -> Option<LevelPlan> {
        let most = self.most_cells();
        let first = self.study.levels[self.ranked.part.levels.start].cells;
        let fits = |cells: u64| {
            let level = self.level(cells);
            let possible = cells <= most && level.too_large(&self.plan.scene).is_none();
            possible && self.load(level).is_some_and(|load| model.predict(&load) <= budget)
        };
        let (mut low, mut step) = (first.div_ceil(self.stride), 1);
        if !fits(low * self.stride) {
            return None;
        }
        while fits((low + step) * self.stride) {
            low += step;
            step *= 2;
        }
        while step > 0 {
            if fits((low + step) * self.stride) {
                low += step;
            }
            step /= 2;
        }
        Some(self.level(low * self.stride))
    }
}

/// Runs the only case of `plan` on all its levels.
pub(crate) fn run(suite: &Suite, plan: ConvergencePlan) -> CaseOutcome {
    let one = Suite { study: Arc::new(plan), ..suite.clone() };
    Runner::over(&one, Extent::Usual).case(0, &|| ())
}

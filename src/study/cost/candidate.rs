//! A method that may be chosen for a budget: what its levels would take, and give.

use super::measure::{load, seconds};
use crate::suite::compile::check::size::{nodes, too_large};
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{Case, ConvergencePlan};
use crate::verify::{
    CaseOutcome, Convergence, End, Exponent, LevelOutcome, MethodCost, Model, Ranked, Verdict,
    Workload,
};

/// How many times finer than all levels that have run an order is trusted.
const FINER: u64 = 8;

/// A method that may be chosen.
pub(crate) struct Candidate<'a> {
    pub(crate) plan: &'a ConvergencePlan,
    pub(crate) case: &'a Case,
    pub(crate) study: &'a Convergence,
    pub(crate) ranked: &'a Ranked,
    /// Number that all cells are a multiple of, as those that the suite lists are.
    pub(crate) stride: u64,
}

/// The method of a ranking; none if it converges nowhere.
pub(crate) fn candidate<'a>(
    plan: &'a ConvergencePlan,
    cases: &'a [CaseOutcome],
    ranked: &'a Ranked,
) -> Option<Candidate<'a>> {
    let name = &ranked.method.name;
    let case = plan.cases.iter().find(|case| case.name == *name)?;
    let study = cases.iter().find(|case| case.case == *name)?.convergence()?;
    let cells = plan.refine.levels.iter().map(|level| level.cells);
    let stride = cells.reduce(common_divisor)?;
    (!ranked.part.levels.is_empty()).then_some(Candidate { plan, case, study, ranked, stride })
}

fn common_divisor(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { common_divisor(b, a % b) }
}

impl Candidate<'_> {
    /// The finest level that converges.
    pub(crate) fn finest(&self) -> &LevelOutcome {
        &self.study.levels[self.ranked.part.levels.end - 1]
    }

    /// A level with so many cells: its time step follows the rule of the two finest levels that the
    /// suite lists.
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
        // A step that stays as it is would be beyond its Courant limit sooner or later.
        let rule = if h < last.h { rule.max(1.0) } else { rule };
        LevelPlan { cells, h, dt: last.dt * libm::pow(h / last.h, rule), ..last }
    }

    /// Predicted load of a level, from the finest one that has run.
    pub(crate) fn load(&self, level: LevelPlan) -> Option<Workload> {
        let clock = self.case.clock(self.plan, level.dt)?;
        let finest = self.finest();
        let known = load(self.plan, finest);
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

    /// A model of one run, and the seconds that it predicts of the coarsest level.
    pub(crate) fn rough_model(&self) -> Result<(Model, f64), String> {
        let level = self.level(self.finest().cells);
        seconds(self.plan, self.case, level)?;
        let took = seconds(self.plan, self.case, level)?;
        let load = self.load(level).ok_or("the time step makes no sense")?;
        let model = Model::fit(&[(load, took)]).ok_or("no time at all")?;
        let coarsest = self.load(self.plan.refine.levels[0]).ok_or("no steps")?;
        Ok((model, model.predict(&coarsest)))
    }

    /// Whether the method may be expected to converge beyond the levels that have run.
    pub(crate) fn goes_on(&self) -> bool {
        self.study.verdict() == Verdict::Converging && self.ranked.part.end == End::Levels
    }

    /// Cells of the finest level that is considered.
    fn most_cells(&self) -> u64 {
        let finest = self.finest().cells;
        if self.goes_on() { finest.saturating_mul(FINER) } else { finest }
    }

    /// Why a level is the finest that is considered, if it is.
    pub(crate) fn limit(&self, level: LevelPlan) -> Option<&'static str> {
        let next = level.cells.saturating_add(self.stride);
        let last = next > self.most_cells();
        let why = if self.goes_on() {
            "no order is trusted further"
        } else {
            self.ranked.part.end.words()
        };
        last.then_some(why)
    }

    /// The finest level that is predicted to be done in time. Beyond the levels that have run only
    /// where the method converges on all of them.
    pub(crate) fn finest_within(&self, model: &Model, budget: f64) -> Option<LevelPlan> {
        let most = self.most_cells();
        let first = self.study.levels[self.ranked.part.levels.start].cells;
        let fits = |cells: u64| {
            let level = self.level(cells);
            let possible = cells <= most && too_large(&self.plan.scene, level).is_none();
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

    /// The error at a spacing: between levels straight on logarithmic axes, beyond the finest by
    /// the observed order.
    pub(crate) fn error(&self, h: f64) -> Option<f64> {
        let Ranked { method: MethodCost { samples, formal_order, growth, .. }, part, .. } =
            self.ranked;
        let levels = &samples[part.levels.clone()];
        let finest = levels.last()?;
        if h <= finest.spacing {
            let (observed, formal) = Exponent::of(samples, part, *formal_order, *growth)?.order;
            // Whatever is better than theory on coarse grids will not stay so.
            let order = observed.min(formal);
            return Some(finest.error * libm::pow(h / finest.spacing, order));
        }
        let pair = levels.windows(2).find(|pair| pair[0].spacing >= h && h >= pair[1].spacing)?;
        let share = libm::log(pair[0].spacing / h) / libm::log(pair[0].spacing / pair[1].spacing);
        Some(pair[0].error * libm::pow(pair[1].error / pair[0].error, share))
    }
}

//! The coarsest level of each method that reaches a target error, for benchmarks of accuracy.

use super::measure::seconds;
use crate::study::runner::Runner;
use crate::subject::SubjectError;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{Case, ConvergencePlan, Suite};
use crate::verify::{Ranked, by_transfers};

/// A level that reaches an error, run by one thread.
#[derive(Debug)]
pub struct Goal<'a> {
    plan: &'a ConvergencePlan,
    case: &'a Case,
    level: LevelPlan,
    error: f64,
}

/// For every method of the first problem of the suite, the cheapest listed level in its converging
/// part whose error over the size of the solution is at most `target`, sorted by cost. Excludes
/// methods that do not reach it.
pub fn goals(suite: &Suite, target: f64) -> Vec<Goal<'_>> {
    let Some(plan) = suite.plan::<ConvergencePlan>() else { return Vec::new() };
    let ranked = by_transfers(&Runner::new(suite).run(&|| ()).cases);
    let goal = |row: &Ranked| {
        let case = plan.cases.iter().find(|case| case.name == row.method.name)?;
        let k = row.part.levels.clone().find(|k| row.method.samples[*k].error <= target)?;
        let level = *plan.refine.levels.get(k)?;
        Some((
            row.method.samples[k],
            Goal { plan, case, level, error: row.method.samples[k].error },
        ))
    };
    let rows = ranked.first().map_or(&[][..], |ranking| &ranking.rows);
    let mut goals: Vec<_> = rows.iter().filter_map(goal).collect();
    goals.sort_by(|(a, _), (b, _)| a.work.total_cmp(&b.work));
    goals.into_iter().map(|(_, goal)| goal).collect()
}

impl Goal<'_> {
    /// Name of the case.
    pub fn case(&self) -> &str {
        &self.case.name
    }

    /// Cells along the first axis.
    pub fn cells(&self) -> u64 {
        self.level.cells
    }

    /// Error over the size of the solution, from the judged run.
    pub fn error(&self) -> f64 {
        self.error
    }

    /// Sets up the level and runs its steps; returns the time of the steps (s).
    ///
    /// # Errors
    /// One line with the reason why it cannot be set up.
    pub fn seconds(&self) -> Result<f64, SubjectError> {
        seconds(self.plan, self.case, self.level)
    }
}

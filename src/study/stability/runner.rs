//! Running a stability study: every row of every case, and the outcome.

use super::run::CaseRun;
use super::statement;
use crate::study::describe::statement::Rows;
use crate::study::kind::{CaseRunner, Progress, RunContext, Study};
use crate::suite::model::stability::StabilityPlan;
use crate::verify::{CaseOutcome, StabilityRow, StabilityStudy};
use rayon::prelude::*;
use std::sync::Arc;

impl Study for StabilityPlan {
    fn statement(&self) -> Rows {
        statement::rows(self)
    }

    fn runner<'a>(&'a self, context: RunContext<'a>) -> Box<dyn CaseRunner + 'a> {
        Box::new(StabilityRunner { plan: self, context })
    }
}

/// Runs cases of a stability study.
struct StabilityRunner<'a> {
    plan: &'a StabilityPlan,
    context: RunContext<'a>,
}

impl CaseRunner for StabilityRunner<'_> {
    fn units(&self) -> u64 {
        (self.plan.cases.len() * self.plan.values.len()) as u64
    }

    fn case(&self, index: usize, progress: Progress<'_>) -> CaseOutcome {
        let (plan, context, case) = (self.plan, self.context, &self.plan.cases[index]);
        let run = CaseRun { plan, case, context };
        let row = |value: &f64| {
            let row = run.row(*value);
            progress();
            row
        };
        outcome(&run, plan.values.par_iter().map(row).collect())
    }
}

/// The outcome of a case, from its rows.
fn outcome(run: &CaseRun<'_>, rows: Vec<StabilityRow>) -> CaseOutcome {
    let CaseRun { plan, case, .. } = run;
    // Where no face is held, nothing is to be said of walls.
    let mut settings = case.method.settings();
    let walls = run.setup(&[]).is_ok_and(|s| s.scene.faces.iter().any(|f| f.hold.is_held()));
    settings.retain(|(key, _)| walls || key != "walls");
    let unmet: Vec<String> = case
        .expected
        .iter()
        .zip(&rows)
        .flat_map(|(expected, row)| {
            let place = format!("{} = {}", plan.swept, row.value);
            expected.unmet(row).into_iter().map(move |unmet| format!("{place}: {unmet}"))
        })
        .collect();
    let study = StabilityStudy {
        swept: plan.swept.clone(),
        sought: plan.sought.as_ref().map(|(name, ..)| name.clone()),
        figures: plan.figures.clone(),
        rows,
    };
    CaseOutcome {
        case: case.name.clone(),
        subject: "mpm",
        settings,
        profile: None,
        expected: case.summary.clone(),
        because: case.because.clone(),
        verdict: study.verdict(),
        reason: study.reason(),
        unmet,
        lacks: Vec::new(),
        study: Some(Arc::new(study)),
    }
}

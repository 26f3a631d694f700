//! The stability study: runs and judges the rows of every case.

mod handed;
pub(crate) mod run;
use self::run::CaseRun;
use crate::external::{ProblemNeeds, SolverFactory};
use crate::study::describe::{self, Rows, push, scene, stated};
use crate::study::kind::{CaseRunner, PlanRunner, Progress, RunContext, ShowRun, Study};
use crate::study::time_series::SeriesError;
use crate::suite::evaluator::shown;
use crate::suite::model::Scene;
use crate::suite::model::stability::{RunSetup, StabilityPlan};
use crate::verify::{
    CaseOutcome, Stability, StabilityRow, StabilityStudy, StudyResults, Unmet, UnmetCode,
};
use rayon::prelude::*;
use std::sync::Arc;

impl Study for StabilityPlan {
    fn statement(&self) -> Rows {
        let mut rows = Rows::new();
        let first = |value: &f64| self.setup.with(&[(&self.swept, *value)]).ok();
        if let Some(first) = self.values.first().and_then(first) {
            scene(&first.scene, &mut rows);
            of_setup(self, &first, &mut rows);
        }
        rows
    }

    fn needs(&self) -> Option<ProblemNeeds> {
        let setup = self.setup.with(&[(&self.swept, *self.values.first()?)]);
        Some(handed::needs(&setup.ok()?))
    }

    fn runner<'a>(&'a self, context: RunContext<'a>) -> Box<dyn CaseRunner + 'a> {
        Box::new(PlanRunner { plan: self, context })
    }
}

impl CaseRunner for PlanRunner<'_, StabilityPlan> {
    fn units(&self) -> u64 {
        (self.plan.cases.len() * self.plan.values.len()) as u64
    }

    fn case(&self, index: usize, progress: Progress<'_>) -> CaseOutcome {
        let (plan, context, case) = (self.plan, self.context, &self.plan.cases[index]);
        let run = CaseRun { plan, case, context };
        let lacks = context.solver.map_or(Vec::new(), |solver| {
            plan.needs().map_or(Vec::new(), |needs| solver.lacks(&needs))
        });
        described(&run, index).after(case.gating.as_ref(), lacks, |described| {
            let rows = plan.values.par_iter().map(|value| run.row(*value));
            let rows: Vec<StabilityRow> = rows.inspect(|_| progress()).collect();
            let refused = rows.iter().find_map(|row| row.refused.as_ref());
            match refused.filter(|_| context.solver.is_some()) {
                Some(reason) => described.not_run(reason),
                None => outcome(&run, described, rows),
            }
        })
    }

    fn shown(
        &self,
        case: usize,
        outcome: &CaseOutcome,
        show: ShowRun<'_>,
    ) -> Result<(), SeriesError> {
        let (plan, case) = (self.plan, &self.plan.cases[case]);
        let study = outcome.stability().ok_or("it could not be run")?;
        if study.sought.is_some() {
            return Err("it searches for a limit with many runs".into());
        }
        let trial = |row: &StabilityRow| row.trial.as_ref().map(|trial| trial.verdict);
        let grows = |row: &&StabilityRow| trial(row) != Some(Stability::Stable);
        let row = study.rows.iter().find(grows).or(study.rows.last()).ok_or("it has no runs")?;
        let run = CaseRun { plan, case, context: self.context };
        show(run.shown(&[(&plan.swept, row.value)])?)
    }
}

fn described(run: &CaseRun<'_>, index: usize) -> CaseOutcome {
    let case = run.case;
    // If no face is fixed, settings of walls have no effect.
    let walls = run.setup(&[]).is_ok_and(|s| s.scene.faces.iter().any(|f| f.hold.is_held()));
    let mut settings = case.method.settings();
    settings.retain(|(key, _)| walls || key != "walls");
    let mut all = run.context.solver.map_or(Vec::new(), SolverFactory::settings);
    all.extend(settings);
    describe::described(&case.name, case.method, all, run.plan.expectation(index))
}

fn outcome(run: &CaseRun<'_>, described: CaseOutcome, rows: Vec<StabilityRow>) -> CaseOutcome {
    let CaseRun { plan, case, .. } = run;
    let unmet: Vec<Unmet> = case
        .expectations
        .expected
        .iter()
        .zip(&rows)
        .flat_map(|(expected, row)| {
            let place = format!("{} = {}", plan.swept, row.value);
            let unmet = expected.unmet(row).into_iter();
            unmet.map(move |unmet| {
                Unmet::new(UnmetCode::StabilityDiffers, format!("{place}: {unmet}"))
            })
        })
        .collect();
    let study = StabilityStudy {
        swept: plan.swept.clone(),
        sought: plan.sought.as_ref().map(|(name, ..)| name.clone()),
        figures: plan.figures.clone(),
        rows,
    };
    CaseOutcome {
        verdict: study.verdict(),
        reason: study.reason(),
        unmet,
        study: Some(StudyResults::Stability(Arc::new(study))),
        ..described
    }
}

/// Returns the time step (s), if it is constant and equal in all runs.
fn common_step(plan: &StabilityPlan, setup: &RunSetup) -> Option<f64> {
    let [dt] = setup.dt[..] else { return None };
    let is_equal = |value: &f64| {
        let other = plan.setup.with(&[(&plan.swept, *value)]);
        other.is_ok_and(|other| other.dt == setup.dt)
    };
    let is_given = setup.rule.is_none() && plan.sought.is_none();
    (is_given && plan.values.iter().all(is_equal)).then_some(dt)
}

fn reference_energy(setup: &RunSetup) -> &'static str {
    let is_at_rest = |body: &Scene| {
        body.initial_displacement.is_empty()
            && body.initial_velocity.is_empty()
            && body.initial_stress.is_none()
    };
    if setup.perturb == 0.0 && setup.scene.each().iter().all(is_at_rest) {
        "the energy of a unit strain (the initial energy is zero)"
    } else {
        "the initial energy"
    }
}

fn of_setup(plan: &StabilityPlan, setup: &RunSetup, rows: &mut Rows) {
    let mut push = |key: &str, value: String| push(rows, key, &value);
    let values: Vec<String> = plan.values.iter().map(|value| shown(*value)).collect();
    push("sweep", format!("{} = {}", plan.swept, values.join(", ")));
    if let Some((name, from, to)) = &plan.sought {
        push(
            "search",
            format!("the largest stable {name}, from {} to {}", shown(*from), shown(*to)),
        );
    }
    let ppc = setup.level.ppc.unwrap_or(0);
    push("cells", format!("{} of size {} m", setup.level.cells, shown(setup.level.h)));
    push("particles", format!("{ppc} per cell"));
    let full = if setup.full_steps == setup.steps {
        String::new()
    } else {
        format!(", or {} with the option --full", setup.full_steps)
    };
    let plural = if setup.steps == 1 { "" } else { "s" };
    push("run", format!("{} step{plural}{full}", setup.steps));
    if let Some(dt) = common_step(plan, setup) {
        push("dt", format!("{} s", stated(dt)));
        if setup.full_steps == setup.steps {
            push("until", format!("t = {} s", stated(setup.steps as f64 * dt)));
        }
    }
    if let Some(share) = setup.rule {
        push("dt", format!("{} times the stable time step", shown(share)));
    }
    if let (Some(first), Some(last)) = (setup.dt.first(), setup.dt.last()) {
        let turns = setup.dt.len() / 2;
        if turns > 0 {
            push("consecutive steps", format!("{turns} of {first:e} s, {turns} of {last:e} s"));
        }
    }
    if setup.frozen {
        push("configuration", "frozen: steps move neither particles nor domains".to_owned());
    }
    if setup.perturb > 0.0 {
        push(
            "start",
            format!(
                "random perturbation of every component of the state, up to {:e} of its size",
                setup.perturb
            ),
        );
    }
    push(
        "verdicts",
        format!(
            "stable up to {:e} times {}, unstable above {:e} times",
            setup.scales.stable_below,
            reference_energy(setup),
            setup.scales.unstable_above
        ),
    );
}

//! Runs, measures and judges the cases of a convergence study.

pub(crate) mod judge_plan;
pub(crate) mod reference;
pub(crate) mod statement;
pub(crate) mod time_steps;
use self::judge_plan::{judge_plan, rounding_sizes};
use self::reference::{FineGrid, FineSteps, Reference, Unknown};
use self::statement::described;
use self::time_steps::StableSteps;
use crate::exact::{Problem, Truth};
use crate::external::ProblemNeeds;
use crate::study::describe::{Dispensable, Rows, step_profile, without_effect};
use crate::study::handover::{needs, subject_under};
use crate::study::kind::{CaseRunner, Progress, RunContext, ShowRun, StepWarning, Study};
use crate::study::time_series::{SeriesError, ShownRun};
use crate::subject::{Profile, SubjectError};
use crate::suite::model::refine_plan::{Extent, LevelPlan};
use crate::suite::model::{Against, Case, ConvergencePlan, SameMethod};
use crate::verify;
use crate::verify::{
    Axis, CaseOutcome, Comparison, Expectation, Gating, LevelOutcome, LevelRun, LevelSizes, Reruns,
    RoundingSizes, RunResult, judge_case,
};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

/// Runs the cases of a convergence study. Data that several cases need are computed only once.
pub(crate) struct ConvergenceRunner<'a> {
    plan: ConvergencePlan,
    /// Number of cases that have not run yet.
    left: AtomicUsize,
    context: RunContext<'a>,
    references: Vec<(f64, OnceLock<Result<Reference, SubjectError>>)>,
    steps: StableSteps,
}

impl Study for ConvergencePlan {
    fn statement(&self) -> Rows {
        statement::rows(self)
    }

    fn needs(&self) -> Option<ProblemNeeds> {
        Some(needs(self))
    }

    fn profile(&self, case: usize, without: Option<Dispensable>) -> Option<Profile> {
        let case = &self.cases[case];
        match without {
            None => step_profile(self, case),
            Some(without) => step_profile(&without_effect(self, without), case),
        }
    }

    fn runner<'a>(&'a self, context: RunContext<'a>) -> Box<dyn CaseRunner + 'a> {
        Box::new(ConvergenceRunner::new(self, context))
    }
}

impl CaseRunner for ConvergenceRunner<'_> {
    fn units(&self) -> u64 {
        (self.plan.cases.len() * self.plan.refine.levels(self.context.extent).len()) as u64
    }

    fn warnings(&self) -> Vec<StepWarning> {
        self.steps.warnings(&self.plan, self.context.extent)
    }

    fn case(&self, index: usize, progress: Progress<'_>) -> CaseOutcome {
        let outcome = self.outcome(index, progress);
        // Shared values are freed now: the runners of all suites exist until the last suite ends.
        let exact = self.plan.exact.as_ref();
        if self.left.fetch_sub(1, Ordering::Relaxed) == 1
            && let Some(shared) = exact.and_then(|exact| exact.shared.as_ref())
        {
            shared.clear();
        }
        outcome
    }

    fn shown(
        &self,
        case: usize,
        outcome: &CaseOutcome,
        show: ShowRun<'_>,
    ) -> Result<(), SeriesError> {
        let (plan, case) = (&self.plan, &self.plan.cases[case]);
        let study = outcome.convergence().ok_or("it could not be run")?;
        let broke = study.levels.iter().position(|level| level.run.failure.is_some());
        let index = broke.unwrap_or(study.levels.len().saturating_sub(1));
        let levels = plan.refine.levels(self.context.extent);
        let level = *levels.get(index).ok_or("it has no levels")?;
        let (level, _) = self.steps.of(plan, case, level)?;
        let clock = case.clock(plan, level.dt).ok_or("the time step is invalid")?;
        let same_method;
        let truth = match case.against {
            Against::Nothing => None,
            Against::SameMethod(same) => {
                same_method = self.same_method(case, same)?;
                Some(same_method.as_ref())
            }
            Against::Exact | Against::Reference => Some(self.truth(case)?),
        };
        let RunContext { solver, suite, .. } = self.context;
        show(ShownRun {
            name: study.levels[index].name(plan.refine.axis),
            subject: subject_under(solver, suite, plan, case, level)?,
            dt: vec![clock.dt()],
            steps: clock.steps,
            truth,
        })
    }
}

impl<'a> ConvergenceRunner<'a> {
    fn new(plan: &'a ConvergencePlan, context: RunContext<'a>) -> Self {
        let mut ends: Vec<f64> = plan.cases.iter().map(|case| case.until).collect();
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        let references = ends.into_iter().map(|end| (end, OnceLock::new())).collect();
        let mut plan = plan.clone();
        // Cases with automatic time steps evaluate the solution at different times.
        let same_times = plan.cases.len() > 1 && plan.refine.rule.is_none();
        if let Some(exact) = plan.exact.as_mut().filter(|_| same_times) {
            exact.shared = Some(Arc::default());
        }
        let left = AtomicUsize::new(plan.cases.len());
        Self { plan, left, context, references, steps: StableSteps::default() }
    }

    fn outcome(&self, index: usize, progress: Progress<'_>) -> CaseOutcome {
        let (plan, case) = (&self.plan, &self.plan.cases[index]);
        let expectation = match (self.context.extent, &case.expectation_in_full) {
            (Extent::Full, Some(full)) => Some(full),
            _ => case.expectation.as_ref(),
        };
        let Some(solver) = self.context.solver else {
            if case.solver.is_some() {
                let lacks = vec!["`--solver COMMAND`".to_owned()];
                return described(plan, case, None).not_applicable(lacks, "must be named with");
            }
            return self
                .run(case, expectation, progress)
                .unwrap_or_else(|error| described(plan, case, expectation).could_not_run(&error));
        };
        let lacks = solver.lacks(&needs(plan));
        let mut outcome = if let Some(Gating::Excepted(reason)) = &case.gating {
            described(plan, case, None).excepted(reason.clone())
        } else if lacks.is_empty() {
            self.run(case, expectation, progress)
                .unwrap_or_else(|error| described(plan, case, None).not_run(&error))
        } else {
            described(plan, case, None).not_applicable(lacks, "lacks")
        };
        outcome.settings.splice(0..0, solver.settings());
        outcome
    }

    fn run(
        &self,
        case: &Case,
        expectation: Option<&Expectation>,
        progress: Progress<'_>,
    ) -> Result<CaseOutcome, SubjectError> {
        let plan = &self.plan;
        let same_method;
        let truth = if let Against::SameMethod(same) = case.against {
            same_method = self.same_method(case, same)?;
            same_method.as_ref()
        } else {
            self.truth(case)?
        };
        let judging = judge_plan(plan, case, expectation, truth);
        let runs = CaseRuns { runner: self, case, truth };
        let all = plan.refine.levels(self.context.extent);
        let run = |level: &LevelPlan| {
            let (level, limit) = self.steps.of(plan, case, *level)?;
            Ok(LevelRun { stable_time_step: limit, ..runs.repeated(level)? })
        };
        let levels: Result<Vec<LevelRun>, SubjectError> =
            all.par_iter().map(run).inspect(|_| progress()).collect();
        Ok(described(plan, case, expectation).judged(judge_case(&judging, levels?, &runs)))
    }

    fn same_method(&self, case: &Case, same: SameMethod) -> Result<Box<dyn Truth>, SubjectError> {
        let plan = &self.plan;
        Ok(match same {
            SameMethod::ShorterSteps(dt) => Box::new(FineSteps::compute(plan, case, dt)?),
            SameMethod::FineGrid(level) => {
                let (level, _) = self.steps.of(plan, case, level)?;
                Box::new(FineGrid::compute(plan, case, level)?)
            }
        })
    }

    fn truth(&self, case: &Case) -> Result<&dyn Truth, SubjectError> {
        if case.against == Against::Nothing {
            return Ok(&Unknown);
        }
        if case.against == Against::Exact {
            if let Some(heat) = &self.plan.conduction {
                return Ok(heat);
            }
            let exact = self.plan.exact.as_ref().ok_or("the suite declares no exact solution")?;
            return Ok(exact);
        }
        let found = self.references.iter().find(|(until, _)| *until == case.until);
        let (until, reference) = found.ok_or("no reference for this case")?;
        match reference.get_or_init(|| Reference::compute(&self.plan, *until)) {
            Ok(reference) => Ok(reference),
            Err(reason) => Err(reason.clone()),
        }
    }
}

struct CaseRuns<'r, 'a> {
    runner: &'r ConvergenceRunner<'a>,
    case: &'r Case,
    truth: &'r dyn Truth,
}

impl CaseRuns<'_, '_> {
    fn level(&self, level: LevelPlan) -> Result<LevelRun, SubjectError> {
        let (plan, case) = (&self.runner.plan, self.case);
        let RunContext { suite, fingerprint, solver, .. } = self.runner.context;
        let clock = case.clock(plan, level.dt).ok_or("the time step is invalid")?;
        let name = format!("{suite}::{}, {} cells, dt = {}", case.name, level.cells, level.dt);
        let key = format!("{suite} {fingerprint:016x} {} {level:?}", case.name);
        let comparison = self.comparison();
        let run = || {
            let mut subject = subject_under(solver, suite, plan, case, level)?;
            Ok(verify::run(subject.as_mut(), self.truth, &clock, &comparison))
        };
        let broken = |run: &RunResult| run.failure.is_some();
        let run = self.runner.context.cached(&key, &name, broken, run)?;
        Ok(self.level_run(level, clock.dt(), run))
    }

    /// Runs one level as often as the context requires, and measures the spread of the runs.
    fn repeated(&self, level: LevelPlan) -> Result<LevelRun, SubjectError> {
        let (plan, case) = (&self.runner.plan, self.case);
        let RunContext { suite, solver, repeat, .. } = self.runner.context;
        if repeat < 2 {
            return self.level(level);
        }
        let clock = case.clock(plan, level.dt).ok_or("the time step is invalid")?;
        let comparison = self.comparison();
        let mut first = None;
        let mut records = Vec::new();
        for number in 1..=repeat {
            let mut subject = subject_under(solver, suite, plan, case, level)?;
            let subject = subject.as_mut();
            let (run, record) =
                verify::run_recorded(subject, self.truth, &clock, &comparison, plan.norm);
            if let Some(reason) = &run.failure {
                let failure = Some(format!("run {number} of {repeat}: {reason}"));
                return Ok(self.level_run(level, clock.dt(), RunResult { failure, ..run }));
            }
            records.push(record);
            first.get_or_insert(run);
        }
        let run = first.ok_or("the level has no run")?;
        let spread = Some(verify::spread(&records, plan.norm));
        Ok(LevelRun { spread, ..self.level_run(level, clock.dt(), run) })
    }

    fn comparison(&self) -> Comparison<'_> {
        let plan = &self.runner.plan;
        let at_rest = plan.exact.as_ref().filter(|truth| truth.at_rest).map(Problem::wave_speed);
        let (sum, observe) = (plan.sum.as_deref(), plan.observe.as_deref());
        let (of, within, steps) = (plan.of, plan.within.as_ref(), plan.steps);
        Comparison { of, sum, within, observe, at_rest, steps }
    }

    fn level_run(&self, level: LevelPlan, dt: f64, run: RunResult) -> LevelRun {
        let particle_spacing = level.particle_spacing(self.runner.plan.scene.dimension());
        let LevelPlan { cells, h, ppc, .. } = level;
        let sizes = LevelSizes { cells, h, dt, ppc, particle_spacing };
        LevelRun { sizes, run, spread: None, stable_time_step: None }
    }
}

/// Returns the resolution of a level that has run, with its actual time step.
fn taken(level: &LevelOutcome) -> LevelPlan {
    let LevelOutcome { cells, h, dt, ppc, .. } = *level;
    LevelPlan { cells, h, dt, ppc }
}

impl Reruns for CaseRuns<'_, '_> {
    type Error = SubjectError;

    fn can_halve(&self) -> bool {
        !matches!(self.case.against, Against::SameMethod(_))
    }

    fn run_halved(
        &self,
        level: &LevelOutcome,
        axis: Axis,
    ) -> Option<Result<LevelRun, SubjectError>> {
        let scene = &self.runner.plan.scene;
        let halved = taken(level).halved(axis, scene.dimension())?;
        Some(match halved.too_large(scene) {
            Some((what, amount)) => Err(format!("{amount:.1e} {what} exceed the limit").into()),
            None => self.level(halved),
        })
    }

    fn run_with_step(&self, level: &LevelOutcome, dt: f64) -> Result<LevelRun, SubjectError> {
        self.repeated(LevelPlan { dt, ..taken(level) })
    }

    fn rounding(&self) -> Option<RoundingSizes> {
        rounding_sizes(&self.runner.plan, self.case, self.truth)
    }
}

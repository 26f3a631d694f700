//! Running a suite: every level of every case, judged.

use super::{
    error_scale::yardstick,
    outcome::{error_of, judge_levels, judged, refused},
    probe,
    reference::Reference,
    small_step_reference::FineSteps,
    stable_step::StableSteps,
};
use crate::{
    exact::{Problem, Truth},
    study::{
        build::dispatch::subject, cache::results::ResultCache, describe::statement,
        internal_force::case::internal_force, stability::run as stability,
    },
    suite::{
        compile::truth::conservation_only::Unknown,
        grammar::CrossingLevels,
        model::{
            Against, Case, ConvergencePlan, StudyPlan, Suite,
            refine_plan::{Extent, LevelPlan},
        },
    },
    verify,
    verify::{
        Axis, CaseOutcome, CheckpointStore, Clock, Comparison, LevelOutcome, NoCheckpoints, Run,
        SuiteOutcome,
    },
};
use rayon::prelude::*;
use std::sync::OnceLock;

/// Told after each level (or internal-force case) that is done.
pub type Progress<'a> = &'a (dyn Fn() + Sync);

/// Runs cases of one suite. A reference that several cases share is computed once.
pub struct Runner<'a> {
    suite: &'a Suite,
    extent: Extent,
    kept: Option<&'a ResultCache>,
    references: Vec<(f64, OnceLock<Result<Reference, String>>)>,
    steps: StableSteps,
}

impl<'a> Runner<'a> {
    /// A runner of the levels that the gate runs; nothing runs yet.
    pub fn new(suite: &'a Suite) -> Self {
        Self::over(suite, Extent::Usual)
    }

    /// A runner of so many levels.
    pub fn over(suite: &'a Suite, extent: Extent) -> Self {
        let mut ends: Vec<f64> = match &suite.study {
            StudyPlan::Convergence(plan) => plan.cases.iter().map(|case| case.until).collect(),
            StudyPlan::InternalForce(_) | StudyPlan::Stability(_) => Vec::new(),
        };
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        let references = ends.into_iter().map(|end| (end, OnceLock::new())).collect();
        Self { suite, extent, kept: None, references, steps: StableSteps::default() }
    }

    /// Keeps finished levels, and takes those that have been kept.
    #[must_use]
    pub fn keeping(self, kept: Option<&'a ResultCache>) -> Self {
        Self { kept, ..self }
    }

    /// Units of progress of the whole suite.
    pub fn units(&self) -> u64 {
        match &self.suite.study {
            StudyPlan::Convergence(plan) => {
                (plan.cases.len() * plan.refine.levels(self.extent).len()) as u64
            }
            StudyPlan::InternalForce(plan) => plan.cases.len() as u64,
            StudyPlan::Stability(plan) => (plan.cases.len() * plan.values.len()) as u64,
        }
    }

    /// Runs every case, in parallel; outcomes keep the order of the suite, so the number of
    /// threads cannot be seen in them.
    pub fn run(&self, progress: Progress<'_>) -> SuiteOutcome {
        let count = self.suite.case_names().len();
        self.outcome((0..count).into_par_iter().map(|i| self.case(i, progress)).collect())
    }

    /// The outcome of the suite, made of those of all its cases.
    pub fn outcome(&self, cases: Vec<CaseOutcome>) -> SuiteOutcome {
        SuiteOutcome {
            suite: self.suite.name.clone(),
            title: self.suite.title.clone(),
            source: self.suite.source.clone(),
            about: self.suite.about.trim().to_owned(),
            statement: statement::rows(self.suite),
            cases,
        }
    }

    /// Runs the case with the given index.
    ///
    /// # Panics
    /// If there is no such case.
    pub fn case(&self, index: usize, progress: Progress<'_>) -> CaseOutcome {
        match &self.suite.study {
            StudyPlan::Convergence(plan) => self.convergence(plan, &plan.cases[index], progress),
            StudyPlan::InternalForce(plan) => {
                let outcome = internal_force(plan, &plan.cases[index]);
                progress();
                outcome
            }
            StudyPlan::Stability(plan) => {
                let Suite { name, fingerprint, .. } = self.suite;
                let (suite, how) = ((name.as_str(), *fingerprint), (self.extent, self.kept));
                stability::case(suite, plan, &plan.cases[index], how, progress)
            }
        }
    }

    fn convergence(
        &self,
        plan: &ConvergencePlan,
        case: &Case,
        progress: Progress<'_>,
    ) -> CaseOutcome {
        let expectation = match (self.extent, &case.expectation_in_full) {
            (Extent::Full, Some(full)) => full,
            _ => &case.expectation,
        };
        let shorter = (case.against == Against::SameMethod)
            .then(|| FineSteps::compute(plan, case, plan.same_method_dt.unwrap_or(f64::NAN)));
        let truth: Result<&dyn Truth, String> = match &shorter {
            Some(Ok(truth)) => Ok(truth),
            Some(Err(reason)) => Err(reason.clone()),
            None => self.truth(plan, case),
        };
        let truth = match truth {
            Ok(truth) => truth,
            Err(reason) => return refused(plan, case, expectation, reason),
        };
        let levels: Result<Vec<LevelOutcome>, String> = plan
            .refine
            .levels(self.extent)
            .par_iter()
            .map(|level| {
                let level = self.steps.of(plan, case, *level).and_then(|(level, limit)| {
                    let outcome = self.level(plan, case, truth, level)?;
                    Ok(LevelOutcome { safe_step: limit, ..outcome })
                });
                progress();
                level
            })
            .collect();
        let levels = match levels {
            Ok(levels) => levels,
            Err(reason) => return refused(plan, case, expectation, reason),
        };
        let judgement = judge_levels(plan, case, expectation, &levels);
        let again = |level| self.level(plan, case, truth, level);
        let floor = probe::floor(plan, case, expectation, &judgement, &levels, again);
        let yardstick = yardstick(plan, case, truth);
        judged(plan, case, expectation, levels, judgement, floor, yardstick)
    }

    /// What is to be said before anything runs: steps that are longer than any that is known to be safe.
    pub fn warnings(&self) -> Vec<String> {
        let StudyPlan::Convergence(plan) = &self.suite.study else { return Vec::new() };
        let name = |warning| format!("{}::{warning}", self.suite.name);
        self.steps.warnings(plan, self.extent).into_iter().map(name).collect()
    }

    /// One level of a case against `truth`.
    fn level(
        &self,
        plan: &ConvergencePlan,
        case: &Case,
        truth: &dyn Truth,
        level: LevelPlan,
    ) -> Result<LevelOutcome, String> {
        let clock = Clock::new(case.until, level.dt, plan.instants)
            .ok_or("the time step makes no sense")?;
        let run =
            |keeper: &mut dyn CheckpointStore| run_of(plan, case, truth, level, &clock, keeper);
        let run = match self.kept {
            None => run(&mut NoCheckpoints),
            Some(kept) => {
                let Suite { name, fingerprint, .. } = self.suite;
                let what =
                    format!("{name}::{}, {} cells, dt = {}", case.name, level.cells, level.dt);
                let key = format!("{name} {fingerprint:016x} {} {level:?}", case.name);
                kept.level(&key, &what, run)
            }
        };
        Ok(level_of(plan, level, clock.dt(), run?))
    }

    fn truth(&self, plan: &'a ConvergencePlan, case: &Case) -> Result<&dyn Truth, String> {
        if case.against == Against::Nothing {
            return Ok(&Unknown);
        }
        if case.against == Against::Exact {
            if let Some(heat) = &plan.conduction {
                return Ok(heat);
            }
            let exact = plan.exact.as_ref().ok_or("the suite declares no exact solution")?;
            return Ok(exact);
        }
        let found = self.references.iter().find(|(until, _)| *until == case.until);
        let (until, reference) = found.ok_or("no reference for this case")?;
        match reference.get_or_init(|| Reference::compute(plan, *until)) {
            Ok(reference) => Ok(reference),
            Err(reason) => Err(reason.clone()),
        }
    }
}

fn run_of(
    plan: &ConvergencePlan,
    case: &Case,
    truth: &dyn Truth,
    level: LevelPlan,
    clock: &Clock,
    keeper: &mut dyn CheckpointStore,
) -> Result<Run, String> {
    let make = || subject(plan, case.method, level);
    let rest = plan.exact.as_ref().filter(|truth| truth.at_rest).map(Problem::wave_speed);
    let comparison = Comparison { of: plan.of, observe: plan.observe.as_deref(), at_rest: rest };
    verify::resume(make, truth, clock, &comparison, keeper)
}

fn level_of(plan: &ConvergencePlan, level: LevelPlan, dt: f64, run: Run) -> LevelOutcome {
    let crossed = run.counters.crossings.is_some_and(|n| n > 0);
    let excluded = crossed && plan.crossing_levels == CrossingLevels::Excluded;
    let LevelPlan { cells, h, .. } = level;
    let ppc = level.ppc.filter(|_| run.counters.particles.is_some());
    let spacing = match plan.refine.axis {
        Axis::Space => h,
        Axis::Time => dt,
        Axis::Particles => level.particle_spacing(plan.scene.dimension()),
    };
    let error = error_of(plan, &run);
    let (usable, order, safe_step) = (!excluded, None, None);
    LevelOutcome { cells, h, spacing, dt, ppc, run, error, usable, order, safe_step }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{study::cache::checkpoints::Interruption, suite::embedded};
    use rstest::rstest;

    fn load(name: &str) -> Suite {
        Suite::load(&embedded::source(name).unwrap().unwrap()).unwrap()
    }

    /// Every kind of subject and all that a judge gathers: histories, the totals of a run, a state of rest,
    /// temperatures, F and stress; bodies in contact, walls with friction and driven ones, plastic flow.
    #[rstest]
    #[case("vibrating-bar")]
    #[case("vibrating-bar-long")]
    #[case("column-hencky-small-load")]
    #[case("fem-vibrating-bar")]
    #[case("heat-convection")]
    #[case("thermal-expansion-mms")]
    #[case("two-bar-impact")]
    #[case("sticking-block")]
    #[case("plastic-wave")]
    #[case("rotating-block")]
    #[case("simple-shear")]
    fn an_interrupted_level_shows_what_a_whole_one_does(#[case] name: &str) {
        let suite = load(name);
        let StudyPlan::Convergence(plan) = &suite.study else { panic!("{name} has levels") };
        let level = plan.refine.levels[0];
        for case in plan.cases.first().into_iter().chain(plan.cases.last()) {
            let runner = Runner::new(&suite);
            let truth = runner.truth(plan, case).unwrap();
            let clock = Clock::new(case.until, level.dt, plan.instants).unwrap();
            let run = |keeper: &mut dyn CheckpointStore| {
                format!("{:?}", run_of(plan, case, truth, level, &clock, keeper).unwrap())
            };
            Interruption::holds(clock.steps, run, &case.name);
        }
    }

    /// Cut short, after more steps than there are, and of another level.
    #[test]
    fn a_level_starts_anew_if_what_is_left_is_no_state_of_it() {
        let suite = load("vibrating-bar");
        let StudyPlan::Convergence(plan) = &suite.study else { panic!("it has levels") };
        let case = &plan.cases[0];
        let runner = Runner::new(&suite);
        let truth = runner.truth(plan, case).unwrap();
        let clock = Clock::new(case.until, plan.refine.levels[0].dt, plan.instants).unwrap();
        let run = |level: usize, keeper: &mut dyn CheckpointStore| {
            let level = plan.refine.levels[level];
            format!("{:?}", run_of(plan, case, truth, level, &clock, keeper).unwrap())
        };
        let coarsest = |keeper: &mut dyn CheckpointStore| run(0, keeper);
        let (whole, state) = Interruption::holds(clock.steps, coarsest, "level 0");
        let (_, of_another) = Interruption::holds(clock.steps, |keeper| run(1, keeper), "level 1");
        let torn = state[..state.len() / 2].to_vec();
        let beyond = [&clock.steps.to_le_bytes(), &state[8..]].concat();
        for state in [torn, beyond, of_another] {
            Interruption::is_refused(state, coarsest, &whole);
        }
    }
}

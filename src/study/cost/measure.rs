//! Seconds of every level of every case.
//!
//! A level is run once to warm up and then at least five times, or for one second, whichever comes
//! first; short levels are repeated for at least 50 ms. All levels are repeated in turn, so that a
//! slowdown of the machine affects all of them. The time for which other processes used the core is
//! excluded, if the system reports it.

use crate::external::SolverFactory;
use crate::study::handover::subject_under;
use crate::study::runner::Runner;
use crate::study::setup::dispatch::subject;
use crate::subject::{Subject, SubjectError};
use crate::suite::compile::check::size::nodes;
use crate::suite::model::refine_plan::{Extent, LevelPlan};
use crate::suite::model::{Case, ConvergencePlan, Suite};
use crate::verify::{
    LevelOutcome, Machine, Ranked, SuiteOutcome, TimedSuite, Timing, Workload, by_transfers,
};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::hint::black_box;
use std::sync::LazyLock;
use std::time::Instant;

/// Minimum number of repeats.
const FEWEST: usize = 5;

/// Minimum total time (s) of the repeats.
const LEAST: f64 = 0.05;

/// Maximum total time (s) of the repeats.
const LONGEST: f64 = 1.0;

/// Maximum number of repeats.
const MOST: usize = 200;

/// One level that is timed.
struct TimingJob<'a> {
    suite: &'a str,
    plan: &'a ConvergencePlan,
    case: &'a Case,
    level: LevelPlan,
    solver: Option<&'a dyn SolverFactory>,
    /// Indices of the case and of its level.
    at: (usize, usize),
    seconds: Vec<f64>,
}

impl TimingJob<'_> {
    fn run(&self) -> Result<f64, SubjectError> {
        let Self { suite, plan, case, level, solver, .. } = *self;
        seconds_of(plan, case, level, || subject_under(solver, suite, plan, case, level))
    }

    fn is_done(&self) -> bool {
        let (spent, repeats) = (self.seconds.iter().sum::<f64>(), self.seconds.len());
        (repeats >= FEWEST && spent >= LEAST) || spent >= LONGEST || repeats >= MOST
    }
}

/// Time (s) of the steps of a level; for a run that fails, the time until then.
///
/// # Errors
/// One line with the reason why there is no such run.
pub(crate) fn seconds(
    plan: &ConvergencePlan,
    case: &Case,
    level: LevelPlan,
) -> Result<f64, SubjectError> {
    seconds_of(plan, case, level, || subject(plan, case.method, level))
}

/// Time (s) of the steps of a subject on a level. For an external solver it includes the response
/// time.
fn seconds_of(
    plan: &ConvergencePlan,
    case: &Case,
    level: LevelPlan,
    make: impl FnOnce() -> Result<Box<dyn Subject>, SubjectError> + Send,
) -> Result<f64, SubjectError> {
    let clock = case.clock(plan, level.dt).ok_or("the time step is invalid")?;
    alone(|| {
        let mut subject = make()?;
        let watch = LoadMonitor::start();
        for _ in 0..clock.steps {
            if subject.step(clock.dt()).is_err() {
                break;
            }
        }
        Ok(watch.stop())
    })
}

/// A suite, and what runs it.
#[derive(Clone, Copy)]
pub struct TimedPart<'a> {
    /// The suite.
    pub suite: &'a Suite,
    /// The solver of its cases, if their method is external.
    pub solver: Option<&'a dyn SolverFactory>,
}

/// Runs the parts of one suite and times every level of all of them in turn; calls `progress` after
/// each level that ran and after each that was timed. `None` without a part. Only convergence
/// studies have levels.
pub fn price(
    parts: &[TimedPart<'_>],
    extent: Extent,
    progress: &(dyn Fn() + Sync),
) -> Option<TimedSuite> {
    let mut jobs: Vec<TimingJob<'_>> = Vec::new();
    let mut outcome: Option<SuiteOutcome> = None;
    for TimedPart { suite, solver } in parts.iter().copied() {
        let before = outcome.as_ref().map_or(0, |outcome| outcome.cases.len());
        if let Some(plan) = suite.plan::<ConvergencePlan>() {
            for (index, case) in plan.cases.iter().enumerate() {
                let levels = plan.refine.levels(extent).iter().enumerate();
                jobs.extend(levels.map(|(k, level)| {
                    let (suite, level, seconds) = (suite.name.as_str(), *level, Vec::new());
                    let at = (before + index, k);
                    TimingJob { suite, plan, case, level, solver, at, seconds }
                }));
            }
        }
        let runner = Runner::over(suite, extent);
        let runner = match solver {
            Some(solver) => runner.judging(solver),
            None => runner,
        };
        SuiteOutcome::join(&mut outcome, runner.run(progress));
    }
    let outcome = outcome?;
    let observed = alone(|| {
        let mut observed = Observed::new();
        time(&mut jobs, &mut observed, progress);
        observed
    });
    let cases = &outcome.cases;
    let mut levels: Vec<Vec<(Workload, Option<Timing>)>> = vec![Vec::new(); cases.len()];
    for job in &jobs {
        let (case, level) = job.at;
        if let Some(outcome) = cases[case].convergence().and_then(|study| study.levels.get(level)) {
            levels[case].push((load(job.plan, outcome), Timing::of(&job.seconds)));
        }
    }
    Some(TimedSuite { outcome, levels, machine: observed.seen() })
}

/// Round after round until every level has been timed often enough.
fn time(jobs: &mut [TimingJob<'_>], observed: &mut Observed, progress: &(dyn Fn() + Sync)) {
    for job in jobs.iter() {
        let _ = job.run();
    }
    let mut open: Vec<usize> = (0..jobs.len()).collect();
    while !open.is_empty() {
        observed.look();
        open.retain(|k| {
            let job = &mut jobs[*k];
            let found = job.run();
            job.seconds.extend(found.iter());
            // A level whose set-up fails is not tried again.
            let done = found.is_err() || job.is_done();
            if done {
                progress();
            }
            !done
        });
    }
}

/// Load of a level that has run.
pub(crate) fn load(plan: &ConvergencePlan, level: &LevelOutcome) -> Workload {
    let (counters, steps) = (&level.run.counters, level.run.steps as f64);
    Workload {
        transfers: counters.transfers as f64,
        updates: counters.particles.unwrap_or(0) as f64 * steps,
        node_steps: nodes(&plan.scene, level.h) * steps,
        steps,
    }
}

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

/// Rounds of the loop: about a millisecond.
const ROUNDS: u32 = 250_000;

/// A pool of one thread; `None` if the system cannot create one.
static ALONE: LazyLock<Option<ThreadPool>> =
    LazyLock::new(|| ThreadPoolBuilder::new().num_threads(1).build().ok());

/// Does `work` on one thread, all of it: large scenes would use more.
pub(crate) fn alone<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    match &*ALONE {
        Some(pool) => pool.install(work),
        None => work(),
    }
}

/// A machine under observation.
pub(crate) struct Observed {
    load: Option<f64>,
    loops: Vec<f64>,
    passed: Instant,
    waited: Option<f64>,
}

/// Time (s) of a piece of work: wall time, and the part in which this thread waited for a core, if
/// the system reports it.
pub(crate) struct LoadMonitor {
    start: Instant,
    waited: Option<f64>,
}

impl LoadMonitor {
    /// From now on.
    pub(crate) fn start() -> Self {
        Self { waited: waited(), start: Instant::now() }
    }

    /// Until now, without the waiting.
    pub(crate) fn stop(self) -> f64 {
        let passed = self.start.elapsed().as_secs_f64();
        let idle = self.waited.zip(waited()).map_or(0.0, |(before, after)| after - before);
        // A value that is not positive is invalid.
        if idle > 0.0 && idle < passed { passed - idle } else { passed }
    }
}

/// Seconds for which this thread has been ready to run and waited: the second number of `schedstat`
/// (Linux, Documentation/scheduler/sched-stats).
fn waited() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().nth(1)?.parse().ok()?;
    Some(1e-9 * nanoseconds)
}

impl Observed {
    /// From now on.
    pub(crate) fn new() -> Self {
        let loops = Vec::new();
        Self { load: load_average(), loops, passed: Instant::now(), waited: waited() }
    }

    /// Runs and times the loop once.
    pub(crate) fn look(&mut self) {
        let watch = LoadMonitor::start();
        let mut x = black_box(0.5_f64);
        for _ in 0..ROUNDS {
            x = x * 0.999 + 0.001;
        }
        black_box(x);
        self.loops.push(watch.stop());
    }

    /// The machine as observed.
    pub(crate) fn seen(self) -> Machine {
        Machine {
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            load: self.load.zip(load_average()).map(|(before, after)| [before, after]),
            waited: self
                .waited
                .zip(waited())
                .map(|(before, after)| (after - before) / self.passed.elapsed().as_secs_f64()),
            fixed_loop: Timing::of(&self.loops),
        }
    }
}

/// Load average over the last minute, if the system has a file with it.
fn load_average() -> Option<f64> {
    std::fs::read_to_string("/proc/loadavg").ok()?.split_whitespace().next()?.parse().ok()
}

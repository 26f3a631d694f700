//! Cost of suites in seconds: measured times of levels.
//!
//! Errors are measured in the same parallel runs as for reports. Then every level runs again, alone
//! on one thread, and its steps are timed. The times exclude the set-up and the computation of
//! errors.
//!
//! After one run to warm up, a level is timed at least five times and for at least 50 ms in total.
//! Measuring ends early after one second or 200 measurements. All levels are timed in turn, in
//! several rounds, so a slowdown of the machine affects all of them. Time during which other
//! processes used the core is excluded, if the system reports it.

use crate::external::SolverFactory;
use crate::study::handover::subject_under;
use crate::study::runner::Runner;
use crate::study::setup::dispatch::subject;
use crate::subject::{Subject, SubjectError};
use crate::suite::model::refine_plan::{Extent, LevelPlan};
use crate::suite::model::{Case, ConvergencePlan, Suite};
use crate::verify::{
    LevelOutcome, Machine, Ranked, SuiteOutcome, TimedSuite, Timing, Workload, by_transfers,
};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::hint::black_box;
use std::sync::LazyLock;
use std::time::Instant;

/// Minimum number of time measurements of a level.
const FEWEST: usize = 5;

/// Minimum total time (s) of all measurements of a level.
const LEAST: f64 = 0.05;

/// Total time (s) of the measurements after which a level is not measured again.
const LONGEST: f64 = 1.0;

/// Maximum number of time measurements of a level.
const MOST: usize = 200;

struct TimingJob<'a> {
    suite: &'a str,
    plan: &'a ConvergencePlan,
    case: &'a Case,
    level: LevelPlan,
    solver: Option<&'a dyn SolverFactory>,
    /// Index of the case, and index of the level in the case.
    at: (usize, usize),
    seconds: Vec<f64>,
}

impl TimingJob<'_> {
    fn run(&self) -> Result<f64, SubjectError> {
        let Self { suite, plan, case, level, solver, .. } = *self;
        seconds_of(plan, case, level, || subject_under(solver, suite, plan, case, level))
    }
}

/// Whether these measured times (s) of a level are enough.
fn is_done(seconds: &[f64]) -> bool {
    let (spent, repeats) = (seconds.iter().sum::<f64>(), seconds.len());
    (repeats >= FEWEST && spent >= LEAST) || spent >= LONGEST || repeats >= MOST
}

/// Measures the time (s) of the steps of a solver on a level, until the run ends or fails. The
/// response time of external solvers is included.
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

/// A suite, and the solver that runs it.
#[derive(Clone, Copy)]
pub struct TimedPart<'a> {
    /// The suite.
    pub suite: &'a Suite,
    /// Solver of the cases whose method is external.
    pub solver: Option<&'a dyn SolverFactory>,
}

/// Runs the parts of one suite and measures the times of all their levels in turn. Calls `progress`
/// after each run and after each measured level. `None` if there are no parts. Only convergence
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
        if let Some(plan) = suite.convergence() {
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
            levels[case].push((load(outcome), Timing::of(&job.seconds)));
        }
    }
    Some(TimedSuite { outcome, levels, machine: observed.seen() })
}

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
            // A level whose set-up fails is not repeated.
            let done = found.is_err() || is_done(&job.seconds);
            if done {
                progress();
            }
            !done
        });
    }
}

fn load(level: &LevelOutcome) -> Workload {
    let (counters, steps) = (&level.run.counters, level.run.steps as f64);
    Workload {
        transfers: counters.transfers as f64,
        updates: counters.particles.unwrap_or(0) as f64 * steps,
        steps,
    }
}

/// A level that reaches a target error and runs on one thread.
#[derive(Debug)]
pub struct Goal<'a> {
    plan: &'a ConvergencePlan,
    case: &'a Case,
    level: LevelPlan,
    error: f64,
}

/// Returns the cheapest level of each method of the suite's first problem that reaches `target`,
/// sorted by cost. The level must be in the method's converging part, and its error relative to the
/// size of the solution must be at most `target`. Methods that do not reach the target are
/// excluded.
pub fn goals(suite: &Suite, target: f64) -> Vec<Goal<'_>> {
    let Some(plan) = suite.convergence() else { return Vec::new() };
    let ranked = by_transfers(&Runner::new(suite).run(&|| ()).cases);
    let goal = |row: &Ranked| {
        let case = plan.cases.iter().find(|case| case.name == row.method.name)?;
        let k = row.part.levels.clone().find(|k| row.method.samples[*k].error <= target)?;
        let level = *plan.refine.levels.get(k)?;
        let sample = row.method.samples[k];
        Some((sample, Goal { plan, case, level, error: sample.error }))
    };
    let rows = ranked.first().map_or(&[][..], |ranking| &ranking.rows);
    let mut goals: Vec<_> = rows.iter().filter_map(goal).collect();
    goals.sort_by(|(a, _), (b, _)| a.work.total_cmp(&b.work));
    goals.into_iter().map(|(_, goal)| goal).collect()
}

impl Goal<'_> {
    /// Returns the name of the case.
    pub fn case(&self) -> &str {
        &self.case.name
    }

    /// Returns the number of cells along the first axis.
    pub fn cells(&self) -> u64 {
        self.level.cells
    }

    /// Returns the error relative to the size of the solution, from the judged run.
    pub fn error(&self) -> f64 {
        self.error
    }

    /// Sets up the level and runs its steps; returns the time of the steps (s).
    ///
    /// # Errors
    /// The reason why the level cannot be set up.
    pub fn seconds(&self) -> Result<f64, SubjectError> {
        let Self { plan, case, level, .. } = *self;
        seconds_of(plan, case, level, || subject(plan, case.method, level))
    }
}

/// Number of iterations of the fixed loop, which takes about a millisecond.
const ROUNDS: u32 = 250_000;

static ALONE: LazyLock<Option<ThreadPool>> =
    LazyLock::new(|| ThreadPoolBuilder::new().num_threads(1).build().ok());

/// Runs `work` on one thread, even if the scene is so large that it would use several.
fn alone<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    match &*ALONE {
        Some(pool) => pool.install(work),
        None => work(),
    }
}

struct Observed {
    load: Option<f64>,
    loops: Vec<f64>,
    passed: Instant,
    waited: Option<f64>,
}

/// Measures the time (s) of a piece of work, without the time spent waiting for a core.
struct LoadMonitor {
    start: Instant,
    waited: Option<f64>,
}

impl LoadMonitor {
    fn start() -> Self {
        Self { waited: waited(), start: Instant::now() }
    }

    /// Ends the measurement and returns the time (s).
    fn stop(self) -> f64 {
        let passed = self.start.elapsed().as_secs_f64();
        let idle = self.waited.zip(waited()).map_or(0.0, |(before, after)| after - before);
        // A waiting time outside this range is invalid.
        if idle > 0.0 && idle < passed { passed - idle } else { passed }
    }
}

/// Returns the time (s) for which this thread was ready to run but waited for a core: the second
/// number of `schedstat` (Linux, Documentation/scheduler/sched-stats).
fn waited() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().nth(1)?.parse().ok()?;
    Some(1e-9 * nanoseconds)
}

impl Observed {
    fn new() -> Self {
        let loops = Vec::new();
        Self { load: load_average(), loops, passed: Instant::now(), waited: waited() }
    }

    fn look(&mut self) {
        let watch = LoadMonitor::start();
        let mut x = black_box(0.5_f64);
        for _ in 0..ROUNDS {
            x = x * 0.999 + 0.001;
        }
        black_box(x);
        self.loops.push(watch.stop());
    }

    fn seen(self) -> Machine {
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

fn load_average() -> Option<f64> {
    std::fs::read_to_string("/proc/loadavg").ok()?.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measurements_end_after_enough_of_them_or_enough_time() {
        let enough = [(5, 0.0101), (1, 1.01), (2, 0.501), (200, 1e-6), (4, 0.251)];
        assert_eq!(enough.map(|(count, each)| is_done(&vec![each; count])), [true; 5]);
        let short = [(4, 0.2), (5, 0.0099), (1, 0.99), (199, 1e-6), (0, 0.0)];
        assert_eq!(short.map(|(count, each)| is_done(&vec![each; count])), [false; 5]);
    }
}

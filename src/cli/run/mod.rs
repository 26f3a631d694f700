//! `mpm-verify run` and `mpm-verify merge`.

mod args;
mod files;
mod gate;
mod last_failed;
mod printing;
mod progress;
mod queue;

use super::output::{CommandError, Status};
use super::suite_runs::{self, SuitePart, SuiteRuns};
use super::{output, select, snapshots, solver};
use args::ReportArgs;
pub(super) use args::{JudgeArgs, MergeArgs, RunArgs};
use files::Series;
use gate::{JudgedSolver, SolverGate};
use mpm_verify::external::ResultFolder;
use mpm_verify::report::{self, RunTimes};
use mpm_verify::study::{ResultCache, Runner, StepWarning, result_levels, unit_seconds};
use mpm_verify::subject::{HIGHEST_ORDER, Precision, is_solver_name};
use mpm_verify::suite::yaml::Source;
use mpm_verify::suite::{Extent, ExternalMethod, Suite};
use mpm_verify::verify::{SuiteOutcome, Verdict};
use printing::Printing;
use progress::RunProgress;
use queue::{Job, JobOutput, in_order};
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant, SystemTime};

pub(super) fn run(args: &RunArgs) -> Result<Status, CommandError> {
    threads(args.report.jobs)?;
    report(&args.report, args.snapshots.as_deref(), |suites| chosen(args, suites))
}

/// Runs suites for a first look: also draws a convergence plot, and suggests commands.
pub(super) fn first(args: &mut RunArgs) -> Result<Status, CommandError> {
    args.report.print.plot = true;
    run(args)
}

pub(super) fn merge(args: &MergeArgs) -> Result<Status, CommandError> {
    threads(args.report.jobs)?;
    let parts = ResultCache::of_parts(&args.from)
        .map_err(|(folder, error)| CommandError::option("--from", folder.display(), error))?;
    // All results are those of the parts, and no level runs.
    let kept = Judging { kept: Some(parts), ..Judging::default() };
    report(&args.report, None, |suites| Ok((SuiteRuns::of_methods(suites), kept)))
}

pub(super) fn judge(args: &JudgeArgs) -> Result<Status, CommandError> {
    threads(args.report.jobs)?;
    report(&args.report, None, |suites| with_results(args, &suites))
}

fn with_results(
    args: &JudgeArgs,
    suites: &[Suite],
) -> Result<(Vec<SuiteRuns>, Judging), CommandError> {
    let suite = match suites {
        [suite] => suite,
        [] => return Ok((Vec::new(), Judging::default())),
        _ => return Err(CommandError::Message("expected one suite".to_owned())),
    };
    let (name, formal_order) = (args.name.as_str(), args.formal_order);
    if !is_solver_name(name) {
        return Err(CommandError::option(
            "--name",
            name,
            "expected letters, digits, `-`, `_` or `.`",
        ));
    }
    if !(formal_order > 0.0 && formal_order <= HIGHEST_ORDER) {
        let reason = format!("expected a number above 0 and up to {HIGHEST_ORDER}");
        return Err(CommandError::option("--formal-order", formal_order, reason));
    }
    let precision = if args.single { Precision::Single } else { Precision::Double };
    let method = ExternalMethod { name, formal_order, precision };
    let levels = result_levels(suite, method, extent(&args.report))
        .map_err(|reason| CommandError::about(&suite.name, reason))?;
    let solver = ResultFolder::read(&args.from, &levels, name, formal_order, precision)?;
    let named = select::named_singly(&args.report.targets.targets, suites);
    let (judged, gate) = gate::prepare(suites.to_vec(), &solver, &args.gate, &named)?;
    let solvers = vec![JudgedSolver { solver: Box::new(solver), gate }];
    let runs = SuiteRuns::of_solvers(suites, vec![judged], false);
    Ok((runs, Judging { solvers, ..Judging::default() }))
}

fn chosen(args: &RunArgs, suites: Vec<Suite>) -> Result<(Vec<SuiteRuns>, Judging), CommandError> {
    let repeat = repetitions(args)?;
    let kept = args.resume.as_deref().map(open).transpose()?;
    let all = args.case.is_some();
    let series = args.vtu.as_deref().map(|folder| Series::prepare(folder, all)).transpose()?;
    let mut solvers = Vec::new();
    let mut of_each = Vec::new();
    let named = select::named_singly(&args.report.targets.targets, &suites);
    for solver in solver::greet_all(&args.programs)? {
        let (judged, gate) = gate::prepare(suites.clone(), &solver, &args.gate, &named)?;
        solvers.push(JudgedSolver { solver: Box::new(solver), gate });
        of_each.push(judged);
    }
    let mut runs = if solvers.is_empty() {
        SuiteRuns::of_methods(suites)
    } else {
        SuiteRuns::of_solvers(&suites, of_each, args.programs.with_methods)
    };
    suite_runs::check_names(&runs)?;
    if args.last_failed {
        runs = last_failed::select(runs)?;
    }
    if let Some(text) = &args.case {
        runs = runs.into_iter().filter_map(|runs| runs.only(|case| case.contains(text))).collect();
        if runs.is_empty() {
            return Err(CommandError::option("--case", text, "no case name contains this text"));
        }
    }
    if let Some(shard) = args.shard {
        if args.programs.with_methods || solvers.len() > 1 {
            let reason = "shards are supported for one solver, or for the built-in methods";
            return Err(CommandError::about("--shard", reason));
        }
        runs = SuiteRuns::shard(runs, shard, extent(&args.report));
        if runs.is_empty() {
            output::complain("note: this shard has no case");
        }
    }
    let at_interrupt = Some(progress::interrupt_note(args.resume.is_some()));
    Ok((runs, Judging { kept, solvers, repeat, series, at_interrupt }))
}

/// Number of suites that may wait for their cases at the same time, per thread. With several, a
/// thread that finishes its part of one suite starts another suite.
const WAITING: usize = 4;

/// Minimum predicted time (s) on one thread of a long suite, which starts only after all earlier
/// suites have ended. A thread that waits for a level of an earlier suite works on later suites,
/// and would delay the report of the earlier suite.
const LONG: f64 = 10.0;

/// Runs cases in parallel, and prints the reports in the order of the suites. Reports of finished
/// suites are printed even if a later file is invalid.
fn report(
    args: &ReportArgs,
    snapshots: Option<&str>,
    choose: impl FnOnce(Vec<Suite>) -> Result<(Vec<SuiteRuns>, Judging), CommandError>,
) -> Result<Status, CommandError> {
    args.out.as_deref().map_or(Ok(()), files::prepare_out)?;
    for (option, file) in [("--html", &args.html), ("--junit", &args.junit)] {
        file.as_deref().map_or(Ok(()), |file| files::prepare_file(option, file))?;
    }
    let (suites, refused): (Vec<_>, Vec<_>) =
        select::with_sources(&args.targets.targets).into_iter().partition(Result::is_ok);
    let (sources, suites): (Vec<Source>, Vec<Suite>) =
        suites.into_iter().filter_map(Result::ok).unzip();
    let names: Vec<String> = suites.iter().map(|suite| suite.name.clone()).collect();
    let (runs, mut judging) = choose(suites)?;
    printing::check(args, &runs)?;
    let suites: Vec<Suite> = runs.iter().map(|runs| runs.suite().clone()).collect();
    // Keeps the sources of suites with a selected case, in the order of `suites`.
    let is_chosen = |(name, _): &(String, Source)| suites.iter().any(|suite| suite.name == *name);
    let sources = names.into_iter().zip(sources).filter(is_chosen);
    let sources: Vec<Source> = sources.map(|(_, source)| source).collect();
    let twice = suite_runs::repeated(suites.iter().map(|suite| suite.name.as_str()));
    for (option, given, clash) in [
        ("--out", args.out.is_some(), "would write the same files"),
        ("--html", args.html.is_some(), "would share one section"),
    ] {
        if let Some(name) = twice.filter(|_| given) {
            let reason = format!("two suites have the name `{name}` and {clash}");
            return Err(CommandError::about(option, reason));
        }
    }
    let printing = Printing::of(args, suites.len());
    let parts = runs.iter().flat_map(|runs| &runs.parts).map(|part| &part.suite);
    let bar = RunProgress::over(parts, extent(args), args.print.quiet);
    if let Some(note) = &judging.at_interrupt {
        bar.note_at_interrupt(note.clone());
    }
    let results = run_all(args, &runs, &judging, &bar, printing);
    let RunResults { outcomes, numbers, of_solvers, times } = results;
    let sources: Vec<Source> = numbers.iter().map(|number| sources[*number].clone()).collect();
    if args.fail_fast && numbers.len() < runs.len() {
        let rest = report::counted(runs.len() - numbers.len(), "suite");
        output::complain(&format!("note: a case failed, so {rest} did not start (--fail-fast)"));
    }
    if let Err(error) = last_failed::record(&outcomes) {
        output::complain(&format!("warning: the failed cases cannot be recorded: {error}"));
    }
    let series = judging.series.take().and_then(Series::failure).map_or(Ok(()), Err);
    bar.clear();
    printing.of_all(args, &outcomes);
    let written =
        args.out.as_deref().map_or(Ok(()), |folder| files::write_out(folder, args, &outcomes));
    let page = |file| files::write_page(file, &sources, &outcomes, refused.len(), times.start);
    let junit = |file| files::write_junit(file, &outcomes, &judging.required(), &times);
    let mut passed = outcomes.iter().all(SuiteOutcome::passed);
    let compare = |folder: &str| {
        let print = if printing.is_text() { output::print } else { output::complain };
        // Without a folder, snapshots are next to the suites.
        let folder = Some(Path::new(folder)).filter(|_| !folder.is_empty());
        snapshots::compare(folder, &sources, &outcomes, print)
    };
    let written = written.and(snapshots.map_or(Ok(true), compare).map(|same| passed &= same));
    let written = written.and(args.html.as_deref().map_or(Ok(()), page));
    let written = written.and(args.junit.as_deref().map_or(Ok(()), junit)).and(series);
    for diagnostic in refused.iter().filter_map(|refused| refused.as_ref().err()) {
        output::diagnose(diagnostic);
    }
    if let Err(error) = &written {
        output::complain(&error.to_string());
    }
    let unkept = judging.kept.as_ref().and_then(ResultCache::diagnostic);
    if let Some(diagnostic) = &unkept {
        output::complain(&format!("error: --resume {diagnostic}"));
    }
    if !refused.is_empty() || written.is_err() || unkept.is_some() {
        return Ok(Status::BadInput);
    }
    let any = of_solvers.iter().any(|outcomes| !outcomes.is_empty());
    for (solver, outcomes) in judging.solvers.iter().zip(&of_solvers) {
        // A solver has no outcomes if `--case` selects only cases of other solvers.
        if outcomes.is_empty() && any {
            continue;
        }
        if !solver::is_applicable(outcomes) {
            output::complain("error: no case is applicable to the solver");
            return Ok(Status::Failed);
        }
        let failed = Verdict::Failed.name();
        let mut cases = outcomes.iter().flat_map(|outcome| &outcome.cases);
        if solver.gate.is_none() && cases.all(|case| !case.is_tested() || case.verdict == failed) {
            output::complain(
                "warning: the solver fails in every case; `mpm-verify doctor` finds the cause, and \
                 `--gate` turns failed cases into exit status 1",
            );
        }
        // `passes` is called even if cases have failed, because it prints the skipped suites.
        passed &= solver.gate.as_ref().is_none_or(|gate| gate.passes(outcomes));
    }
    printing.end(args, &sources, &outcomes, times.whole);
    Ok(if passed { Status::Passed } else { Status::Failed })
}

struct RunResults {
    outcomes: Vec<SuiteOutcome>,
    /// Index of the suite of each outcome.
    numbers: Vec<usize>,
    /// Outcomes for each solver, in the order of [`Judging::solvers`], for the check of its gate.
    of_solvers: Vec<Vec<SuiteOutcome>>,
    times: RunTimes,
}

struct JobResult {
    /// Outcome of each part, with the index of its solver; `None` for the methods of the suite.
    parts: Vec<(Option<usize>, SuiteOutcome)>,
    time: Duration,
}

/// Runs all suites, and prints each report when the suite and all earlier ones have ended.
fn run_all(
    args: &ReportArgs,
    runs: &[SuiteRuns],
    judging: &Judging,
    bar: &RunProgress,
    printing: Printing,
) -> RunResults {
    let mut of_solvers: Vec<Vec<SuiteOutcome>> = vec![Vec::new(); judging.solvers.len()];
    let mut outcomes: Vec<SuiteOutcome> = Vec::new();
    let mut times =
        RunTimes { start: SystemTime::now(), whole: Duration::ZERO, suites: Vec::new() };
    let start = Instant::now();
    let (mut numbers, mut count) = (Vec::new(), 0);
    let has_failed = AtomicBool::new(false);
    let run = |job: &mut Job<'_, _>| {
        let start = Instant::now();
        let is_skipped = args.fail_fast && has_failed.load(Ordering::Relaxed);
        let parts = if is_skipped { &[][..] } else { &runs[job.number].parts }.iter();
        let parts = parts.map(|part| (part.solver, one(part, args, judging, bar, job))).collect();
        let result = JobResult { parts, time: start.elapsed() };
        if result.parts.iter().any(|(_, outcome): &(_, SuiteOutcome)| !outcome.passed()) {
            has_failed.store(true, Ordering::Relaxed);
        }
        result
    };
    // The speed of an external solver is unknown.
    let is_long = |runs: &SuiteRuns| {
        let seconds = |suite| unit_seconds(suite, extent(args)).iter().sum::<f64>();
        let mut parts = runs.parts.iter();
        parts.any(|part| part.solver.is_some() || seconds(&part.suite) > LONG)
    };
    let are_long: Vec<bool> = runs.iter().map(is_long).collect();
    let waiting = if args.fail_fast { 1 } else { WAITING };
    let threads = waiting * rayon::current_num_threads();
    let take = |sent: JobOutput<JobResult>| {
        let JobResult { parts, time } = match sent {
            JobOutput::Message(text) => return bar.suspend(|| output::complain(&text)),
            JobOutput::Result(parts) => parts,
        };
        let number = count;
        count += 1;
        let mut joined: Option<SuiteOutcome> = None;
        for (solver, outcome) in parts {
            if let Some(number) = solver {
                of_solvers[number].push(outcome.clone());
            }
            SuiteOutcome::join(&mut joined, outcome);
        }
        if let Some(outcome) = joined {
            bar.suspend(|| printing.of_suite(&outcome));
            outcomes.push(outcome);
            numbers.push(number);
            times.suites.push(time);
        }
    };
    in_order(runs.len(), threads, |number| are_long[number], run, take);
    times.whole = start.elapsed();
    RunResults { outcomes, numbers, of_solvers, times }
}

fn threads(jobs: Option<usize>) -> Result<(), CommandError> {
    const MOST: usize = 1024;
    let Some(jobs) = jobs else { return Ok(()) };
    if !(1..=MOST).contains(&jobs) {
        let reason = format!("expected a number from 1 to {MOST}");
        return Err(CommandError::option("--jobs", jobs, reason));
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(jobs);
    pool.build_global().map_err(|error| CommandError::option("--jobs", jobs, error))
}

/// Returns the number of runs of each level. Refuses a `--repeat` that would measure no spread, or
/// would mix stored results with new ones.
fn repetitions(args: &RunArgs) -> Result<usize, CommandError> {
    const MOST: usize = 100;
    let Some(repeat) = args.repeat else { return Ok(1) };
    let reason = if args.resume.is_some() {
        "stored levels have one run each, so no spread: remove `--resume`".to_owned()
    } else if repeat < 2 {
        "a spread needs two runs or more".to_owned()
    } else if repeat > MOST {
        format!("expected a number from 2 to {MOST}")
    } else {
        return Ok(repeat);
    };
    Err(CommandError::option("--repeat", repeat, reason))
}

fn extent(args: &ReportArgs) -> Extent {
    if args.full { Extent::Full } else { Extent::Usual }
}

#[derive(Default)]
struct Judging {
    kept: Option<ResultCache>,
    solvers: Vec<JudgedSolver>,
    /// Number of runs of each level; 0 means 1.
    repeat: usize,
    series: Option<Series>,
    at_interrupt: Option<String>,
}

impl Judging {
    /// Returns the suites whose cases must all be tested for the gates to pass.
    fn required(&self) -> BTreeSet<String> {
        let gates = self.solvers.iter().filter_map(|solver| solver.gate.as_ref());
        gates.flat_map(SolverGate::required).collect()
    }
}

fn one<T>(
    part: &SuitePart,
    args: &ReportArgs,
    judging: &Judging,
    bar: &RunProgress,
    job: &mut Job<'_, T>,
) -> SuiteOutcome {
    let suite = &part.suite;
    let progress = bar.start(suite, extent(args));
    let runner =
        Runner::over(suite, extent(args)).keeping(judging.kept.as_ref()).repeating(judging.repeat);
    let runner = match part.solver {
        Some(number) => runner.judging(judging.solvers[number].solver.as_ref()),
        None => runner,
    };
    let text = |warning: &StepWarning| format!("warning: {}", warning.text);
    // A suite may use too long steps deliberately, so only failing cases get these warnings.
    let (later, now): (Vec<_>, Vec<_>) =
        runner.warnings().into_iter().partition(|one| one.is_too_long && !suite.explores());
    for warning in &now {
        job.say(text(warning));
    }
    job.let_next_start();
    let outcome = runner.run(&|| progress.inc());
    for warning in later.iter().filter(|warning| !outcome.cases[warning.case].passed()) {
        job.say(text(warning));
    }
    if let Some(series) = &judging.series {
        series.write(&runner, &outcome, &|note| job.say(note));
    }
    if suite.explores() && part.solver.is_none() && !args.print.quiet {
        let name = &suite.name;
        job.say(format!(
            "note: {name} has no expectations, so it is not a gate; `mpm-verify propose` writes \
             expectations"
        ));
    }
    outcome
}

fn open(folder: &Path) -> Result<ResultCache, CommandError> {
    ResultCache::open(folder)
        .map_err(|error| CommandError::option("--resume", folder.display(), error))
}

//! `mpm-verify cost`: measures the cost of accuracy on this machine.

use super::arguments::{FormatArgs, SolversArgs, Targets};
use super::output::{CommandError, Status};
use super::suite_runs::{self, SuiteRuns};
use super::{output, select, solver};
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use mpm_verify::external::{SolverFactory, SolverProgram};
use mpm_verify::report;
use mpm_verify::study::cost::{TimedPart, price};
use mpm_verify::suite::{Extent, Suite};
use mpm_verify::verify::{TimedSuite, by_transfers};
use std::path::{Path, PathBuf};
use std::{fs, io};

#[derive(Debug, Args)]
pub(super) struct CostArgs {
    #[command(flatten)]
    targets: Targets,
    #[command(flatten)]
    format: FormatArgs,
    /// Also print all levels with their times, and the work in particle-node transfers
    #[arg(long)]
    verbose: bool,
    /// Write work-precision diagrams into this folder
    #[arg(long, value_name = "DIR")]
    figures: Option<PathBuf>,
    /// Also measure the finer levels that suites list under `full`
    #[arg(long)]
    full: bool,
    #[command(flatten)]
    programs: SolversArgs,
}

/// Measures suites one after the other, because parallel runs would distort the times.
pub(super) fn cost(args: &CostArgs) -> Result<Status, CommandError> {
    if let Some(folder) = &args.figures {
        fs::create_dir_all(folder).map_err(|error| unwritable(folder, &error))?;
    }
    let (suites, refused): (Vec<_>, Vec<_>) =
        select::suites(&args.targets.targets).into_iter().partition(Result::is_ok);
    let suites: Vec<Suite> = suites.into_iter().filter_map(Result::ok).collect();
    let found = prices(suites, args)?;
    for diagnostic in refused.iter().filter_map(|refused| refused.as_ref().err()) {
        output::diagnose(diagnostic);
    }
    Ok(if refused.is_empty() { found } else { Status::BadInput })
}

fn prices(suites: Vec<Suite>, args: &CostArgs) -> Result<Status, CommandError> {
    let solvers = solver::greet_all(&args.programs)?;
    let runs = if solvers.is_empty() {
        SuiteRuns::of_methods(suites)
    } else {
        let judged =
            |solver: &SolverProgram| solver::suites_of_solver(suites.clone(), solver, |_| None).0;
        let of_each = solvers.iter().map(judged).collect();
        SuiteRuns::of_solvers(&suites, of_each, args.programs.with_methods)
    };
    suite_runs::check_names(&runs)?;
    let mut all: Vec<TimedSuite> = Vec::new();
    let mut code = Status::Passed;
    let has_levels = |runs: &&SuiteRuns| runs.suite().convergence().is_some();
    for timed in runs.iter().filter(has_levels).filter_map(|runs| one(runs, &solvers, args)) {
        if !args.format.is_json() {
            output::print(&format!("{}\n", report::timed(&timed, args.verbose)));
        }
        if let Some(Err(error)) = args.figures.as_deref().map(|folder| draw(folder, &timed)) {
            output::complain(&error.to_string());
            code = Status::BadInput;
        }
        all.push(timed);
    }
    if args.format.is_json() {
        output::print(&report::timed_json(&all));
    } else {
        if let Some(folder) = &args.figures {
            output::print(&format!("wrote {}\n", folder.display()));
        }
        if let Some(suite) = all.first().map(|timed| &timed.outcome.suite) {
            output::next([
                (&*format!("cost --verbose {suite}"), "every level"),
                (&*format!("cost --figures DIR {suite}"), "work-precision diagrams"),
            ]);
        }
    }
    Ok(code)
}

fn one(runs: &SuiteRuns, solvers: &[SolverProgram], args: &CostArgs) -> Option<TimedSuite> {
    let extent = if args.full { Extent::Full } else { Extent::Usual };
    let levels = |suite: &Suite| {
        let plan = suite.convergence();
        plan.map_or(0, |plan| plan.cases.len() * plan.refine.levels(extent).len())
    };
    let levels: usize = runs.parts.iter().map(|part| levels(&part.suite)).sum();
    // Each level runs once to measure its error and once to measure its time.
    let bar = ProgressBar::with_draw_target(Some(2 * levels as u64), ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len} levels  {msg}") {
        bar.set_style(style);
    }
    bar.set_message(runs.suite().name.clone());
    let factory = |number: usize| &solvers[number] as &dyn SolverFactory;
    let parts = runs.parts.iter();
    let parts: Vec<TimedPart<'_>> = parts
        .map(|part| TimedPart { suite: &part.suite, solver: part.solver.map(factory) })
        .collect();
    let timed = price(&parts, extent, &|| bar.inc(1));
    bar.finish_and_clear();
    timed
}

fn draw(folder: &Path, timed: &TimedSuite) -> Result<(), CommandError> {
    let outcome = &timed.outcome;
    let seconds = "seconds of the steps, one thread";
    let transfers = "particle-node transfers";
    let mut figures = report::cost_figures(outcome, &timed.by_seconds(), seconds, "seconds");
    let counted = by_transfers(&timed.outcome.cases);
    figures.extend(report::cost_figures(outcome, &counted, transfers, "transfers"));
    for figure in figures {
        for (file, text) in
            [(&figure.file, &figure.svg), (&figure.pgfplots_file(), &figure.pgfplots)]
        {
            let path = folder.join(file);
            fs::write(&path, text).map_err(|error| unwritable(&path, &error))?;
        }
    }
    Ok(())
}

fn unwritable(path: &Path, error: &io::Error) -> CommandError {
    CommandError::option("--figures", path.display(), error)
}

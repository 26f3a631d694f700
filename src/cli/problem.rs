//! `mpm-verify problem`: writes a level of a suite as a file.

use super::arguments::{Expected, number, whole};
use super::output::{CommandError, Status};
use super::{output, select};
use clap::Args;
use mpm_verify::external::ProblemFormat;
use mpm_verify::study::{exact_state, level_problem};
use mpm_verify::suite::Suite;
use std::io::{IsTerminal, stdout};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(super) struct ProblemArgs {
    /// Suite: a file, a name, or `-` for standard input
    #[arg(value_name = "SUITE")]
    suite: PathBuf,
    /// Number of the level; the coarsest is 1 [default: the finest that `run` uses without
    /// `--full`]
    #[arg(long, value_name = "N", value_parser = whole, allow_negative_numbers = true)]
    level: Option<usize>,
    /// Write the exact state at this time (s) instead of the initial state
    #[arg(long, value_name = "T", value_parser = number, allow_negative_numbers = true)]
    at: Option<f64>,
    /// Format of the output: csv, json, npz, vtu
    #[arg(long, alias = "out", value_name = "FORMAT", value_parser = format, default_value = "csv")]
    format: ProblemFormat,
}

fn format(name: &str) -> Result<ProblemFormat, Expected> {
    let known = ProblemFormat::ALL;
    let names = || known.iter().map(|format| format.name()).collect::<Vec<_>>().join(", ");
    let found = known.iter().find(|format| format.name() == name);
    found.copied().ok_or_else(|| Expected(format!("one of {}", names()).into()))
}

pub(super) fn problem(args: &ProblemArgs) -> Result<Status, CommandError> {
    if args.format.is_binary() && stdout().is_terminal() {
        let format = args.format.name();
        return Err(CommandError::Message(format!(
            "{format} is binary and cannot be printed on a terminal: redirect it, `> \
             problem.{format}`"
        )));
    }
    let suites = select::suites(std::slice::from_ref(&args.suite));
    let written = suites.into_iter().map(|suite| of_suite(&suite?, args));
    let files: Vec<Vec<u8>> = written.collect::<Result<_, CommandError>>()?;
    let [file] = files.as_slice() else {
        let message = "expected one suite, not a folder of suites";
        return Err(CommandError::Message(message.to_owned()));
    };
    output::print_bytes(file);
    Ok(Status::Passed)
}

fn of_suite(suite: &Suite, args: &ProblemArgs) -> Result<Vec<u8>, CommandError> {
    let name = &suite.name;
    let plan = suite
        .convergence()
        .ok_or_else(|| CommandError::about(name, "it is not a convergence study"))?;
    let levels = &plan.refine.levels;
    let number = args.level.unwrap_or(plan.refine.usual);
    let level = number.checked_sub(1).and_then(|index| levels.get(index)).ok_or_else(|| {
        let reason = format!("there is no level {number}: expected 1 to {}", levels.len());
        CommandError::about(name, reason)
    })?;
    let until = plan.cases[0].until;
    if let Some(t) = args.at.filter(|t| !(0.0..=until).contains(t)) {
        let reason = format!("`--at {t}` is not a time of the run: expected 0 to {until} s");
        return Err(CommandError::about(name, reason));
    }
    let mut problem = level_problem(name, plan, &plan.cases[0], *level)
        .map_err(|reason| CommandError::about(name, reason))?;
    if let Some(t) = args.at {
        problem.particles = exact_state(plan, &problem.particles, t)
            .map_err(|reason| CommandError::about(name, reason))?;
    }
    problem.written(args.format).map_err(|reason| CommandError::about(name, reason))
}

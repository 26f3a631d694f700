//! `mpm-verify problem`: writes a level of a suite as a file.

use super::arguments::{Expected, number, whole};
use super::output::{CommandError, Status};
use super::{output, select};
use clap::Args;
use mpm_verify::external::{
    LevelProblem, ProblemFormat, ProblemGrid, ProblemMaterial, ResultLevel,
};
use mpm_verify::study::{exact_state, level_problem, needs_of_suite, result_levels, statement};
use mpm_verify::subject::Precision;
use mpm_verify::suite::{Extent, ExternalMethod, Suite};
use std::fmt::Display;
use std::fs;
use std::io::{IsTerminal, stdout};
use std::path::{Path, PathBuf};

const ONE_SUITE: &str = "expected one suite, not a folder of suites";

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
    /// Write all levels that `run` uses into this folder, and a README that describes the problem
    /// and the results for `judge`
    #[arg(long, value_name = "DIR", conflicts_with_all = ["level", "at"])]
    all: Option<PathBuf>,
    /// Also write the finer levels that suites list under `full`
    #[arg(long, requires = "all")]
    full: bool,
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
    if let Some(folder) = &args.all {
        return write_all(folder, args);
    }
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
        return Err(CommandError::Message(ONE_SUITE.to_owned()));
    };
    output::print_bytes(file);
    Ok(Status::Passed)
}

/// Writes all levels and the file README.md. Existing files with other content are not replaced.
fn write_all(folder: &Path, args: &ProblemArgs) -> Result<Status, CommandError> {
    let suites = select::suites(std::slice::from_ref(&args.suite));
    let suites = suites.into_iter().collect::<Result<Vec<Suite>, _>>()?;
    let [suite] = &suites[..] else {
        return Err(CommandError::Message(ONE_SUITE.to_owned()));
    };
    let about = |reason: &dyn Display| CommandError::about(&suite.name, reason);
    let extent = if args.full { Extent::Full } else { Extent::Usual };
    let method = ExternalMethod { name: "", formal_order: 2.0, precision: Precision::Double };
    let levels = result_levels(suite, method, extent).map_err(|reason| about(&reason))?;
    let readme = readme(suite, &levels, folder, args);
    let mut files = vec![(folder.join("README.md"), readme.into_bytes())];
    for level in &levels {
        let bytes = level.problem.written(args.format).map_err(|error| about(&error))?;
        files.push((folder.join(format!("{}.{}", level.name, args.format.name())), bytes));
    }
    let is_other = |(path, bytes): &&(PathBuf, _)| fs::read(path).is_ok_and(|old| old != *bytes);
    if let Some((path, _)) = files.iter().find(is_other) {
        let reason = "this file exists with other content: choose another folder";
        return Err(CommandError::option("--all", path.display(), reason));
    }
    for (path, bytes) in &files {
        let made = fs::create_dir_all(folder.join("results"));
        let written = made.and_then(|()| fs::write(path, bytes));
        written.map_err(|error| CommandError::option("--all", path.display(), error))?;
    }
    output::print(&format!("wrote {}\n", folder.join("README.md").display()));
    Ok(Status::Passed)
}

fn readme(suite: &Suite, levels: &[ResultLevel], folder: &Path, args: &ProblemArgs) -> String {
    let mut text = format!("# {}\n\n{}\n\n## Problem\n\n", suite.title, suite.about.trim_end());
    for (key, value) in statement(suite) {
        text += &format!("- {key}: {value}\n");
    }
    let materials = levels.first().map_or(&[][..], |level| &level.problem.materials);
    for ProblemMaterial { law, density, parameters, .. } in materials {
        text += &format!("- material in SI units: {law}, density = {density}");
        for (key, value) in parameters {
            text += &format!(", {key} = {value}");
        }
        text += "\n";
    }
    text += "\n## Levels\n\n";
    for ResultLevel { name, problem, .. } in levels {
        let LevelProblem { grid, particles, dt, steps, instants, .. } = problem;
        let ProblemGrid { origin, h, cells, periodic, .. } = grid;
        let axes = ["x", "y", "z"].into_iter().zip(periodic);
        let along: String = axes
            .filter(|(_, is_periodic)| **is_periodic)
            .flat_map(|(axis, _)| [", periodic along ", axis])
            .collect();
        text += &format!(
            "- {name}.{}: {} particles; grid of {} cells of {h} m, lowest corner ({}) m{along}; \
             {steps} steps of {dt} s; results after steps {}, at t = {} s\n",
            args.format.name(),
            particles.len(),
            joined(cells, " x "),
            joined(origin, ", "),
            joined(instants, ", "),
            joined(&problem.times(), ", "),
        );
    }
    let needs = needs_of_suite(suite).unwrap_or_default();
    let columns = levels.first().map_or(Vec::new(), |level| level.required_columns(&needs));
    text += &format!("\nRequired columns of the results: {}\n", joined(&columns, ", "));
    let from = folder.join("results");
    let [suite, from] = [&args.suite, &from].map(|path| path.to_string_lossy());
    let words = ["mpm-verify", "judge", &suite, "--from", &from, "--gate"].into_iter();
    let command = shlex::try_join(words.chain(args.full.then_some("--full"))).unwrap_or_default();
    text + &include_str!("results.txt").replace("COMMAND", &command)
}

fn joined(values: &[impl Display], separator: &str) -> String {
    values.iter().map(ToString::to_string).collect::<Vec<_>>().join(separator)
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

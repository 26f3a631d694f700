//! The words of the command line.

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Verifies Material Point Method solvers: suites of benchmarks, observed orders, verdicts.
#[derive(Debug, Parser)]
#[command(version, about, args_conflicts_with_subcommands = true)]
pub(super) struct Cli {
    #[command(subcommand)]
    pub(super) command: Option<Command>,
    #[command(flatten)]
    pub(super) run: RunArgs,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Run suites and judge them (the default); exit status 1 if an expectation is not met, 2 on
    /// bad input
    Run(RunArgs),
    /// List suites and their cases
    List(Targets),
    /// Validate suites without running them: grammar, formulas, and the truth itself
    Check(Targets),
    /// Print the problem of a suite, its source, what a step of each case takes (effects, passes,
    /// memory), and what is expected
    Explain(ExplainArgs),
}

#[derive(Debug, Args)]
pub(super) struct Targets {
    /// Suites: a file, a folder of files, or a name; default: all of verification/, or the
    /// built-in suites where there is no such folder
    #[arg(value_name = "FILE|FOLDER|NAME")]
    pub(super) targets: Vec<PathBuf>,
}

#[derive(Debug, Args)]
pub(super) struct ExplainArgs {
    #[command(flatten)]
    pub(super) targets: Targets,
    /// Say what a step would no longer take without this effect of the scene
    #[arg(long, value_name = "EFFECT")]
    pub(super) without: Option<String>,
}

#[derive(Debug, Args)]
pub(super) struct RunArgs {
    #[command(flatten)]
    pub(super) targets: Targets,
    /// What to print
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(super) format: Format,
    /// Print the table of verdicts only, not the reports
    #[arg(long)]
    pub(super) brief: bool,
    /// Run the finer levels too that suites list under `full`: takes hours where the others take
    /// seconds
    #[arg(long)]
    pub(super) full: bool,
    /// Write reports, JSON and figures into this folder
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Keep finished levels in this folder, and take from it those that are there: an interrupted
    /// run goes on where it was
    #[arg(long, value_name = "DIR")]
    pub(super) resume: Option<PathBuf>,
    /// Threads to use; results do not depend on it [default: all cores]
    #[arg(long, value_name = "N")]
    pub(super) jobs: Option<usize>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    /// Reports and a table of verdicts
    Text,
    /// One JSON document
    Json,
}

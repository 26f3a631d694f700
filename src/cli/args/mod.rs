//! The words of the command line.

mod compare;
mod cost;
mod doctor;
mod problem;
mod report;
mod shared;
mod shell;

pub(super) use compare::{CompareArgs, Page};
pub(super) use cost::CostArgs;
pub(super) use doctor::DoctorArgs;
pub(super) use problem::ProblemArgs;
pub(super) use report::{JudgedSolverArgs, ListArgs, MergeArgs, ReportArgs, RunArgs};
pub(super) use shared::{ColorArgs, Format, FormatArgs, SolverArgs, Targets};

pub(super) use shell::{CompletionsArgs, ManArgs};

use super::new::args::NewArgs;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Verifies Material Point Method solvers: suites of benchmarks, observed orders, verdicts.
#[derive(Debug, Parser)]
#[command(
    version,
    about,
    override_usage = "mpm-verify [OPTIONS] [SUITE]...\n       mpm-verify <COMMAND>",
    after_help = "Without a command: `run`, whose options `mpm-verify run --help` lists."
)]
pub(super) struct Cli {
    #[command(subcommand)]
    pub(super) command: Command,
    #[command(flatten)]
    pub(super) color: ColorArgs,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Run suites and judge them (the default); exit status 1 if an expectation is not met, 2 on
    /// bad input
    Run(RunArgs),
    /// Write a suite that runs; what no option says is asked for, if a terminal is there to answer
    New(NewArgs),
    /// Report what the parts of a run have found (`run --shard K/N --resume DIR`), byte for byte as
    /// one run of all would; nothing runs
    Merge(MergeArgs),
    /// List suites and their cases, as JSON with the predicted cost of each
    List(ListArgs),
    /// Validate suites without running them: grammar, formulas, the truth itself, and whether the
    /// runs can support what is expected; exit status 2 on bad input
    Check(CheckArgs),
    /// Print the problem of a suite, its source, what a step of each case takes (effects, passes,
    /// memory), and what is expected
    Explain(ExplainArgs),
    /// Run suites and print the `expect` entries that theory gives and the runs support, each with
    /// its origin; no file is changed
    Propose(ProposeArgs),
    /// Find the cause if a case does not have the order of theory: its finest levels run again with
    /// one thing changed at a time
    Diagnose(DiagnoseArgs),
    /// Put a solver to small problems that each show one kind of mistake, and say what is wrong
    /// with it in the words that its author needs; exit status 1 if something is, 2 if it cannot
    /// be talked to
    Doctor(DoctorArgs),
    /// Print a JSON Schema, for editors and for authors of solvers
    Schema(SchemaArgs),
    /// Print the time step of every level, as the suite asks for it and as it is taken; exit status
    /// 1 if one is off by more than 1 %
    Steps(StepsArgs),
    /// Write the initial state of one level, ready to be stepped by any solver, or its exact state
    /// at a time: particles, grid, faces, material, steps
    Problem(ProblemArgs),
    /// Measure what accuracy costs: error against work and seconds, the cheapest method for an
    /// error, and the most accurate setting within a budget
    Cost(CostArgs),
    /// Compare two runs or two sets of snapshots, and list the changes, the most important first;
    /// exit status 1 if something got worse (a verdict, an error, a limit of stability, the work),
    /// 2 on bad input
    Compare(CompareArgs),
    /// Print a script with which a shell completes the words of this command line
    Completions(CompletionsArgs),
    /// Print the page of this program for `man`
    Man(ManArgs),
}

#[derive(Debug, Args)]
pub(super) struct CheckArgs {
    #[command(flatten)]
    pub(super) targets: Targets,
    /// Exit status 1 if there are warnings
    #[arg(long)]
    pub(super) strict: bool,
    #[command(flatten)]
    pub(super) print: CheckPrintArgs,
    #[command(flatten)]
    pub(super) format: FormatArgs,
    #[command(flatten)]
    pub(super) solver: SolverArgs,
    /// Check again whenever one of the files changes, until Ctrl-C
    #[arg(long)]
    pub(super) watch: bool,
}

/// Arguments for the extent of the findings that `check` prints.
#[derive(Debug, Args)]
pub(super) struct CheckPrintArgs {
    /// Print nothing about sound suites, and no notes
    #[arg(long, short)]
    pub(super) quiet: bool,
    /// Print all notes. Without this: the notes about suites that are named, and a count of others
    #[arg(long, conflicts_with = "quiet")]
    pub(super) notes: bool,
}

#[derive(Debug, Args)]
pub(super) struct DiagnoseArgs {
    #[command(flatten)]
    pub(super) targets: Targets,
    /// Cases whose name contains this
    #[arg(long, value_name = "TEXT", default_value = "")]
    pub(super) case: String,
    /// Predicted time for the runs of each case: `30s`, `2min`
    #[arg(long, value_name = "TIME", value_parser = shared::seconds, allow_hyphen_values = true, default_value = "60s")]
    pub(super) budget: f64,
    #[command(flatten)]
    pub(super) format: FormatArgs,
    #[command(flatten)]
    pub(super) solver: SolverArgs,
}

#[derive(Debug, Args)]
pub(super) struct ExplainArgs {
    #[command(flatten)]
    pub(super) targets: Targets,
    /// Say what a step would no longer take without this effect of the scene
    #[arg(long, value_name = "EFFECT")]
    pub(super) without: Option<String>,
    /// Draw the scene of one suite into this file (SVG), and print nothing
    #[arg(long, value_name = "FILE")]
    pub(super) sketch: Option<PathBuf>,
    #[command(flatten)]
    pub(super) format: FormatArgs,
}

#[derive(Debug, Args)]
pub(super) struct SchemaArgs {
    /// The texts that it describes
    #[arg(value_enum)]
    pub(super) of: SchemaName,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum SchemaName {
    /// A suite, for editors that complete and check it while it is written
    Suite,
    /// The document of `run --format json`
    Json,
    /// Messages between the harness and a solver of another program
    Protocol,
}

#[derive(Debug, Args)]
pub(super) struct StepsArgs {
    #[command(flatten)]
    pub(super) targets: Targets,
    /// Also the finer levels that suites list under `full`
    #[arg(long)]
    pub(super) full: bool,
    #[command(flatten)]
    pub(super) format: FormatArgs,
}

#[derive(Debug, Args)]
pub(super) struct ProposeArgs {
    #[command(flatten)]
    pub(super) targets: Targets,
    #[command(flatten)]
    pub(super) format: FormatArgs,
    #[command(flatten)]
    pub(super) solver: SolverArgs,
}

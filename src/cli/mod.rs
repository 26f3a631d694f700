//! `mpm-verify`: run, list, check and explain suites.

mod output;
mod run;
mod select;
mod show;

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::{path::PathBuf, process::ExitCode};

/// Some expectation was not met.
const FAILED: u8 = 1;

/// Something that was given could not be used.
const BAD_INPUT: u8 = 2;

/// Verifies Material Point Method solvers: suites of benchmarks, observed orders, verdicts.
#[derive(Debug, Parser)]
#[command(version, about, args_conflicts_with_subcommands = true)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    run: RunArgs,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run suites and judge them (the default); exit status 1 if an expectation is not met, 2 on
    /// bad input
    Run(RunArgs),
    /// List suites and their cases
    List(Targets),
    /// Validate suites without running them: grammar, formulas, and the truth itself
    Check(Targets),
    /// Print the problem of a suite, its source, and what is expected
    Explain(Targets),
}

#[derive(Debug, Args)]
struct Targets {
    /// Suites: a file, a folder of files, or a name; default: all of verification/, or the
    /// built-in suites where there is no such folder
    #[arg(value_name = "FILE|FOLDER|NAME")]
    targets: Vec<PathBuf>,
}

#[derive(Debug, Args)]
struct RunArgs {
    #[command(flatten)]
    targets: Targets,
    /// What to print
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Print the table of verdicts only, not the reports
    #[arg(long)]
    brief: bool,
    /// Write reports, JSON and figures into this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Threads to use; results do not depend on it [default: all cores]
    #[arg(long, value_name = "N")]
    jobs: Option<usize>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Reports and a table of verdicts
    Text,
    /// One JSON document
    Json,
}

/// Parses the command line and does what it says.
pub(crate) fn main() -> ExitCode {
    let cli = Cli::parse();
    let code = match cli.command {
        None => run::run(&cli.run),
        Some(Command::Run(args)) => run::run(&args),
        Some(Command::List(args)) => show::list(&args.targets),
        Some(Command::Check(args)) => show::check(&args.targets),
        Some(Command::Explain(args)) => show::explain(&args.targets),
    };
    ExitCode::from(code)
}

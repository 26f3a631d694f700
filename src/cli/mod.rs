//! `mpm-verify`: write, run, list, check and explain suites, propose expectations, compare runs,
//! and what accuracy costs.

mod args;
mod compare;
mod cost;
mod diagnose;
mod doctor;
mod explain;
mod list;
mod merge;
mod new;
mod output;
mod page;
mod problem;
mod propose;
mod run;
mod schema;
mod select;
mod show;
mod solver;
mod status;
mod steps;
mod watch;

use args::{Cli, Command};
use clap::Parser;
use std::process::ExitCode;

/// Parses the command line and does what it says.
pub(crate) fn main() -> ExitCode {
    let cli = Cli::parse();
    let code = match cli.command {
        None => run::run(&cli.run),
        Some(Command::Run(args)) => run::run(&args),
        Some(Command::New(args)) => new::new(&args),
        Some(Command::Merge(args)) => merge::merge(&args),
        Some(Command::List(args)) => list::list(&args),
        Some(Command::Check(args)) => show::check(&args),
        Some(Command::Explain(args)) => explain::explain(&args),
        Some(Command::Diagnose(args)) => diagnose::diagnose(&args),
        Some(Command::Doctor(args)) => doctor::doctor(&args),
        Some(Command::Propose(targets)) => propose::propose(&targets.targets),
        Some(Command::Schema(args)) => schema::schema(&args),
        Some(Command::Steps(args)) => steps::steps(&args),
        Some(Command::Problem(args)) => problem::problem(&args),
        Some(Command::Cost(args)) => cost::cost(&args),
        Some(Command::Compare(args)) => compare::compare(&args),
    };
    ExitCode::from(code)
}

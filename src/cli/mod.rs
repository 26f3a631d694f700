//! `mpm-verify`: write, run, list, check and explain suites, propose expectations, compare runs,
//! and what accuracy costs.

mod args;
mod check;
mod command_line;
mod compare;
mod cost;
mod diagnose;
mod doctor;
mod explain;
mod list;
mod merge;
mod new;
mod problem;
mod propose;
mod run;
mod schema;
mod select;
mod shell;
mod show;
mod solver;
mod status;
mod steps;
mod terminal;
mod watch;

use args::{Cli, Command};
use clap::Parser;
use clap::error::ContextKind;
use status::{BAD_INPUT, PASSED};
use std::ffi::OsString;
use std::process::ExitCode;
use terminal::output;

/// Parses the command line and does what it says. What could not be printed is an error.
pub(crate) fn main() -> ExitCode {
    let mut code = match command_line::with_command(std::env::args_os().collect()) {
        Ok(words) => parsed(words),
        Err(message) => {
            output::complain(&message);
            BAD_INPUT
        }
    };
    if let Some(message) = output::failure() {
        output::complain(message);
        code = BAD_INPUT;
    }
    ExitCode::from(code)
}

fn parsed(words: Vec<OsString>) -> u8 {
    match Cli::try_parse_from(words) {
        Ok(cli) => {
            cli.color.write_global();
            done(cli.command)
        }
        // Help and the version too, which are printed to standard output.
        Err(mut answer) => {
            // `-- -1` would pass a negative number as a suite.
            let unknown = answer.get(ContextKind::InvalidArg).map(ToString::to_string);
            let is_number = |text: &str| text.parse::<f64>().is_ok();
            if unknown.is_some_and(|text| text.starts_with('-') && is_number(&text)) {
                answer.remove(ContextKind::Suggested);
            }
            output::keep(answer.print());
            if answer.use_stderr() { BAD_INPUT } else { PASSED }
        }
    }
}

fn done(command: Command) -> u8 {
    match command {
        Command::Run(args) => run::run(&args),
        Command::New(args) => new::new(&args),
        Command::Merge(args) => merge::merge(&args),
        Command::List(args) => list::list(&args),
        Command::Check(args) => check::check(&args),
        Command::Explain(args) => explain::explain(&args),
        Command::Diagnose(args) => diagnose::diagnose(&args),
        Command::Doctor(args) => doctor::doctor(&args),
        Command::Propose(args) => propose::propose(&args),
        Command::Schema(args) => schema::schema(&args),
        Command::Steps(args) => steps::steps(&args),
        Command::Problem(args) => problem::problem(&args),
        Command::Cost(args) => cost::cost(&args),
        Command::Compare(args) => compare::compare(&args),
        Command::Completions(args) => shell::completions(&args),
        Command::Man(args) => shell::man(&args),
    }
}

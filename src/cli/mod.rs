//! `mpm-verify`: writes, runs, lists, checks and explains suites, proposes expectations, compares
//! runs, measures the cost of accuracy, and estimates the limit of a series.

mod arguments;
mod check;
mod compare;
mod cost;
mod diagnose;
mod doctor;
mod estimate;
mod explain;
mod generate;
mod list;
mod new;
mod output;
mod problem;
mod propose;
mod run;
mod select;
mod show;
mod snapshots;
mod solver;
mod suite_runs;

use arguments::ColorArgs;
use clap::error::ContextKind;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use mpm_verify::nearest;
use output::{CommandError, Status};
use std::ffi::OsString;
use std::process::ExitCode;

/// Verifies Material Point Method solvers: suites of benchmarks, observed orders, verdicts.
#[derive(Debug, Parser)]
#[command(
    version,
    about,
    max_term_width = 100,
    override_usage = "mpm-verify [OPTIONS] [SUITE]...\n       mpm-verify <COMMAND>",
    after_help = "Without arguments: a first look, on few suites. Suites without a command: `run`, whose \
                  options `mpm-verify run --help` lists."
)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    color: ColorArgs,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run suites and judge them (the default)
    ///
    /// The exit status is 1 if an expectation is not met, and 2 on bad input.
    Run(Box<run::RunArgs>),
    /// List suites and their cases; the JSON includes predicted costs
    List(list::ListArgs),
    /// Print problem, cost and expectations of a suite, or the meaning of a failure code
    Explain(explain::ExplainArgs),
    /// Find the defects of a solver on small problems, each for one kind of defect
    ///
    /// The exit status is 1 if there is a defect, and 2 if the solver does not respond.
    Doctor(doctor::DoctorArgs),
    /// Find out why a case misses the theoretical order
    ///
    /// The finest levels run again with one change at a time.
    Diagnose(diagnose::DiagnoseArgs),
    /// Write the initial state of levels, or the exact state of one level at a given time
    ///
    /// The files contain particles, grid, faces, material and steps, for any solver.
    Problem(problem::ProblemArgs),
    /// Judge the results of a solver in files, one for each level
    ///
    /// `problem --all` writes the levels and describes the files. The exit status is that of `run`.
    Judge(Box<run::JudgeArgs>),
    /// Write a new suite with a comment for each key
    New(new::NewArgs),
    /// Validate suites without running them
    ///
    /// Checks grammar, formulas, the exact solution, and whether the runs can support the
    /// expectations. The exit status is 2 on bad input.
    Check(check::CheckArgs),
    /// Run suites and propose `expect` entries that theory predicts and the runs support
    ///
    /// Each entry has a reason. No file is changed.
    Propose(propose::ProposeArgs),
    /// Print the requested and the actual time step of every level
    ///
    /// The exit status is 1 if they differ by more than 1 %.
    Steps(list::StepsArgs),
    /// Compare two runs or two sets of snapshots; the most important change comes first
    ///
    /// The exit status is 1 if a verdict, an error, a stability limit or the work got worse, and 2
    /// on bad input.
    Compare(compare::CompareArgs),
    /// Accept changed reports as snapshots, after `run --snapshots`
    ///
    /// A failed comparison with theory cannot be accepted: `run` writes no changed report then.
    Accept(snapshots::AcceptArgs),
    /// Measure error against work and run time, and the cheapest method for an error
    Cost(cost::CostArgs),
    /// Estimate order and limit of a series of values whose exact limit is unknown
    ///
    /// Both have intervals. The exit status is 1 if the series shows no limit, and 2 on bad input.
    Estimate(estimate::EstimateArgs),
    /// Merge the results of a sharded run, without running anything
    ///
    /// The parts come from `run --shard K/N --resume DIR`. The output is that of a single run.
    Merge(run::MergeArgs),
    /// Print the JSON Schema of suites, of reports, or of the messages to a solver
    Schema(generate::SchemaArgs),
    /// Print a completion script for a shell
    Completions(generate::CompletionsArgs),
    /// Print the manual page for `man`
    Man(generate::ManArgs),
}

const GROUPS: [(&str, &[&str], &str); 5] = [
    ("Start", &["run", "list", "explain"], "run vibrating-bar"),
    ("Your solver", &["doctor", "diagnose", "problem", "judge"], "doctor --solver 'python mpm.py'"),
    ("Your suites", &["new", "check", "propose", "steps"], "check my-suite.yaml"),
    ("Results", &["compare", "accept", "cost", "estimate", "merge"], "cost vibrating-bar"),
    ("Maintenance", &["schema", "completions", "man"], "completions bash"),
];

/// Returns the description of the command line, whose help lists the commands by purpose.
fn command_line() -> clap::Command {
    let line = Cli::command();
    let mut groups = String::new();
    for (heading, names, example) in GROUPS {
        groups += &format!("\n{heading}:\n");
        for command in names.iter().filter_map(|name| line.find_subcommand(name)) {
            let about = command.get_about().map(ToString::to_string).unwrap_or_default();
            groups += &format!("  {:12} {about}\n", command.get_name());
        }
        groups += &format!("  {:12} mpm-verify {example}\n", "example:");
    }
    let template = "{about}\n\n{usage-heading} {usage}\nGROUPS\nOptions:\n{options}{after-help}";
    line.help_template(template.replace("GROUPS", &groups))
}

pub(crate) fn main() -> ExitCode {
    let arguments = with_command(std::env::args_os().collect(), &command_line());
    let mut status = arguments.and_then(run_arguments).unwrap_or_else(|error| {
        output::complain(&error.to_string());
        Status::BadInput
    });
    if let Some(message) = output::failure() {
        output::complain(message);
        status = Status::BadInput;
    }
    status.into()
}

fn run_arguments(arguments: Vec<OsString>) -> Result<Status, CommandError> {
    let matches = command_line().try_get_matches_from(arguments);
    match matches.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => {
            cli.color.write_global();
            match cli.command {
                Some(command) => run_command(command),
                None => run_first(),
            }
        }
        // `clap` also returns help and version as errors; they go to standard output.
        Err(mut answer) => {
            // The suggestion of `clap`, `-- -1`, would pass a negative number as a suite.
            let unknown = answer.get(ContextKind::InvalidArg).map(ToString::to_string);
            let is_number = |text: &str| text.parse::<f64>().is_ok();
            if unknown.is_some_and(|text| text.starts_with('-') && is_number(&text)) {
                answer.remove(ContextKind::Suggested);
            }
            output::keep(answer.print());
            Ok(if answer.use_stderr() { Status::BadInput } else { Status::Passed })
        }
    }
}

/// Runs a few suites, and draws a convergence plot.
fn run_first() -> Result<Status, CommandError> {
    let words = ["mpm-verify", "run"].map(str::to_owned).into_iter().chain(select::first_suites());
    match Cli::try_parse_from(words).map(|cli| cli.command) {
        Ok(Some(Command::Run(mut args))) => run::first(&mut args),
        _ => Ok(Status::BadInput),
    }
}

fn run_command(command: Command) -> Result<Status, CommandError> {
    match command {
        Command::Run(args) => run::run(&args),
        Command::New(args) => new::new(&args),
        Command::Merge(args) => run::merge(&args),
        Command::Judge(args) => run::judge(&args),
        Command::List(args) => Ok(list::list(&args)),
        Command::Check(args) => check::check(&args),
        Command::Explain(args) => explain::explain(&args),
        Command::Diagnose(args) => diagnose::diagnose(&args),
        Command::Doctor(args) => doctor::doctor(&args),
        Command::Propose(args) => propose::propose(&args),
        Command::Schema(args) => Ok(generate::schema(&args)),
        Command::Steps(args) => Ok(list::steps(&args)),
        Command::Problem(args) => problem::problem(&args),
        Command::Accept(args) => snapshots::accept(&args),
        Command::Cost(args) => cost::cost(&args),
        Command::Estimate(args) => estimate::estimate(&args),
        Command::Compare(args) => compare::compare(&args),
        Command::Completions(args) => Ok(generate::completions(&args, command_line())),
        Command::Man(args) => generate::man(&args, command_line()),
    }
}

/// Inserts the command `run` into the arguments if they contain no command. Fails if the first
/// argument is no suite, but is similar to a command.
fn with_command(words: Vec<OsString>, cli: &clap::Command) -> Result<Vec<OsString>, CommandError> {
    let at = first(&words);
    let word = words.get(at).map(|word| word.to_string_lossy());
    let word = word.as_deref().unwrap_or_default();
    let commands: Vec<&str> = cli.get_subcommands().map(clap::Command::get_name).collect();
    if word.is_empty() && at == words.len() {
        return Ok(words);
    }
    if commands.contains(&word) || ["help", "-h", "--help", "-V", "--version"].contains(&word) {
        return Ok(words);
    }
    if !word.is_empty() && !word.starts_with('-') && !select::is_known(word) {
        let suites = select::suite_names();
        let known = suites.iter().map(String::as_str).chain(commands.iter().copied());
        let near = nearest(word, known).filter(|near| commands.contains(near));
        if let Some(command) = near.filter(|near| suites.iter().all(|suite| suite != near)) {
            let message = format!("there is no command or suite called `{word}`");
            let help = format!("did you mean the command `{command}`?");
            return Err(CommandError::Message(format!("{message}\nhelp: {help}")));
        }
    }
    let mut words = words;
    words.insert(at, "run".into());
    Ok(words)
}

/// Returns the index of the first argument after the program name and the global options.
fn first(words: &[OsString]) -> usize {
    let mut at = words.len().min(1);
    while let Some(word) = words.get(at).and_then(|word| word.to_str()) {
        match word {
            "--color" => at += 2,
            _ if word.starts_with("--color=") => at += 1,
            _ => break,
        }
    }
    at.min(words.len())
}

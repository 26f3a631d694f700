//! The words of the command line.

use super::new::args::NewArgs;
use super::problem_args::ProblemArgs;
use clap::{Args, Parser, Subcommand, ValueEnum};
use mpm_verify::report::compare;
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
    /// Write a suite that runs; what no option says is asked for, if a terminal is there to answer
    New(NewArgs),
    /// List suites and their cases
    List(Targets),
    /// Validate suites without running them: grammar, formulas, the truth itself, and whether the
    /// runs can support what is expected; exit status 2 on bad input
    Check(CheckArgs),
    /// Print the problem of a suite, its source, what a step of each case takes (effects, passes,
    /// memory), and what is expected
    Explain(ExplainArgs),
    /// Run suites and write the `expect` entries that theory gives and the runs support, each with
    /// where it comes from; nothing is changed
    Propose(Targets),
    /// Find out why cases do not have the order of theory: the finest levels again, with one thing
    /// changed at a time
    Diagnose(DiagnoseArgs),
    /// Print the time step of every level, as the suite asks for it and as it is taken; exit status
    /// 1 if one is off by more than 1 %
    Steps(StepsArgs),
    /// Write the initial state of one level, ready to be stepped by any solver, or its exact state
    /// at a time: particles, grid, faces, material, steps
    Problem(ProblemArgs),
    /// Measure what accuracy costs: error against work and seconds, the cheapest method for an
    /// error, and the most accurate setting within a budget
    Cost(CostArgs),
    /// Hold the JSON of two runs side by side: what moved, the most important first; exit status 1
    /// if something got worse (a verdict, an error, a limit of stability, the work), 2 on bad input
    Compare(CompareArgs),
}

#[derive(Debug, Args)]
pub(super) struct Targets {
    /// Suites: a file, a folder of files, or a name; default: all of verification/, or the
    /// built-in suites where there is no such folder
    #[arg(value_name = "FILE|FOLDER|NAME")]
    pub(super) targets: Vec<PathBuf>,
}

#[derive(Debug, Args)]
pub(super) struct CheckArgs {
    #[command(flatten)]
    pub(super) targets: Targets,
    /// Exit status 1 if there are warnings
    #[arg(long)]
    pub(super) strict: bool,
    #[command(flatten)]
    pub(super) solver: SolverArgs,
    /// Check again whenever one of the files changes, until Ctrl-C
    #[arg(long)]
    pub(super) watch: bool,
}

#[derive(Debug, Args)]
pub(super) struct DiagnoseArgs {
    #[command(flatten)]
    pub(super) targets: Targets,
    /// Cases whose name contains this
    #[arg(long, value_name = "TEXT", default_value = "")]
    pub(super) case: String,
    /// Predicted time for the runs of each case: `30s`, `2min`
    #[arg(long, value_name = "TIME", value_parser = seconds, default_value = "60s")]
    pub(super) budget: f64,
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
}

#[derive(Debug, Args)]
pub(super) struct StepsArgs {
    #[command(flatten)]
    pub(super) targets: Targets,
    /// Also the finer levels that suites list under `full`
    #[arg(long)]
    pub(super) full: bool,
}

#[derive(Debug, Args)]
pub(super) struct CompareArgs {
    /// JSON of the run before: `mpm-verify run --format json`, or `report.json` of `run --out`
    #[arg(value_name = "OLD.json")]
    pub(super) old: PathBuf,
    /// JSON of the run after
    #[arg(value_name = "NEW.json")]
    pub(super) new: PathBuf,
    /// Format of the output
    #[arg(long, value_enum, default_value_t = Page::Text)]
    pub(super) format: Page,
    /// Largest relative change of a figure that counts as none
    #[arg(long, value_name = "SHARE", default_value_t = compare::TOLERANCE)]
    pub(super) tolerance: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Page {
    /// Aligned tables
    Text,
    /// A comment for a pull request
    Markdown,
}

#[derive(Debug, Args)]
pub(super) struct RunArgs {
    #[command(flatten)]
    pub(super) targets: Targets,
    /// Format of the output
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
    /// Write one HTML page with verdicts, figures, reports and suites into this file; it needs no
    /// network
    #[arg(long, value_name = "FILE")]
    pub(super) html: Option<PathBuf>,
    /// Keep finished levels and the states of running ones in this folder, and take from it those
    /// that are there: an interrupted run goes on where it was
    #[arg(long, value_name = "DIR", conflicts_with = "solver")]
    pub(super) resume: Option<PathBuf>,
    /// How often the state of a running level is kept in the folder of `--resume` [default: 10s]
    #[arg(long, value_name = "TIME", value_parser = seconds, requires = "resume")]
    pub(super) checkpoint_every: Option<f64>,
    /// Threads to use; results do not depend on it [default: all cores]
    #[arg(long, value_name = "N")]
    pub(super) jobs: Option<usize>,
    /// Run again whenever one of the files changes, until Ctrl-C
    #[arg(long)]
    pub(super) watch: bool,
    #[command(flatten)]
    pub(super) judged: JudgedSolverArgs,
}

#[derive(Debug, Args)]
pub(super) struct JudgedSolverArgs {
    #[command(flatten)]
    pub(super) program: SolverArgs,
    /// Expect the order that the solver of `--solver` claims of each case of which the suite says
    /// nothing
    #[arg(long, requires = "solver")]
    pub(super) gate: bool,
}

#[derive(Debug, Args)]
pub(super) struct SolverArgs {
    /// Put this program to the suites instead of their methods: a command with its arguments that
    /// speaks the protocol of docs/protocol.md
    #[arg(long, value_name = "COMMAND")]
    pub(super) solver: Option<String>,
    /// Longest time without an answer of the solver
    #[arg(long, value_name = "TIME", value_parser = seconds, default_value = "60s")]
    pub(super) solver_timeout: f64,
    /// Most memory (address space) of each process of the solver, in MB [default: no limit]
    #[arg(long, value_name = "MB", requires = "solver")]
    pub(super) solver_memory: Option<u64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    /// Reports and a table of verdicts
    Text,
    /// One JSON document
    Json,
}

#[derive(Debug, Args)]
pub(super) struct CostArgs {
    #[command(flatten)]
    pub(super) targets: Targets,
    /// Vary more than what suites refine, and say which split is best
    #[arg(long, value_enum, value_delimiter = ',', value_name = "WHAT")]
    pub(super) over: Vec<Vary>,
    /// Choose and run the most accurate setting that is predicted to take no longer: `10s`,
    /// `500ms`, `2min`
    #[arg(long, value_name = "TIME", value_parser = seconds, conflicts_with_all = ["over", "figures"])]
    pub(super) budget: Option<f64>,
    /// Print one JSON document
    #[arg(long)]
    pub(super) json: bool,
    /// Write work-precision diagrams into this folder
    #[arg(long, value_name = "DIR")]
    pub(super) figures: Option<PathBuf>,
    /// Measure the finer levels too that suites list under `full`
    #[arg(long)]
    pub(super) full: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Vary {
    /// Particles per cell: half and twice as many along each axis
    Ppc,
    /// Time steps: half and twice as long
    Dt,
    /// Basis functions: all that go with the rest of the method
    Basis,
}

/// A time with its unit, in seconds.
fn seconds(text: &str) -> Result<f64, String> {
    let units = [("ms", 1e-3), ("min", 60.0), ("s", 1.0), ("h", 3600.0)];
    let known = units.iter().find_map(|(unit, size)| {
        let number: f64 = text.strip_suffix(unit)?.trim().parse().ok()?;
        Some(number * size)
    });
    let usable = known.filter(|time| *time > 0.0 && time.is_finite());
    usable.ok_or_else(|| "expected a time with its unit, such as `10s` or `500ms`".to_owned())
}

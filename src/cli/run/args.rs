//! Arguments of `run` and `merge`.

use crate::cli::arguments::{Expected, SOLVER, SolversArgs, Targets, count, number, whole};
use clap::{Args, ValueEnum};
use mpm_verify::study::Shard;
use std::path::PathBuf;
use std::str::FromStr;

/// Headings of the options in the help.
const RUNS: &str = "Which cases run, and how";
const PRINTED: &str = "What is printed";
const FILES: &str = "Files that are written";

#[derive(Debug, Args)]
pub(in crate::cli) struct RunArgs {
    #[command(flatten)]
    pub(super) report: ReportArgs,
    /// Run only cases whose name contains this text
    #[arg(help_heading = RUNS, long, value_name = "TEXT")]
    pub(super) case: Option<String>,
    /// Run only the cases that failed in the last run in this folder
    #[arg(help_heading = RUNS, long, conflicts_with = "shard")]
    pub(super) last_failed: bool,
    /// Run part K of N parts with about equal predicted costs; `merge` reports the results that the
    /// parts store with `--resume`
    #[arg(help_heading = RUNS, long, value_name = "K/N", allow_hyphen_values = true)]
    pub(super) shard: Option<Shard>,
    /// Store finished levels in this folder, and reuse stored levels: an interrupted run continues
    /// with the remaining levels
    #[arg(help_heading = RUNS, long, value_name = "DIR")]
    pub(super) resume: Option<PathBuf>,
    /// Run each level N times (2 or more), external solvers in a new process each time, and report
    /// the spread between the runs; a level whose spread exceeds a tenth of its error does not
    /// count for the order
    #[arg(help_heading = RUNS, long, value_name = "N", value_parser = whole, allow_negative_numbers = true)]
    pub(super) repeat: Option<usize>,
    /// Write particles and grid over time into this folder, as files for ParaView, and an animated
    /// picture of the particles (SVG): for failing cases or those that `--case` selects, on the
    /// first level that failed or else the finest
    #[arg(help_heading = FILES, long, value_name = "DIR")]
    pub(super) vtu: Option<PathBuf>,
    /// Compare reports with snapshots (SUITE.snap) in DIR, or else next to the suites; changed
    /// reports are written as SUITE.snap.new, and `mpm-verify accept` accepts them
    #[arg(help_heading = FILES, long, value_name = "DIR", num_args = 0..=1, require_equals = true,
        default_missing_value = "",
        conflicts_with_all = ["case", "shard", "repeat", "full"])]
    pub(super) snapshots: Option<String>,
    #[command(flatten)]
    pub(super) programs: SolversArgs,
    #[command(flatten)]
    pub(super) gate: GateArgs,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct ReportArgs {
    #[command(flatten)]
    pub(super) targets: Targets,
    /// Format of the output
    #[arg(help_heading = PRINTED, long, value_enum, default_value_t = RunFormat::Text)]
    pub(super) format: RunFormat,
    #[command(flatten)]
    pub(super) print: PrintArgs,
    /// Start no further suite after a suite with a failing case
    #[arg(help_heading = RUNS, long)]
    pub(super) fail_fast: bool,
    /// Also run the finer levels that suites list under `full`: hours instead of seconds
    #[arg(help_heading = RUNS, long)]
    pub(super) full: bool,
    /// Write reports, JSON, CSV, LaTeX tables and figures (SVG, and source for PGFPlots) into this
    /// folder
    #[arg(help_heading = FILES, long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Title of the suite in figures and LaTeX tables
    #[arg(help_heading = FILES, long, value_name = "TEXT")]
    pub(super) title: Option<String>,
    /// Text for a case in figures and LaTeX tables in place of its name; repeatable
    #[arg(help_heading = FILES, long, value_name = "CASE=TEXT")]
    pub(super) label: Vec<CaseLabel>,
    /// Write the results as JUnit XML into this file, one test for each case
    #[arg(help_heading = FILES, long, value_name = "FILE")]
    pub(super) junit: Option<PathBuf>,
    /// Write one HTML page with verdicts, figures, reports and suites into this file; the page
    /// needs no network
    #[arg(help_heading = FILES, long, value_name = "FILE")]
    pub(super) html: Option<PathBuf>,
    /// Number of threads, which does not affect results [default: all cores]
    #[arg(help_heading = RUNS, long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    pub(super) jobs: Option<usize>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum RunFormat {
    /// Plain text
    Text,
    /// One JSON document
    Json,
    /// Comma-separated values, a row for each level
    Csv,
    /// LaTeX tables of errors and orders, for `booktabs`
    Latex,
    /// Plain text; failing cases are annotations of a pull request on GitHub
    Github,
}

#[derive(Debug, Args)]
#[allow(clippy::struct_excessive_bools, reason = "each is an option of the command line")]
pub(in crate::cli) struct PrintArgs {
    /// Print every report [default: the reports of up to five named suites; otherwise one line
    /// for each suite or group, and the failing cases]
    #[arg(help_heading = PRINTED, long, conflicts_with_all = ["brief", "quiet"])]
    pub(super) reports: bool,
    /// Print no reports: only each case with its result and its expectation
    #[arg(help_heading = PRINTED, long, conflicts_with = "quiet")]
    pub(super) brief: bool,
    /// Print only the failing cases, and no progress
    #[arg(help_heading = PRINTED, long, short)]
    pub(super) quiet: bool,
    /// Also print the findings of each suite by basis
    #[arg(help_heading = PRINTED, long, conflicts_with_all = ["brief", "quiet", "reports"])]
    pub(super) overview: bool,
    /// Whether to draw a convergence plot.
    #[arg(skip)]
    pub(super) plot: bool,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct MergeArgs {
    /// Folder in which one part of the run stored its results with `--resume`; repeatable
    #[arg(long, value_name = "DIR", required = true)]
    pub(super) from: Vec<PathBuf>,
    #[command(flatten)]
    pub(super) report: ReportArgs,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct JudgeArgs {
    #[command(flatten)]
    pub(super) report: ReportArgs,
    /// Folder with the results, one file (CSV) for each level; `problem --all` describes the files
    // The options of the gate require an argument `solver`.
    #[arg(help_heading = SOLVER, id = "solver", long = "from", value_name = "DIR")]
    pub(super) from: PathBuf,
    /// Name of the solver in reports
    #[arg(help_heading = SOLVER, long, default_value = "results")]
    pub(super) name: String,
    /// Theoretical order in h of the displacement error for a smooth solution
    #[arg(help_heading = SOLVER, long, value_name = "P", value_parser = number, default_value_t = 2.0)]
    pub(super) formal_order: f64,
    /// The solver computes in single precision
    #[arg(help_heading = SOLVER, long)]
    pub(super) single: bool,
    #[command(flatten)]
    pub(super) gate: GateArgs,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct GateArgs {
    /// Require that each case of the solver reaches the theoretical order or the error
    /// bounds of the suite; exit status 1 unless every case passes or is excepted
    #[arg(help_heading = SOLVER, long, requires = "solver")]
    pub(super) gate: bool,
    /// YAML file with the formal order of the solver, and with orders, bounds and exceptions for
    /// single suites
    #[arg(help_heading = SOLVER, long, value_name = "FILE", requires = "gate")]
    pub(super) solver_config: Option<PathBuf>,
    /// Let `--gate` pass even if suites that are named one by one are not applicable to the solver
    /// or have no requirement
    #[arg(help_heading = SOLVER, long, requires = "gate")]
    pub(super) allow_not_applicable: bool,
}

#[derive(Debug, Clone)]
pub(super) struct CaseLabel {
    pub(super) case: String,
    /// Text that replaces the name in drawings and tables.
    pub(super) text: String,
}

impl FromStr for CaseLabel {
    type Err = Expected;

    /// Parses `CASE=TEXT`.
    fn from_str(text: &str) -> Result<Self, Expected> {
        let (case, text) = text
            .split_once('=')
            .filter(|(case, text)| !case.is_empty() && !text.is_empty())
            .ok_or_else(|| Expected("the name of a case, `=` and a text".into()))?;
        Ok(Self { case: case.to_owned(), text: text.to_owned() })
    }
}

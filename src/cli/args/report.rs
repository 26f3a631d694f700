//! The words of `run`, `merge` and `list`.

use super::shared::{FormatArgs, SolverArgs, Targets, count};
use clap::Args;
use mpm_verify::study::Shard;
use std::path::PathBuf;

/// Words of a run that is reported.
#[derive(Debug, Args)]
pub(in crate::cli) struct ReportArgs {
    #[command(flatten)]
    pub(in crate::cli) targets: Targets,
    #[command(flatten)]
    pub(in crate::cli) format: FormatArgs,
    #[command(flatten)]
    pub(in crate::cli) print: PrintArgs,
    /// Run the finer levels too that suites list under `full`: takes hours where the others take
    /// seconds
    #[arg(long)]
    pub(in crate::cli) full: bool,
    /// Write reports, JSON and figures into this folder
    #[arg(long, value_name = "DIR")]
    pub(in crate::cli) out: Option<PathBuf>,
    /// Write one HTML page with verdicts, figures, reports and suites into this file; it needs no
    /// network
    #[arg(long, value_name = "FILE")]
    pub(in crate::cli) html: Option<PathBuf>,
    /// Threads to use; results do not depend on it [default: all cores]
    #[arg(long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    pub(in crate::cli) jobs: Option<usize>,
}

/// Words for the extent of what is printed.
#[derive(Debug, Args)]
pub(in crate::cli) struct PrintArgs {
    /// Print every report. Without this: the reports of up to five suites that are named; of more,
    /// or of all, an overview and the cases that did not come as expected
    #[arg(long, conflicts_with_all = ["brief", "quiet"])]
    pub(in crate::cli) reports: bool,
    /// Print one line for each case only, not the reports
    #[arg(long, conflicts_with = "quiet")]
    pub(in crate::cli) brief: bool,
    /// Print only the cases that did not come as expected, and no progress
    #[arg(long, short)]
    pub(in crate::cli) quiet: bool,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct RunArgs {
    #[command(flatten)]
    pub(in crate::cli) report: ReportArgs,
    /// Cases whose name contains this
    #[arg(long, value_name = "TEXT")]
    pub(in crate::cli) case: Option<String>,
    /// One of N parts of the cases, of about the same predicted cost; `merge` reports the folders
    /// that the parts keep with `--resume`
    #[arg(long, value_name = "K/N", allow_hyphen_values = true)]
    pub(in crate::cli) shard: Option<Shard>,
    /// Keep finished levels in this folder, and take from it those that are there: an interrupted
    /// run goes on with the levels that are not done
    #[arg(long, value_name = "DIR")]
    pub(in crate::cli) resume: Option<PathBuf>,
    /// Write particles and grid over time into this folder, as files for ParaView, of the cases
    /// that did not come as expected, or of those that `--case` chooses: on the first level that
    /// broke, or on the finest
    #[arg(long, value_name = "DIR")]
    pub(in crate::cli) vtu: Option<PathBuf>,
    /// Run again whenever one of the files changes, until Ctrl-C
    #[arg(long)]
    pub(in crate::cli) watch: bool,
    #[command(flatten)]
    pub(in crate::cli) judged: JudgedSolverArgs,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct MergeArgs {
    /// A folder that a part of the run kept with `--resume`; once for each
    #[arg(long, value_name = "DIR", required = true)]
    pub(in crate::cli) from: Vec<PathBuf>,
    #[command(flatten)]
    pub(in crate::cli) report: ReportArgs,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct JudgedSolverArgs {
    #[command(flatten)]
    pub(in crate::cli) program: SolverArgs,
    /// Require of each case of the solver of `--solver` the order that theory gives it, or errors
    /// within the bounds of the suite; exit status 1 unless every case passes or is excepted
    #[arg(long, requires = "solver")]
    pub(in crate::cli) gate: bool,
    /// Formal order of the solver, and orders, bounds and exceptions for single suites (YAML)
    #[arg(long, value_name = "FILE", requires = "gate")]
    pub(in crate::cli) solver_config: Option<PathBuf>,
    /// Let `--gate` pass although suites named one by one are not applicable to the solver, or are
    /// not gated
    #[arg(long, requires = "gate")]
    pub(in crate::cli) allow_not_applicable: bool,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct ListArgs {
    #[command(flatten)]
    pub(in crate::cli) targets: Targets,
    #[command(flatten)]
    pub(in crate::cli) format: FormatArgs,
}

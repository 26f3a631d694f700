//! The words of `cost`.

use super::shared::{FormatArgs, SolverArgs, Targets, seconds};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(in crate::cli) struct CostArgs {
    #[command(flatten)]
    pub(in crate::cli) targets: Targets,
    /// Vary more than what suites refine, and say which split is best
    #[arg(long, value_enum, value_delimiter = ',', value_name = "WHAT")]
    pub(in crate::cli) over: Vec<Vary>,
    /// Choose and run the most accurate setting that is predicted to take no longer: `10s`,
    /// `500ms`, `2min`
    #[arg(long, value_name = "TIME", value_parser = seconds, allow_hyphen_values = true, conflicts_with_all = ["over", "figures", "solver"])]
    pub(in crate::cli) budget: Option<f64>,
    #[command(flatten)]
    pub(in crate::cli) format: FormatArgs,
    /// Write work-precision diagrams into this folder
    #[arg(long, value_name = "DIR")]
    pub(in crate::cli) figures: Option<PathBuf>,
    /// Measure the finer levels too that suites list under `full`
    #[arg(long)]
    pub(in crate::cli) full: bool,
    #[command(flatten)]
    pub(in crate::cli) program: SolverArgs,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum Vary {
    /// Particles per cell: half and twice as many along each axis
    Ppc,
    /// Time steps: half and twice as long
    Dt,
    /// Basis functions: all that go with the rest of the method
    Basis,
}

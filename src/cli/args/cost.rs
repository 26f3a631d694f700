//! The words of `cost`.

use super::shared::{FormatArgs, SolverArgs, Targets, seconds};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(in crate::cli) struct CostArgs {
    #[command(flatten)]
    pub(in crate::cli) targets: Targets,
    /// Choose and run the most accurate setting that is predicted to take no longer: `10s`,
    /// `500ms`, `2min`
    #[arg(long, value_name = "TIME", value_parser = seconds, allow_hyphen_values = true, conflicts_with_all = ["figures", "solver"])]
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

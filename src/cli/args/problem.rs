//! Words of `mpm-verify problem`.

use super::shared::{number, whole};
use clap::Args;
use mpm_verify::external::ProblemFormat;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(in crate::cli) struct ProblemArgs {
    /// Suite: a file, a name, or `-` for standard input
    #[arg(value_name = "SUITE")]
    pub(in crate::cli) suite: PathBuf,
    /// Level, the coarsest being 1 [default: the finest that the gate runs]
    #[arg(long, value_name = "N", value_parser = whole, allow_negative_numbers = true)]
    pub(in crate::cli) level: Option<usize>,
    /// The exact state at this time (s), and not the initial one
    #[arg(long, value_name = "T", value_parser = number, allow_negative_numbers = true)]
    pub(in crate::cli) at: Option<f64>,
    /// Format of the output: csv, json, npz, vtu
    #[arg(long, alias = "out", value_name = "FORMAT", value_parser = format, default_value = "csv")]
    pub(in crate::cli) format: ProblemFormat,
}

/// The format with this name.
fn format(name: &str) -> Result<ProblemFormat, String> {
    let known = ProblemFormat::ALL;
    let names = || known.iter().map(|format| format.name()).collect::<Vec<_>>().join(", ");
    let found = known.iter().find(|format| format.name() == name);
    found.copied().ok_or_else(|| format!("expected one of {}", names()))
}

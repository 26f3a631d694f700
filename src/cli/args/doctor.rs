//! Words of `mpm-verify doctor`.

use super::shared::{Format, SolverArgs};
use clap::Args;

#[derive(Debug, Args)]
pub(in crate::cli) struct DoctorArgs {
    #[command(flatten)]
    pub(in crate::cli) solver: SolverArgs,
    /// Format of the output
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(in crate::cli) format: Format,
}

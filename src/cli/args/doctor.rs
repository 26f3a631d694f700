//! Words of `mpm-verify doctor`.

use super::shared::{FormatArgs, SolverArgs};
use clap::Args;

#[derive(Debug, Args)]
pub(in crate::cli) struct DoctorArgs {
    #[command(flatten)]
    pub(in crate::cli) solver: SolverArgs,
    #[command(flatten)]
    pub(in crate::cli) format: FormatArgs,
}

//! Arguments of `compare`.

use super::shared::share;
use clap::{Args, ValueEnum};
use mpm_verify::report::compare;

#[derive(Debug, Args)]
pub(in crate::cli) struct CompareArgs {
    /// Results before: the JSON of `mpm-verify run --format json`, a folder of `run --out`, a
    /// folder of snapshots, or a commit that has snapshots
    #[arg(value_name = "OLD")]
    pub(in crate::cli) old: String,
    /// Results after
    #[arg(value_name = "NEW", default_value = "verification")]
    pub(in crate::cli) new: String,
    /// Folder of the snapshots in the tree of a commit
    #[arg(long, default_value = "verification")]
    pub(in crate::cli) folder: String,
    /// Format of the output
    #[arg(long, value_enum, default_value_t = Page::Text)]
    pub(in crate::cli) format: Page,
    /// Largest relative change of a figure that counts as none
    #[arg(long, value_name = "SHARE", default_value_t = compare::TOLERANCE, value_parser = share, allow_negative_numbers = true)]
    pub(in crate::cli) tolerance: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum Page {
    /// Aligned tables
    Text,
    /// A comment for a pull request
    Markdown,
    /// One JSON document
    Json,
}

//! The words of `mpm-verify new`.

use crate::cli::arguments::FormatArgs;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(in crate::cli) struct NewArgs {
    /// Name of the suite: lower-case letters, digits and hyphens
    #[arg(value_name = "NAME")]
    pub(in crate::cli) name: String,
    /// Dimension of space [default: 1]
    #[arg(long, value_name = "D", value_parser = ["1", "2", "3"])]
    pub(in crate::cli) dimension: Option<String>,
    /// Material of the body [default: neo_hookean, or the one that goes with the truth]
    #[arg(long, value_enum)]
    pub(in crate::cli) material: Option<LawChoice>,
    /// Exact solution [default: the one that goes with the material]
    #[arg(long, value_enum)]
    pub(in crate::cli) truth: Option<TruthChoice>,
    /// Basis functions [default: quadratic_bspline]
    #[arg(long)]
    pub(in crate::cli) basis: Option<String>,
    /// Transfer between particles and grid [default: flip]
    #[arg(long)]
    pub(in crate::cli) transfer: Option<String>,
    /// Time scheme [default: musl]
    #[arg(long)]
    pub(in crate::cli) scheme: Option<String>,
    /// File to write; one that is there is left alone [default: NAME.yaml]
    #[arg(long, value_name = "FILE")]
    pub(in crate::cli) output: Option<PathBuf>,
    #[command(flatten)]
    pub(in crate::cli) format: FormatArgs,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub(in crate::cli) enum LawChoice {
    /// Small strain, in MPM integrated in rate form
    LinearElastic,
    /// Finite strain
    NeoHookean,
    /// Finite strain, linear in the logarithmic strain
    Hencky,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub(in crate::cli) enum TruthChoice {
    /// A stated motion along the axes, and the body force that it takes
    Manufactured,
    /// A standing wave of small strain
    StandingWave,
}

impl LawChoice {
    /// The name of the material in suites.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::LinearElastic => "linear_elastic",
            Self::NeoHookean => "neo_hookean",
            Self::Hencky => "hencky",
        }
    }

    /// The truth that is known for the material.
    pub(super) fn truth(self) -> TruthChoice {
        match self {
            Self::LinearElastic => TruthChoice::StandingWave,
            Self::NeoHookean | Self::Hencky => TruthChoice::Manufactured,
        }
    }
}

impl TruthChoice {
    /// The materials for which it is known, the usual one first.
    pub(super) fn laws(self) -> &'static [LawChoice] {
        match self {
            Self::Manufactured => &[LawChoice::NeoHookean, LawChoice::Hencky],
            Self::StandingWave => &[LawChoice::LinearElastic],
        }
    }
}

//! Arguments common to several commands, and parsers for their values.

use anstream::ColorChoice;
use clap::{Args, ValueEnum};
use std::borrow::Cow;
use std::path::PathBuf;
use std::str::FromStr;
use thiserror::Error;

/// Heading of the options for an external solver in the help.
pub(super) const SOLVER: &str = "Your solver";

#[derive(Debug, Args)]
pub(super) struct Targets {
    /// Suites: a file, a folder, a name, a group (a folder of verification/, such as `heat`), a
    /// pattern (`mms-*`), or `-` for standard input [default: all of verification/, or the built-in
    /// suites if there is no such folder]
    #[arg(value_name = "SUITE")]
    pub(super) targets: Vec<PathBuf>,
}

#[derive(Debug, Args)]
pub(super) struct SolverArgs {
    /// Run this program on the suites instead of their methods: a command with its arguments that
    /// speaks the protocol of docs/protocol.md
    #[arg(help_heading = SOLVER, long, value_name = "COMMAND")]
    pub(super) solver: Option<String>,
    #[command(flatten)]
    pub(super) limits: SolverLimitArgs,
}

#[derive(Debug, Args)]
pub(super) struct SolversArgs {
    /// Run this program on the suites instead of their methods: a command with its arguments that
    /// speaks the protocol of docs/protocol.md; repeatable if each has a name
    /// (`'mine=python mpm.py'`)
    #[arg(help_heading = SOLVER, long, value_name = "[NAME=]COMMAND")]
    pub(super) solver: Vec<SolverCommand>,
    /// Also run the methods of the suites, in the same report
    #[arg(help_heading = SOLVER, long, requires = "solver")]
    pub(super) with_methods: bool,
    #[command(flatten)]
    pub(super) limits: SolverLimitArgs,
}

#[derive(Debug, Clone)]
pub(super) struct SolverCommand {
    /// Name in reports; `None` for the solver's own name.
    pub(super) name: Option<String>,
    pub(super) command: String,
}

impl FromStr for SolverCommand {
    type Err = Expected;

    /// Parses `NAME=COMMAND` or `COMMAND`. A name consists of letters, digits, `-`, `_` and `.`.
    fn from_str(text: &str) -> Result<Self, Expected> {
        let is_name = |name: &str| {
            !name.is_empty()
                && name.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.'))
        };
        match text.split_once('=').filter(|(name, _)| is_name(name)) {
            Some((_, command)) if command.trim().is_empty() => {
                Err(Expected("a command after `=`".into()))
            }
            Some((name, command)) => {
                Ok(Self { name: Some(name.to_owned()), command: command.to_owned() })
            }
            None => Ok(Self { name: None, command: text.to_owned() }),
        }
    }
}

#[derive(Debug, Args)]
pub(super) struct SolverLimitArgs {
    /// Response timeout of the solver
    #[arg(help_heading = SOLVER, long, value_name = "TIME", value_parser = seconds, allow_hyphen_values = true, default_value = "60s")]
    pub(super) solver_timeout: f64,
    /// Maximum memory (address space) of each solver process, in MB [default: no limit]
    #[arg(help_heading = SOLVER, long, value_name = "MB", requires = "solver", value_parser = megabytes, allow_negative_numbers = true)]
    pub(super) solver_memory: Option<u64>,
}

#[derive(Debug, Args)]
pub(super) struct FormatArgs {
    /// Format of the output
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(super) format: Format,
}

impl FormatArgs {
    pub(super) fn is_json(&self) -> bool {
        self.format == Format::Json
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    /// Plain text
    Text,
    /// One JSON document
    Json,
}

/// Error of a value parser: a description of the accepted values.
#[derive(Debug, Error)]
#[error("expected {0}")]
pub(super) struct Expected(pub(super) Cow<'static, str>);

pub(super) fn seconds(text: &str) -> Result<f64, Expected> {
    let units = [("ms", 1e-3), ("min", 60.0), ("s", 1.0), ("h", 3600.0)];
    let known = units.iter().find_map(|(unit, size)| {
        let number: f64 = text.strip_suffix(unit)?.trim().parse().ok()?;
        Some(number * size)
    });
    let usable = known.filter(|time| *time > 0.0 && time.is_finite());
    usable.ok_or_else(|| Expected("a time with its unit, such as `10s` or `500ms`".into()))
}

pub(super) fn whole(text: &str) -> Result<usize, Expected> {
    text.parse().map_err(|_| Expected("a whole number".into()))
}

/// Parses a whole number of at least 1.
pub(super) fn count(text: &str) -> Result<usize, Expected> {
    let known = text.parse().ok().filter(|count| *count > 0);
    known.ok_or_else(|| Expected("a whole number, 1 or more".into()))
}

fn megabytes(text: &str) -> Result<u64, Expected> {
    count(text).map(|count| count as u64)
}

pub(super) fn number(text: &str) -> Result<f64, Expected> {
    let known = text.parse().ok().filter(|number: &f64| number.is_finite());
    known.ok_or_else(|| Expected("a finite number".into()))
}

/// Parses a finite number that is not negative.
pub(super) fn share(text: &str) -> Result<f64, Expected> {
    let known = number(text).ok().filter(|share| *share >= 0.0);
    known.ok_or_else(|| Expected("a finite number, zero or more".into()))
}

#[derive(Debug, Args)]
pub(super) struct ColorArgs {
    /// When to colour verdicts and errors; `auto`: on a terminal, unless NO_COLOR is set
    #[arg(long, value_enum, value_name = "WHEN", global = true, default_value_t = clap::ColorChoice::Auto)]
    color: clap::ColorChoice,
}

impl ColorArgs {
    pub(super) fn write_global(&self) {
        match self.color {
            clap::ColorChoice::Auto => ColorChoice::Auto,
            clap::ColorChoice::Always => ColorChoice::Always,
            clap::ColorChoice::Never => ColorChoice::Never,
        }
        .write_global();
    }
}

//! `mpm-verify new`: creates a suite to start from.

use super::arguments::FormatArgs;
use super::output::{self, CommandError, Status};
use clap::Args;
use mpm_verify::mpm::{BasisName, SchemeName, TransferName};
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::{Diagnostic, Source};
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Suites with a comment for each key, for 1, 2 and 3 dimensions.
///
/// The 3-D levels are coarse, so that every level runs within seconds. Each axis has a different
/// phase of the motion, so parts of the body are stretched while others are compressed.
const SUITES: [&str; 3] =
    [include_str!("bar.yaml"), include_str!("square.yaml"), include_str!("cube.yaml")];

#[derive(Debug, Args)]
pub(super) struct NewArgs {
    /// Name of the suite: lower-case letters, digits and hyphens
    #[arg(value_name = "NAME")]
    name: String,
    /// Number of space dimensions
    #[arg(long, value_name = "D", default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=3))]
    dimension: u8,
    /// File to write; an existing file is not changed [default: NAME.yaml]
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    format: FormatArgs,
}

pub(super) fn new(args: &NewArgs) -> Result<Status, CommandError> {
    let path = args.output.clone().unwrap_or_else(|| format!("{}.yaml", args.name).into());
    let text = text(args, &path);
    load(&args.name, &path, &text)?;
    save(&path, &text)?;
    let path = path.display().to_string();
    output::print(&if args.format.is_json() {
        format!("{:#}\n", serde_json::json!({"file": path}))
    } else {
        format!("wrote {path}\nnext: mpm-verify check {path}\n")
    });
    Ok(Status::Passed)
}

fn text(args: &NewArgs, path: &Path) -> String {
    let name = serde_json::Value::from(args.name.as_str()).to_string();
    SUITES[usize::from(args.dimension) - 1]
        .replace("$bases", &list(BasisName::ALL.iter().map(|basis| basis.name())))
        .replace("$transfers", &list(TransferName::ALL.iter().map(|transfer| transfer.name())))
        .replace("$schemes", &list(SchemeName::ALL.iter().map(|scheme| scheme.name())))
        .replacen("$name", &name, 1)
        .replace("$path", &path.display().to_string())
}

fn list<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.collect::<Vec<_>>().join(", ")
}

/// Loads the suite. Only its name can cause an error, so the diagnostic points to the name.
fn load(name: &str, path: &Path, text: &str) -> Result<Suite, Diagnostic> {
    let file = format!("{} (not written)", path.display());
    let suite = Source::from_text(file, text).and_then(|source| Suite::load(&source));
    suite.map_err(|diagnostic| {
        let at_name = Diagnostic::at("NAME", name, 0..name.len(), diagnostic.message());
        let (label, help) = (diagnostic.label(), diagnostic.help());
        at_name.with_label(label.unwrap_or_default()).with_help(help.unwrap_or_default())
    })
}

/// Writes a new file. An existing file is not overwritten.
fn save(path: &Path, text: &str) -> Result<(), CommandError> {
    let saved = File::create_new(path).and_then(|mut file| file.write_all(text.as_bytes()));
    saved.map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => CommandError::Message(format!(
            "{} already exists and is not overwritten; choose another file with --output",
            path.display()
        )),
        _ => CommandError::about(path.display(), error),
    })
}

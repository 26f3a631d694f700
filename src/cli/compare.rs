//! `mpm-verify compare`.

use super::arguments::share;
use super::output::{self, CommandError, Status};
use clap::Args;
use mpm_verify::report::compare::{self, ReportDocument, Unreadable};
use mpm_verify::suite::yaml::Diagnostic;
use std::ops::Range;
use std::path::Path;
use std::process::Command;
use std::{fs, io};

#[derive(Debug, Args)]
pub(super) struct CompareArgs {
    /// Old results: JSON of `mpm-verify run --format json`, a folder of `run --out`, a folder of
    /// snapshots, or a commit that has snapshots
    #[arg(value_name = "OLD")]
    old: String,
    /// New results, in any of the same forms
    #[arg(value_name = "NEW", default_value = "verification")]
    new: String,
    /// Folder of a commit that contains the snapshots
    #[arg(long, default_value = "verification")]
    folder: String,
    /// Maximum relative change of a value that counts as no change
    #[arg(long, value_name = "SHARE", default_value_t = compare::TOLERANCE, value_parser = share, allow_negative_numbers = true)]
    tolerance: f64,
}

const OVERVIEW: &str = "OVERVIEW.snap";

/// File name of the JSON results in a folder of `run --out`.
const REPORT: &str = "report.json";

enum ComparedResults {
    /// Results of a run, with all levels.
    Run(ReportDocument),
    /// Results from snapshots, with the finest level only.
    Snapshots(ReportDocument),
}

pub(super) fn compare(args: &CompareArgs) -> Result<Status, CommandError> {
    let (old, new) = match (side(&args.old, &args.folder), side(&args.new, &args.folder)) {
        (Ok(ComparedResults::Run(old)), Ok(ComparedResults::Run(new)))
        | (Ok(ComparedResults::Snapshots(old)), Ok(ComparedResults::Snapshots(new))) => (old, new),
        (Ok(_), Ok(_)) => {
            return Err(CommandError::Message(format!(
                "`{}` and `{}` are the results of a run and snapshots, which have different \
                 figures\nhelp: compare two runs (JSON), or two sets of snapshots (folders or \
                 commits)",
                args.old, args.new
            )));
        }
        (old, new) => {
            for diagnostic in [old.err(), new.err()].into_iter().flatten() {
                output::diagnose(&diagnostic);
            }
            return Ok(Status::BadInput);
        }
    };
    let changes = compare::compare(&old, &new, args.tolerance);
    output::print(&compare::text(&changes));
    Ok(if changes.is_worse() { Status::Failed } else { Status::Passed })
}

/// Loads the results at `place`: a file, a folder, or a commit whose snapshots are in `folder`.
fn side(place: &str, folder: &str) -> Result<ComparedResults, Diagnostic> {
    let path = Path::new(place);
    if path.is_dir() {
        return match fs::read_to_string(path.join(OVERVIEW)) {
            Ok(overview) => {
                Ok(snapshots(&overview, |file| fs::read_to_string(path.join(file)).ok()))
            }
            Err(_) if path.join(REPORT).is_file() => {
                run(&path.join(REPORT)).map(ComparedResults::Run)
            }
            Err(_) => {
                let message = format!("the folder `{place}` has neither {REPORT} nor {OVERVIEW}");
                let help = "expected a folder of `mpm-verify run --out`, or of snapshots";
                Err(Diagnostic::about(place, &message).with_help(help))
            }
        };
    }
    let is_file = path.is_file() || path.extension().is_some_and(|extension| extension == "json");
    if is_file {
        return run(path).map(ComparedResults::Run);
    }
    let overview = committed(place, &format!("{folder}/{OVERVIEW}")).map_err(|why| {
        let message = format!(
            "`{place}` is neither a file, nor a folder, nor a commit with snapshots: \
                     {why}"
        );
        let help = format!("expected a commit whose tree has {folder}/{OVERVIEW}; see `--folder`");
        Diagnostic::about(place, &message).with_help(&help)
    })?;
    Ok(snapshots(&overview, |file| committed(place, &format!("{folder}/{file}")).ok()))
}

fn snapshots(overview: &str, read: impl Fn(&str) -> Option<String>) -> ComparedResults {
    let report = |group: &str, suite: &str| read(&format!("{group}/{suite}.snap"));
    ComparedResults::Snapshots(ReportDocument::of_snapshots(overview, report))
}

fn committed(commit: &str, file: &str) -> io::Result<String> {
    if commit.starts_with('-') {
        return Err(io::Error::other("the name of a commit cannot begin with a dash"));
    }
    let output = Command::new("git").args(["show", &format!("{commit}:./{file}")]).output();
    let output = output.map_err(|error| io::Error::other(format!("git cannot be run: {error}")))?;
    if output.status.success() {
        String::from_utf8(output.stdout).map_err(io::Error::other)
    } else {
        Err(io::Error::other(String::from_utf8_lossy(&output.stderr).trim().to_owned()))
    }
}

fn run(path: &Path) -> Result<ReportDocument, Diagnostic> {
    let file = path.display().to_string();
    let text = fs::read_to_string(path).map_err(|error| {
        let message = format!("this file cannot be read: {error}");
        Diagnostic::about(&file, &message)
    })?;
    ReportDocument::read(&text).map_err(|unreadable| {
        let Unreadable { message, place } = unreadable;
        let diagnostic = match place {
            Some((line, column)) => {
                Diagnostic::at(&file, &text, bytes(&text, line, column), &message)
            }
            None => Diagnostic::about(&file, &message),
        };
        let help = "expected the document that `mpm-verify run --format json` prints";
        diagnostic.with_help(help)
    })
}

/// Converts a line and a column (in bytes) to a byte range.
fn bytes(text: &str, line: usize, column: usize) -> Range<usize> {
    let start: usize = text.split_inclusive('\n').take(line - 1).map(str::len).sum();
    let at = (start + column - 1).min(text.len());
    at..at + 1
}

//! `mpm-verify diff`.

use super::args::DiffArgs;
use super::compare::print;
use super::output;
use super::status::BAD_INPUT;
use mpm_verify::report::compare::{self, ReportDocument};
use mpm_verify::suite::yaml::Diagnostic;
use std::path::Path;
use std::process::Command;

/// Name of the snapshot of all cases.
const OVERVIEW: &str = "OVERVIEW.snap";

/// Prints what moved between two sets of snapshots.
pub(super) fn diff(args: &DiffArgs) -> u8 {
    let sides = [&args.old, &args.new].map(|side| document(side, &args.folder));
    let [old, new] = match sides {
        [Ok(old), Ok(new)] => [old, new],
        sides => {
            for diagnostic in sides.into_iter().filter_map(Result::err) {
                output::diagnose(&diagnostic);
            }
            return BAD_INPUT;
        }
    };
    print(&compare::compare(&old, &new, compare::TOLERANCE), args.format)
}

/// The snapshots of a folder, or of a commit.
fn document(side: &str, folder: &str) -> Result<ReportDocument, Diagnostic> {
    let is_folder = Path::new(side).is_dir();
    let read = |file: &str| {
        if is_folder {
            std::fs::read_to_string(Path::new(side).join(file)).map_err(|error| error.to_string())
        } else {
            committed(side, &format!("{folder}/{file}"))
        }
    };
    let overview = read(OVERVIEW).map_err(|why| {
        let message = format!("`{side}` has no {OVERVIEW} that can be read: {why}");
        let help = "expected a folder of snapshots, or a commit whose tree has one (`--folder`)";
        Diagnostic::about(side, &message).with_help(help)
    })?;
    let report = |group: &str, suite: &str| read(&format!("{group}/{suite}.snap")).ok();
    Ok(ReportDocument::of_snapshots(&overview, report))
}

/// The text of a file as a commit has it.
fn committed(commit: &str, file: &str) -> Result<String, String> {
    if commit.starts_with('-') {
        return Err("a commit does not begin with a dash".to_owned());
    }
    let output = Command::new("git").args(["show", &format!("{commit}:./{file}")]).output();
    let output = output.map_err(|error| format!("git cannot be run: {error}"))?;
    if output.status.success() {
        String::from_utf8(output.stdout).map_err(|error| error.to_string())
    } else {
        Err(String::from_utf8_lossy(&output.stderr).trim().to_owned())
    }
}

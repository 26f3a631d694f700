//! Snapshots without Rust: `run --snapshots` compares reports, and `accept` accepts changes.

use super::output::{self, CommandError, Status};
use clap::Args;
use mpm_verify::report::{self, counted, drift};
use mpm_verify::suite::yaml::Source;
use mpm_verify::verify::{CaseOutcome, SuiteOutcome};
use similar::TextDiff;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// First lines of a snapshot, in the format of `insta`.
const HEAD: &str = "---\nsource: mpm-verify run --snapshots\n---\n";

/// Extension of a changed report next to its snapshot, as for `cargo insta review`.
const PENDING: &str = "snap.new";

#[derive(Debug, Args)]
pub(super) struct AcceptArgs {
    /// Folders with changed snapshots, or changed snapshots (`SUITE.snap.new`) [default:
    /// verification/, or the current folder if there is no such folder]
    #[arg(value_name = "PATH")]
    paths: Vec<PathBuf>,
}

/// Replaces snapshots by the changed reports that `run --snapshots` or `cargo test` has written.
pub(super) fn accept(args: &AcceptArgs) -> Result<Status, CommandError> {
    let default = ["verification", "."].map(PathBuf::from).into_iter().find(|path| path.is_dir());
    let paths = if args.paths.is_empty() { default.as_slice() } else { &args.paths };
    let mut count = 0;
    for path in paths {
        let unusable = |error| CommandError::about(path.display(), error);
        for new in pending(path).map_err(unusable)? {
            fs::rename(&new, new.with_extension("")).map_err(unusable)?;
            output::print(&format!("accepted {}\n", new.with_extension("").display()));
            count += 1;
        }
    }
    output::print(&format!("{} accepted\n", counted(count, "snapshot")));
    if count == 0 {
        output::next([("run --snapshots", "compares reports with snapshots")]);
    }
    Ok(Status::Passed)
}

/// Returns all changed snapshots in a folder and its subfolders, or the path itself.
fn pending(path: &Path) -> io::Result<Vec<PathBuf>> {
    let is_pending = path.to_string_lossy().ends_with(&format!(".{PENDING}"));
    if !path.is_dir() {
        let reason = format!("expected a folder or a file SUITE.{PENDING}");
        return if is_pending { Ok(vec![path.into()]) } else { Err(io::Error::other(reason)) };
    }
    let mut found = Vec::new();
    for entry in fs::read_dir(path)? {
        let entry = entry?.path();
        if entry.is_dir() && !entry.is_symlink() || entry.to_string_lossy().ends_with(PENDING) {
            found.extend(pending(&entry)?);
        }
    }
    found.sort();
    Ok(found)
}

/// Compares each report with its snapshot in `folder`, or next to the suite, and returns whether
/// all agree. A different report without failing cases is written next to the snapshot.
pub(super) fn compare(
    folder: Option<&Path>,
    sources: &[Source],
    outcomes: &[SuiteOutcome],
    print: fn(&str),
) -> Result<bool, CommandError> {
    let mut differ = 0;
    for (source, outcome) in sources.iter().zip(outcomes) {
        if !outcome.cases.iter().any(CaseOutcome::is_tested) {
            continue;
        }
        let file = Path::new(source.name());
        let beside = file.parent().filter(|_| file.is_file());
        let Some(folder) = folder.or(beside) else {
            let reason = format!("{} is in no folder\nhelp: --snapshots=DIR", outcome.suite);
            return Err(CommandError::about("--snapshots", reason));
        };
        let path = folder.join(format!("{}.snap", outcome.suite));
        let unusable = |error| CommandError::option("--snapshots", path.display(), error);
        let (text, new) = (report::text(outcome), path.with_extension(PENDING));
        let stored = match fs::read_to_string(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            read => read.map(Some),
        };
        let stored = stored.map_err(unusable)?;
        if stored.as_deref().is_some_and(|stored| drift::same_as_snapshot(stored, &text)) {
            let _ = fs::remove_file(&new);
            continue;
        }
        differ += 1;
        let old = stored.as_deref().map_or("", drift::contents);
        let diff = TextDiff::from_lines(old, &text);
        let (old_name, new_name) = (path.display().to_string(), new.display().to_string());
        print(&diff.unified_diff().header(&old_name, &new_name).to_string());
        if outcome.passed() {
            fs::create_dir_all(folder).map_err(unusable)?;
            fs::write(&new, format!("{HEAD}{text}")).map_err(unusable)?;
        } else {
            print(&format!("{new_name} is not written, because a case fails\n"));
        }
    }
    if differ > 0 {
        let changed = counted(differ, "changed report");
        print(&format!("{changed}; `mpm-verify accept` accepts the written ones\n"));
    }
    Ok(differ == 0)
}

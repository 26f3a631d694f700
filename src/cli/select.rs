//! Suites that the user names.

use mpm_verify::suite::yaml::{Diagnostic, Source};
use mpm_verify::suite::{Suite, embedded};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Where suites are looked for by default.
const FOLDER: &str = "verification";

/// The suites that `targets` name, each loaded or with the complaint that says why not.
///
/// With no target: all of `verification/`, or the embedded suites where there is no such folder.
pub(super) fn suites(targets: &[PathBuf]) -> Vec<Result<Suite, Diagnostic>> {
    with_sources(targets).into_iter().map(|found| found.map(|(_, suite)| suite)).collect()
}

/// The same, each with the file that it came from.
pub(super) fn with_sources(targets: &[PathBuf]) -> Vec<Result<(Source, Suite), Diagnostic>> {
    let sources = if targets.is_empty() {
        everything()
    } else {
        targets.iter().flat_map(|target| sources(target)).collect()
    };
    // The check of a truth takes a tenth of a second; there may be many.
    let load = |source: Source| Suite::load(&source).map(|suite| (source, suite));
    sources.into_par_iter().map(|source| source.and_then(load)).collect()
}

type Sources = Vec<Result<Source, Diagnostic>>;

fn everything() -> Sources {
    let folder = Path::new(FOLDER);
    if folder.is_dir() {
        files_in(folder)
    } else {
        embedded::names().filter_map(embedded::source).collect()
    }
}

fn sources(target: &Path) -> Sources {
    if target.is_dir() {
        return files_in(target);
    }
    let name = target.to_string_lossy();
    let looks_like_a_path = target.extension().is_some() || name.contains(['/', '\\']);
    if target.exists() || looks_like_a_path {
        return vec![Source::read(target)];
    }
    let local = Path::new(FOLDER).join(format!("{name}.yaml"));
    if local.is_file() {
        return vec![Source::read(local)];
    }
    vec![embedded::source(&name).unwrap_or_else(|| Err(unknown(&name)))]
}

fn unknown(name: &str) -> Diagnostic {
    let diagnostic = Diagnostic::about(name, &format!("there is no suite called `{name}`"));
    let near = |known: &&str| strsim::jaro_winkler(known, name) > 0.8;
    if let Some(known) = embedded::names().find(near) {
        return diagnostic.with_help(&format!("did you mean `{known}`?"));
    }
    let known = embedded::names().count();
    diagnostic.with_help(&format!("`mpm-verify list` shows the {known} that are built in"))
}

/// Every `.yaml` file of a folder, sorted by name.
fn files_in(folder: &Path) -> Sources {
    let name = folder.display().to_string();
    let entries = match std::fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) => {
            let message = format!("this folder cannot be read: {error}");
            return vec![Err(Diagnostic::about(&name, &message))];
        }
    };
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let mut files: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|e| e == "yaml" || e == "yml")).collect();
    files.sort();
    if files.is_empty() {
        return vec![Err(Diagnostic::about(&name, "this folder holds no suite (no .yaml file)"))];
    }
    files.into_iter().map(Source::read).collect()
}

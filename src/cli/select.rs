//! Suites that the user names.

use super::args::Cli;
use clap::CommandFactory;
use mpm_verify::nearest;
use mpm_verify::suite::yaml::{Diagnostic, Source};
use mpm_verify::suite::{Suite, embedded};
use rayon::prelude::*;
use std::ffi::OsStr;
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

/// Files and folders that `targets` name: what can change.
///
/// # Errors
/// If one of them names no file: a suite that is built in, or none.
pub(super) fn places(targets: &[PathBuf]) -> Result<Vec<PathBuf>, Diagnostic> {
    if targets.is_empty() {
        let folder = Path::new(FOLDER);
        let message = format!("there is no folder `{FOLDER}/` to watch");
        let help = "name a file or a folder: suites that are built in do not change";
        let found = folder.is_dir().then(|| vec![folder.to_path_buf()]);
        return found.ok_or_else(|| Diagnostic::about("--watch", &message).with_help(help));
    }
    targets.iter().map(|target| place(target).ok_or_else(|| no_file(target))).collect()
}

fn no_file(target: &Path) -> Diagnostic {
    let name = target.to_string_lossy();
    if embedded::source(&name).is_none() {
        return unknown(&name);
    }
    let message = format!("`{name}` is built in: there is no file to watch");
    Diagnostic::about("--watch", &message).with_help("name a file or a folder")
}

/// File or folder that `target` names, there or not; none for a name alone.
fn place(target: &Path) -> Option<PathBuf> {
    let name = target.to_string_lossy();
    let looks_like_a_path = target.extension().is_some() || name.contains(['/', '\\']);
    if target.exists() || looks_like_a_path {
        return Some(target.to_path_buf());
    }
    let local = Source::files_in(Path::new(FOLDER)).unwrap_or_default();
    local.into_iter().find(|file| file.file_stem() == Some(target.as_os_str()))
}

fn sources(target: &Path) -> Sources {
    let name = target.to_string_lossy();
    match place(target) {
        Some(folder) if folder.is_dir() => files_in(&folder),
        Some(file) if file.exists() => vec![Source::read(file)],
        Some(file) => {
            let help = meant_by_path(&file);
            vec![Source::read(file).map_err(|diagnostic| diagnostic.with_help(&help))]
        }
        None => vec![embedded::source(&name).unwrap_or_else(|| Err(unknown(&name)))],
    }
}

/// Meaning of the path of a file that is not there: a file beside it, or a suite by its name.
fn meant_by_path(target: &Path) -> String {
    let text = |part: Option<&OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    let folder = target.parent().unwrap_or(Path::new(""));
    let here = if folder == Path::new("") { Path::new(".") } else { folder };
    let beside = Source::files_in(here).unwrap_or_default();
    let names: Vec<String> = beside.iter().map(|path| text(path.file_name())).collect();
    let near = nearest(&text(target.file_name()), names.iter().map(String::as_str));
    if let Some(path) = near.and_then(|file| beside.iter().find(|path| path.ends_with(file))) {
        let path = if folder == here { path } else { path.strip_prefix(here).unwrap_or(path) };
        return format!("did you mean `{}`?", path.display());
    }
    let suites = suite_names();
    nearest(&text(target.file_stem()), suites.iter().map(String::as_str))
        .map_or_else(String::new, |suite| format!("did you mean the suite `{suite}`?"))
}

fn unknown(name: &str) -> Diagnostic {
    let diagnostic = Diagnostic::about(name, &format!("there is no suite called `{name}`"));
    let suites = suite_names();
    let cli = Cli::command();
    // Behind a command, another one makes no sense.
    let first = std::env::args_os().nth(1).is_some_and(|first| first == name);
    let commands = cli.get_subcommands().filter(|_| first).map(clap::Command::get_name);
    let help = match nearest(name, suites.iter().map(String::as_str).chain(commands)) {
        Some(near) if suites.iter().any(|suite| suite == near) => format!("did you mean `{near}`?"),
        Some(command) => format!("did you mean the command `{command}`?"),
        None => {
            let known = embedded::names().count();
            format!("`mpm-verify list` shows the {known} that are built in")
        }
    };
    diagnostic.with_help(&help)
}

/// Names by which suites can be asked for: those of the default folder, and the embedded ones.
fn suite_names() -> Vec<String> {
    let local = Source::files_in(Path::new(FOLDER)).unwrap_or_default();
    let name = |path: &PathBuf| Some(path.file_stem()?.to_string_lossy().into_owned());
    local.iter().filter_map(name).chain(embedded::names().map(ToOwned::to_owned)).collect()
}

/// The suites of a folder.
fn files_in(folder: &Path) -> Sources {
    let name = folder.display().to_string();
    match Source::files_in(folder) {
        Ok(files) if files.is_empty() => {
            vec![Err(Diagnostic::about(&name, "this folder holds no suite (no .yaml file)"))]
        }
        Ok(files) => files.into_iter().map(Source::read).collect(),
        Err(error) => {
            let message = format!("this folder cannot be read: {error}");
            vec![Err(Diagnostic::about(&name, &message))]
        }
    }
}

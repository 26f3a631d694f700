//! Finds and loads the suites that the command line names.

use mpm_verify::embedded;
use mpm_verify::nearest;
use mpm_verify::suite::yaml::{self, Diagnostic, Source};
use mpm_verify::suite::{Suite, pattern};
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::io;
use std::path::{Path, PathBuf};

const FOLDER: &str = "verification";

const STDIN: &str = "-";

/// Loads the suites that `targets` name, or returns a diagnostic for each invalid one.
///
/// Without targets, loads all suites in `verification/`, or else the built-in suites.
pub(super) fn suites(targets: &[PathBuf]) -> Vec<Result<Suite, Diagnostic>> {
    with_sources(targets).into_iter().map(|found| found.map(|(_, suite)| suite)).collect()
}

pub(super) fn with_sources(targets: &[PathBuf]) -> Vec<Found> {
    load(targets, |source| source)
}

/// Loads suites like [`with_sources`], without checking their solutions.
pub(super) fn unchecked(targets: &[PathBuf]) -> Vec<Found> {
    load(targets, Source::trusted)
}

fn load(targets: &[PathBuf], prepare: fn(Source) -> Source) -> Vec<Found> {
    let folder = Path::new(FOLDER);
    let sources = match targets {
        [] if folder.is_dir() => files_in(folder),
        [] => embedded::names().filter_map(embedded::source).collect(),
        _ => targets.iter().flat_map(|target| sources(target)).collect(),
    };
    // Suites are loaded in parallel, because checking an exact solution takes 0.1 s.
    let load = |source: Source| Suite::load(&source).map(|suite| (source, suite));
    sources.into_par_iter().map(|source| source.map(prepare).and_then(load)).collect()
}

/// A suite with its text, or the error in the text.
pub(super) type Found = Result<(Source, Suite), Diagnostic>;

type Sources = Vec<Result<Source, Diagnostic>>;

/// Group of suites for a first look.
const FIRST: &str = "the-talk";

/// Returns the targets for a first look: one group, or all suites of a project without this group.
pub(super) fn first_suites() -> Option<String> {
    let folder = Path::new(FOLDER);
    (!folder.is_dir() || folder.join(FIRST).is_dir()).then(|| FIRST.to_owned())
}

/// Returns the names of the suites that `targets` name individually: by file, by name or on
/// standard input, not by folder, group or pattern. `suites` are all selected suites.
pub(super) fn named_singly(targets: &[PathBuf], suites: &[Suite]) -> BTreeSet<String> {
    #[derive(serde::Deserialize)]
    struct Name {
        suite: String,
    }
    if targets.iter().any(|target| target.as_os_str() == STDIN) {
        // Standard input cannot be read twice.
        return suites.iter().map(|suite| suite.name.clone()).collect();
    }
    let is_one = |target: &&PathBuf| match place(target) {
        Some(place) => place.is_file(),
        None => embedded::source(&target.to_string_lossy()).is_some(),
    };
    let sources = targets.iter().filter(is_one).flat_map(|target| sources(target));
    let name = |source: Source| Some(yaml::read::<Name>(&source).ok()?.suite);
    sources.filter_map(|source| name(source.ok()?)).collect()
}

/// Whether `target` names existing suites, or looks like a path.
pub(super) fn is_known(target: &str) -> bool {
    let path = Path::new(target);
    target == STDIN || is_pattern(path) || place(path).is_some() || named(target).is_some()
}

fn is_pattern(target: &Path) -> bool {
    target.to_string_lossy().contains('*') && !target.exists()
}

/// Returns the file or folder that `target` names, even if missing; `None` for a plain name.
fn place(target: &Path) -> Option<PathBuf> {
    let name = target.to_string_lossy();
    if name == STDIN || is_pattern(target) {
        return None;
    }
    let looks_like_a_path = target.extension().is_some() || name.contains(['/', '\\']);
    if target.exists() || looks_like_a_path {
        return Some(target.to_path_buf());
    }
    let local = Source::files_in(Path::new(FOLDER)).unwrap_or_default();
    let of_name = local.into_iter().find(|file| file.file_stem() == Some(target.as_os_str()));
    // A built-in suite takes precedence over a group of local suites.
    let group = || Some(Path::new(FOLDER).join(target)).filter(|group| group.is_dir());
    of_name.or_else(|| if embedded::source(&name).is_none() { group() } else { None })
}

fn sources(target: &Path) -> Sources {
    let name = target.to_string_lossy();
    if name == STDIN {
        return vec![Source::from_reader("<stdin>", io::stdin().lock())];
    }
    match place(target) {
        Some(folder) if folder.is_dir() => files_in(&folder),
        Some(file) if file.exists() => vec![Source::read(file)],
        Some(file) => {
            let help = meant_by_path(&file);
            vec![Source::read(file).map_err(|diagnostic| diagnostic.with_help(&help))]
        }
        None if is_pattern(target) => fitting(&name),
        None => named(&name).unwrap_or_else(|| vec![Err(unknown(&name))]),
    }
}

/// Returns the built-in suite with this name, or else the suites of the group with this name.
fn named(name: &str) -> Option<Sources> {
    if let Some(suite) = embedded::source(name) {
        return Some(vec![suite]);
    }
    let of_group = embedded::paths().filter(|(_, path)| Source::group_of(path) == name);
    let group: Sources = of_group.filter_map(|(suite, _)| embedded::source(suite)).collect();
    Some(group).filter(|group| !group.is_empty())
}

/// Returns the suites whose `NAME` or `GROUP/NAME` matches a pattern.
fn fitting(glob: &str) -> Sources {
    let fits = |path: &Path| {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let in_group = format!("{}/{name}", Source::group_of(path));
        pattern::fits(glob, &name) || pattern::fits(glob, &in_group)
    };
    let folder = Path::new(FOLDER);
    let found: Sources = if folder.is_dir() {
        let files = Source::files_in(folder).unwrap_or_default().into_iter();
        files.filter(|path| fits(path)).map(Source::read).collect()
    } else {
        let fitting = embedded::paths().filter(|(_, path)| fits(path));
        fitting.filter_map(|(suite, _)| embedded::source(suite)).collect()
    };
    if !found.is_empty() {
        return found;
    }
    let diagnostic = Diagnostic::about(glob, &format!("no suite matches `{glob}`"));
    vec![Err(diagnostic.with_help("`*` stands for any text: `mms-*`, `heat/*`"))]
}

/// Suggests a similar file name in the same folder, or a suite with the name of the file.
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
    let near = nearest(name, suites.iter().map(String::as_str));
    let help = near.map_or_else(
        || format!("`mpm-verify list` shows the {} that are built in", embedded::names().count()),
        |near| format!("did you mean `{near}`?"),
    );
    diagnostic.with_help(&help)
}

pub(super) fn suite_names() -> Vec<String> {
    let local = Source::files_in(Path::new(FOLDER)).unwrap_or_default();
    let groups = local.iter().map(|path| Source::group_of(path));
    let name = |path: &PathBuf| Some(path.file_stem()?.to_string_lossy().into_owned());
    let mut names: Vec<String> = local.iter().filter_map(name).collect();
    names.extend(embedded::names().map(ToOwned::to_owned));
    names.extend(groups.filter(|group| group != FOLDER));
    names.extend(embedded::paths().map(|(_, path)| Source::group_of(path)));
    names
}

fn files_in(folder: &Path) -> Sources {
    let name = folder.display().to_string();
    match Source::files_in(folder) {
        Ok(files) if files.is_empty() => {
            vec![Err(Diagnostic::about(&name, "this folder contains no suite (no .yaml file)"))]
        }
        Ok(files) => files.into_iter().map(Source::read).collect(),
        Err(error) => {
            let message = format!("this folder cannot be read: {error}");
            vec![Err(Diagnostic::about(&name, &message))]
        }
    }
}

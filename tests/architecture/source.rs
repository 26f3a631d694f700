//! The source files of all packages, and their code without tests.

use crate::token::{Token, tokens};
use std::collections::BTreeSet;
use std::fs;
use std::ops::Range;
use std::path::Path;
use std::sync::LazyLock;

/// Names from the crate's root down; the root (`lib.rs`) has none.
pub(crate) type Module = Vec<String>;

/// One file, which is one module; a `mod.rs` is the module of its folder.
#[derive(Debug, Clone)]
pub(crate) struct Source {
    /// Path from the root of the repository, with `/`.
    pub(crate) file: String,
    pub(crate) module: Module,
    /// Code without comments, strings and items under `#[cfg(test)]`.
    pub(crate) code: Vec<Token>,
    /// Code under `#[cfg(test)]`.
    pub(crate) tests: Vec<Token>,
    /// Whether all of the file is compiled for tests only.
    pub(crate) for_tests: bool,
    /// Number of lines, without those under `#[cfg(test)]`.
    pub(crate) lines: usize,
}

/// Folders with the sources of the packages.
pub(crate) const SOURCES: [&str; 5] =
    ["src", "crates/judge/src", "crates/solvers/src", "crates/subject/src", "crates/suites/src"];

/// Every source file of all packages, including those that are compiled for tests only.
pub(crate) static ALL: LazyLock<Vec<Source>> = LazyLock::new(|| with_tests(&of_sources()));

/// Every source file of all packages except those that are compiled for tests only.
pub(crate) static OF_PACKAGES: LazyLock<Vec<Source>> =
    LazyLock::new(|| ALL.iter().filter(|source| !source.for_tests).cloned().collect());

/// Paths and texts of the source files of all packages.
fn of_sources() -> Vec<(String, String)> {
    SOURCES.iter().flat_map(|folder| texts(folder, ".rs")).collect()
}

/// Paths (relative to the root of the repository) and texts of the files below `folder` (`""` for
/// all) whose names end in `end`, without build output.
pub(crate) fn texts(folder: &str, end: &str) -> Vec<(String, String)> {
    let files = paths(folder).into_iter().filter(|file| file.ends_with(end));
    let read = |file: &String| fs::read_to_string(root().join(file)).expect("a readable text");
    files.map(|file| (file.clone(), read(&file))).collect()
}

/// Paths of all files below `folder`, in order.
pub(crate) fn paths(folder: &str) -> Vec<String> {
    let mut files = Vec::new();
    collect(folder, &mut files);
    files.sort_unstable();
    files
}

/// The root of the repository.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn collect(folder: &str, files: &mut Vec<String>) {
    for entry in fs::read_dir(root().join(folder)).expect("a folder can be listed") {
        let entry = entry.expect("a folder can be listed");
        let name = entry.file_name().into_string().expect("a UTF-8 name");
        let file = if folder.is_empty() { name.clone() } else { format!("{folder}/{name}") };
        if !entry.path().is_dir() {
            files.push(file);
        } else if !name.starts_with('.') && name != "target" {
            collect(&file, files);
        }
    }
}

/// The sources among `files`, pairs of path and text.
pub(crate) fn of_files(files: &[(String, String)]) -> Vec<Source> {
    let mut sources = with_tests(files);
    sources.retain(|source| !source.for_tests);
    sources
}

/// The sources among `files`, including files that are compiled for tests only. All code of these
/// counts as tests.
pub(crate) fn with_tests(files: &[(String, String)]) -> Vec<Source> {
    let mut for_tests = BTreeSet::new();
    let mut sources: Vec<Source> =
        files.iter().map(|(file, text)| source(file, text, &mut for_tests)).collect();
    for source in &mut sources {
        let above = |n| source.module[..n].to_vec();
        let for_tests = (0..=source.module.len()).any(|n| for_tests.contains(&above(n)));
        source.for_tests = for_tests || source.file.contains("/tests/");
        if source.for_tests {
            source.tests.append(&mut source.code);
        }
    }
    sources.sort_by(|a, b| a.file.cmp(&b.file));
    sources
}

/// Also notes the modules that `text` declares for tests only.
fn source(file: &str, text: &str, for_tests: &mut BTreeSet<Module>) -> Source {
    let module = module(file);
    let (mut code, mut tests, mut lines) = (tokens(text), Vec::new(), text.lines().count());
    while let Some(item) = test_item(&code) {
        let words: Vec<&str> = code[item.clone()].iter().map(|t| t.text.as_str()).collect();
        if let [.., "mod", name, ";"] = words[..] {
            for_tests.insert([&module[..], &[name.to_owned()]].concat());
        }
        lines -= code[item.end - 1].line - code[item.start].line + 1;
        tests.extend(code.drain(item));
    }
    Source { file: file.to_owned(), module, code, tests, for_tests: false, lines }
}

fn module(file: &str) -> Module {
    let path = file.trim_end_matches(".rs");
    let path = path.strip_suffix("/mod").unwrap_or(path);
    // Modules have the same paths as in the root package, which re-exports them.
    let path = match path.strip_prefix("crates/subject/src/") {
        Some("lib") => "subject".to_owned(),
        Some(inner) => format!("subject/{inner}"),
        None => SOURCES
            .iter()
            .find_map(|folder| path.strip_prefix(folder)?.strip_prefix('/'))
            .unwrap_or(path)
            .to_owned(),
    };
    let is_root = path == "lib" && !file.starts_with("crates/");
    if is_root { Module::new() } else { path.split('/').map(str::to_owned).collect() }
}

/// Range of the first item under `#[cfg(test)]`, from its attribute to its `;` or `}`.
fn test_item(code: &[Token]) -> Option<Range<usize>> {
    let attribute = ["#", "[", "cfg", "(", "test", ")", "]"];
    let texts = |window: &[Token]| window.iter().zip(attribute).all(|(t, a)| t.text == a);
    let start = code.windows(attribute.len()).position(texts)?;
    let (mut depth, mut at) = (0, start + attribute.len());
    while let Some(token) = code.get(at) {
        at += 1;
        depth += match token.text.as_str() {
            "(" | "[" | "{" => 1,
            ")" | "]" | "}" => -1,
            _ => 0,
        };
        if depth == 0 && matches!(token.text.as_str(), ";" | "}") {
            break;
        }
    }
    Some(start..at)
}

//! Checks of the documents against the repository: links, paths, names of the crate, commands and
//! JSON.
//!
//! `tests/it/documents.rs` has the checks that need the program: it parses command lines, and loads
//! suites.

use crate::markdown::{Block, Document, Span};
use crate::rules::Breach;
use crate::source::SOURCES;
use std::collections::BTreeSet;

/// Paths that are not in the repository and that documents may name, each with its reason.
const MADE_LATER: &[(&str, &str)] = &[
    ("tests/fuzz/artifacts", "cargo-fuzz writes it"),
    ("tests/verification.rs", "a reader writes it, in a crate of their own"),
];

/// Folders with the keys of JSON documents: reports, messages, and numbers of loads.
const KEYS_IN: &[&str] = &[
    "src/report/",
    "crates/judge/src/verify/",
    "crates/suites/src/external/",
    "crates/solvers/src/mpm/material/",
    "crates/suites/src/suite/scene/load/",
];

/// The repository as documents may speak of it.
pub(crate) struct Repository {
    /// Paths of all files.
    pub(crate) files: BTreeSet<String>,
    /// All words in sources, tests and benches, including strings.
    pub(crate) words: BTreeSet<String>,
    /// All words in `src/report`, including strings, and so the keys of the JSON.
    pub(crate) keys: BTreeSet<String>,
    /// Paths of the tests, which begin with their target: `unit::exact::gauss::tests::NAME`,
    /// `it::judge::NAME`.
    pub(crate) tests: BTreeSet<String>,
    /// The text of `Cargo.toml`.
    pub(crate) manifest: String,
}

impl Repository {
    pub(crate) fn new(files: &[String], texts: &[(String, String)], manifest: &str) -> Self {
        let words_of = |folders: &[&str]| -> BTreeSet<String> {
            let read = texts.iter().filter(|(file, _)| folders.iter().any(|f| file.starts_with(f)));
            read.flat_map(|(_, text)| words(text)).map(str::to_owned).collect()
        };
        Self {
            files: files.iter().cloned().collect(),
            words: words_of(&["src/", "crates/", "tests/", "benches/"]),
            keys: words_of(KEYS_IN),
            tests: texts.iter().flat_map(|(file, text)| tests(file, text)).collect(),
            manifest: manifest.to_owned(),
        }
    }

    /// Whether `path` is a file or a folder; `*`, and words in capitals, match any text.
    fn has(&self, path: &str) -> bool {
        let path = path.trim_end_matches('/');
        self.files.iter().any(|file| {
            let mut parts = file.split('/');
            path.split('/').all(|wanted| parts.next().is_some_and(|part| like(wanted, part)))
        })
    }

    /// Whether `path` exists relative to the root, to `src/`, or to the folder of the document
    /// `from`.
    fn finds(&self, path: &str, from: &str) -> bool {
        let beside = join(from, path);
        let later = MADE_LATER.iter().any(|(made, _)| *made == path.trim_end_matches('/'));
        later
            || self.has(path)
            || in_sources(path).iter().any(|path| self.has(path))
            || beside.is_some_and(|p| self.has(&p))
    }

    fn has_name(&self, name: &str) -> bool {
        self.files.iter().any(|file| file.rsplit('/').next() == Some(name))
    }

    /// Whether a path begins as one of this repository does.
    fn is_ours(&self, path: &str) -> bool {
        let first = path.split('/').next().unwrap_or_default();
        let folder = |at: &str| self.files.iter().any(|file| file.starts_with(&format!("{at}/")));
        !first.is_empty() && (folder(first) || in_sources(first).iter().any(|at| folder(at)))
    }

    /// Whether `a::b::Name` resolves to a module of `src/` and a word of its code.
    fn resolves(&self, path: &str) -> bool {
        let mut parts: Vec<&str> = path.split("::").collect();
        if matches!(parts[0], "crate" | "mpm_verify" | "mpm_judge" | "mpm_solvers" | "mpm_subject")
        {
            parts.remove(0);
        }
        SOURCES.iter().any(|folder| self.resolves_in(folder, &parts))
    }

    fn resolves_in(&self, folder: &str, parts: &[&str]) -> bool {
        let (mut folder, mut rest) = (folder.to_owned(), parts);
        while let Some((part, after)) = rest.split_first() {
            let below = format!("{folder}/{part}");
            if !self.has(&below) && !self.has(&format!("{below}.rs")) {
                break;
            }
            folder = below;
            rest = after;
        }
        rest.len() < parts.len() && rest.iter().all(|part| self.words.contains(*part))
    }

    /// Whether a package has a module of this name at its top.
    fn is_part(&self, name: &str) -> bool {
        matches!(name, "crate" | "mpm_verify")
            || in_sources(name).iter().any(|at| self.has(at) || self.has(&format!("{at}.rs")))
    }
}

/// The paths that `path` may stand for, one in each package.
fn in_sources(path: &str) -> [String; 5] {
    SOURCES.map(|folder| format!("{folder}/{path}"))
}

/// `wanted` may contain `*`, or be a word in capitals, which matches any text.
fn like(wanted: &str, part: &str) -> bool {
    let (stem, end) = wanted.split_once('.').unwrap_or((wanted, ""));
    let capitals = stem.len() > 2 && stem.bytes().all(|b| b.is_ascii_uppercase());
    match wanted.split_once('*') {
        Some((start, end)) => part.starts_with(start) && part.ends_with(end),
        None if capitals && wanted != part => part.ends_with(end),
        None => wanted == part,
    }
}

/// `path` in the document `from`, relative to the root; `None` if it leaves the repository.
fn join(from: &str, path: &str) -> Option<String> {
    let mut parts: Vec<&str> = from.split('/').collect();
    parts.pop();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop()?;
            }
            part => parts.push(part),
        }
    }
    Some(parts.join("/"))
}

/// Paths of the tests in a formatted file. Only the line that ends a module is a brace at the
/// indentation of the module.
fn tests(file: &str, text: &str) -> Vec<String> {
    let path = match file.split_once("src/") {
        Some(("", inner)) => format!("lib/{inner}"),
        Some(("crates/judge/", inner)) => format!("judge/{inner}"),
        Some((_, inner)) => format!("solvers/{inner}"),
        None => match file.split_once("tests/") {
            Some((_, inner)) => inner.to_owned(),
            None => return Vec::new(),
        },
    };
    let path = path.trim_end_matches(".rs").trim_end_matches("/mod").trim_end_matches("/main");
    let mut modules = vec![path.replace('/', "::")];
    let (mut found, mut is_test) = (Vec::new(), false);
    for line in text.lines() {
        let inside = line.trim_start();
        if inside == "}" {
            modules.truncate((line.len() - inside.len()) / 4 + 1);
        }
        is_test |= inside == "#[test]" || inside.starts_with("#[rstest");
        let code = inside.strip_prefix("pub(").and_then(|rest| rest.split_once(") "));
        let code = code.map_or(inside, |(_, code)| code);
        let name = |rest: &str| words(rest).next().map(str::to_owned);
        if let Some(rest) = code.strip_prefix("mod ").filter(|rest| rest.ends_with('{')) {
            modules.extend(name(rest));
        } else if let Some(name) = code.strip_prefix("fn ").and_then(name)
            && std::mem::take(&mut is_test)
        {
            found.push(format!("{}::{name}", modules.join("::")));
        }
    }
    found
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}

/// References in a document that do not exist in the repository.
pub(crate) fn stale(document: &Document, all: &[Document], has: &Repository) -> Vec<Breach> {
    let mut breaches = Vec::new();
    let mut note = |line, what| {
        breaches.push(Breach { file: document.file.clone(), line, what });
    };
    for Span { line, text } in document.links() {
        if !leads(&document.file, &text, all, has) {
            note(line, format!("links to `{text}`, which is not there"));
        }
    }
    for Span { line, text } in document.code_spans() {
        for what in unknown(&document.file, &text, has) {
            note(line, what);
        }
    }
    for block in &document.blocks {
        for (line, what) in unknown_in(block, has) {
            note(line, what);
        }
    }
    breaches
}

/// Whether a link resolves to a file and, after a `#`, to one of its headings.
fn leads(from: &str, link: &str, all: &[Document], has: &Repository) -> bool {
    if link.starts_with("https://") || link.starts_with("http://") {
        return true;
    }
    let (path, heading) = link.split_once('#').unwrap_or((link, ""));
    let file = if path.is_empty() { Some(from.to_owned()) } else { join(from, path) };
    let Some(file) = file.filter(|file| has.has(file)) else { return false };
    let document = all.iter().find(|document| document.file == file);
    heading.is_empty() || document.is_some_and(|d| d.headings().any(|known| known == heading))
}

/// Errors in a span of code in a line of text.
fn unknown(from: &str, text: &str, has: &Repository) -> Vec<String> {
    if text.starts_with("cargo ") || text.starts_with("bash ") || text.starts_with("ci/") {
        return command(text, has).into_iter().collect();
    }
    if let Some((target, name)) = text.strip_prefix("--test ").and_then(|text| text.split_once(' '))
    {
        return unknown_test(target, name, has).into_iter().collect();
    }
    let plain = |c: char| c.is_alphanumeric() || "_-./*{},:".contains(c);
    if !text.chars().all(plain) || text.contains("::{") {
        return Vec::new();
    }
    if text.contains("::") {
        let ours = has.is_part(text.split("::").next().unwrap_or_default());
        let lost = ours && !has.resolves(text.trim_end_matches("::*"));
        return lost.then(|| format!("names `{text}`, which is not in src/")).into_iter().collect();
    }
    let paths = alternatives(text);
    let is_file = |path: &str| matches!(path.rsplit_once('.'), Some((_, "rs" | "md")));
    let lost = paths.iter().filter(|path| {
        if path.contains('/') {
            has.is_ours(path) && !has.finds(path, from)
        } else {
            is_file(path) && !has.has_name(path)
        }
    });
    let mut lost: Vec<String> =
        lost.map(|path| format!("names `{path}`, which is not there")).collect();
    if is_type_name(text) && !has.words.contains(text) {
        lost.push(format!("names the type `{text}`, which the crate does not have"));
    }
    lost
}

/// Returns the error if `target` has no test `name`. The name may end in a case of the test.
fn unknown_test(target: &str, name: &str, has: &Repository) -> Option<String> {
    let path = format!("{target}::{name}");
    let ends = path.match_indices("::").map(|(end, _)| end).chain([path.len()]);
    let known = ends.into_iter().any(|end| has.tests.contains(&path[..end]));
    (!known).then(|| format!("names the test `{name}` of `{target}`, which is not there"))
}

/// `Subject`, `P2gRequest`: a capital, then small letters.
fn is_type_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_uppercase())
        && text.chars().any(|c| c.is_ascii_lowercase())
        && text.chars().all(|c| c.is_ascii_alphanumeric())
        && text.len() > 3
}

/// `a/{b,c}.rs` is `a/b.rs` and `a/c.rs`.
fn alternatives(text: &str) -> Vec<String> {
    let Some((start, (inside, end))) =
        text.split_once('{').and_then(|(start, rest)| Some((start, rest.split_once('}')?)))
    else {
        return vec![text.to_owned()];
    };
    inside.split(',').map(|one| format!("{start}{}{end}", one.trim())).collect()
}

/// Complaints about a fenced block, each with its line.
fn unknown_in(block: &Block, has: &Repository) -> Vec<(usize, String)> {
    let lines = block.text.lines().enumerate().map(|(at, line)| (block.line + 1 + at, line));
    match block.language.as_str() {
        "sh" | "bash" | "console" => {
            lines.filter_map(|(at, line)| Some((at, command(line, has)?))).collect()
        }
        "text" => lines
            .flat_map(|(at, line)| {
                let words = line.split_whitespace().map(|word| word.trim_end_matches(','));
                let paths =
                    words.filter(|word| word.starts_with("src/") || word.starts_with("crates/"));
                let paths = paths.flat_map(alternatives).filter(|path| !has.has(path));
                let names = line.split_whitespace().filter(|word| {
                    word.contains("::") && has.is_part(word.split("::").next().unwrap_or_default())
                });
                let names = names.filter(|name| !has.resolves(name)).map(str::to_owned);
                let lost = paths.chain(names).map(move |name| {
                    (at, format!("names `{name}`, which is not in the repository"))
                });
                lost.collect::<Vec<_>>()
            })
            .collect(),
        "json" => json(&block.text, has).map(|what| (block.line, what)).into_iter().collect(),
        _ => Vec::new(),
    }
}

/// A JSON example must parse, with keys that reports write.
fn json(text: &str, has: &Repository) -> Option<String> {
    let value: serde_json::Value = match serde_json::from_str(text) {
        Ok(value) => value,
        Err(error) => return Some(format!("is no JSON: {error}")),
    };
    let mut keys = Vec::new();
    keys_of(&value, &mut keys);
    let key = keys.into_iter().find(|key| !has.keys.contains(key))?;
    Some(format!("has the key `{key}`, which no report writes"))
}

fn keys_of(value: &serde_json::Value, keys: &mut Vec<String>) {
    match value {
        serde_json::Value::Array(list) => list.iter().for_each(|value| keys_of(value, keys)),
        serde_json::Value::Object(map) => map.iter().for_each(|(key, value)| {
            keys.push(key.clone());
            keys_of(value, keys);
        }),
        _ => {}
    }
}

/// The error in a command that names a script, a target or a subcommand that does not exist.
fn command(line: &str, has: &Repository) -> Option<String> {
    let line = line.split(" #").next().unwrap_or_default().trim();
    let words: Vec<&str> = line.split_whitespace().skip_while(|word| is_variable(word)).collect();
    match *words.first()? {
        "bash" | "sh" => script(words.get(1)?, has),
        "cargo" => cargo(&words[1..], has),
        name if name.starts_with("ci/") => script(name, has),
        _ => None,
    }
}

/// `MPM_BENCH=full` before a command.
fn is_variable(word: &str) -> bool {
    word.split_once('=').is_some_and(|(name, _)| {
        !name.is_empty() && name.bytes().all(|b| b.is_ascii_uppercase() || b == b'_')
    })
}

fn script(path: &str, has: &Repository) -> Option<String> {
    let there = has.files.contains(path);
    (!there).then(|| format!("runs `{path}`, which is not there"))
}

/// Subcommands of cargo and of its plug-ins that documents may name.
const CARGO: &str = "run test bench build check doc fmt clippy install insta fuzz publish add";

/// Flags of `cargo run`, `test`, `bench` and `check` that documents may name.
const CARGO_FLAGS: &str = "--release --lib --bench --example --test --locked --all-targets --all \
    --no-deps --document-private-items --fuzz-dir --no-run --features --no-default-features --quiet --dev --path";

fn cargo(words: &[&str], has: &Repository) -> Option<String> {
    let words: Vec<&str> = words.iter().copied().filter(|word| !word.starts_with('+')).collect();
    let (subcommand, rest) = words.split_first()?;
    if !CARGO.split_whitespace().any(|known| known == *subcommand) {
        return Some(format!("`cargo {subcommand}` is no command that is known here"));
    }
    let ours = rest.iter().position(|word| *word == "--").map_or(rest, |end| &rest[..end]);
    let flag = ours.iter().find(|word| {
        word.starts_with("--") && !CARGO_FLAGS.split_whitespace().any(|known| known == **word)
    });
    if let Some(flag) = flag {
        return Some(format!("`cargo {subcommand} {flag}` is no flag that is known here"));
    }
    let named = |kind: &str| {
        let at = ours.iter().position(|word| *word == format!("--{kind}"))?;
        Some(ours.get(at + 1).copied().unwrap_or_default())
    };
    ["bench", "test"].into_iter().find_map(|kind| {
        let name = named(kind)?;
        let folder = if kind == "bench" { "benches" } else { "tests" };
        let declared = has.manifest.contains(&format!("[[{kind}]]\nname = \"{name}\""));
        let found =
            has.has(&format!("{folder}/{name}.rs")) || has.has(&format!("{folder}/{name}/main.rs"));
        (!declared && !found).then(|| format!("there is no {kind} `{name}`"))
    })
}

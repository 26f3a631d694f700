//! The pages of the grammar, docs/grammar, have a row for each key. Its last cell quotes a suite.

use super::grammar::Node;
use serde_yaml::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Returns the path of a key below another key.
fn joined(key: &str, name: &str) -> String {
    if key.is_empty() { name.to_owned() } else { format!("{key}.{name}") }
}

/// Returns the path of a key that several kinds of study, or several bodies, share.
fn shared(study: &str, key: &str) -> String {
    let key = key.replace("scene.bodies.", "scene.");
    let first = key.split('.').next().unwrap_or(&key);
    // A gradient study has the problem and the levels of a convergence study.
    let is_of_convergence =
        study == "gradient" && ["exact", "equilibrium", "run", "refine"].contains(&first);
    let is_of_all = is_of_convergence || ["scene", "methods", "study"].contains(&first);
    if study == "convergence" || is_of_all || key.starts_with(study) {
        return key;
    }
    format!("{study}.{key}")
}

/// Keys of any suite at the top of the file; the pages describe them for one kind of study only.
const OF_ALL: [&str; 6] = ["suite", "title", "source", "about", "parameters", "functions"];

/// Maximum number of characters of a quotation.
const LONGEST: usize = 70;

/// The allowed names of each key, and whether it is required (both values if this depends on the
/// context).
pub(super) type Keys<'a> = BTreeMap<String, (BTreeSet<&'a str>, BTreeSet<bool>)>;

/// Quotations by key: the text and the file.
pub(super) type Quotations = BTreeMap<String, (String, String)>;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Returns the name of a key on the pages.
fn key_of(study: &str, path: &str) -> String {
    let is_of_all = OF_ALL.contains(&path.split('.').next().unwrap_or(path));
    if is_of_all { path.to_owned() } else { shared(study, path) }
}

/// Lists every key of the grammar.
pub(super) fn keys<'a>(grammars: &'a [(&str, Node)]) -> Keys<'a> {
    let mut keys = Keys::new();
    for (study, node) in grammars {
        add(study, "", node, &mut keys);
    }
    keys
}

fn add<'a>(study: &str, path: &str, node: &'a Node, keys: &mut Keys<'a>) {
    if !path.is_empty() {
        let (names, required) = keys.entry(key_of(study, path)).or_default();
        names.extend(node.names.iter().map(String::as_str));
        required.extend(&node.required);
    }
    for (key, below) in &node.keys {
        add(study, &joined(path, key), below, keys);
    }
    for below in node.named.iter().chain(&node.member) {
        add(study, path, below, keys);
    }
}

/// Returns suites with their files: those of the repository, and those on pages.
fn suites() -> Vec<(String, Value)> {
    let files = mpm_verify::suite::yaml::Source::files_in(&root().join("verification"));
    let read = |file: PathBuf| {
        let text = std::fs::read_to_string(&file).expect("a suite");
        (file, text)
    };
    let mut texts: Vec<(PathBuf, String)> = files.expect("suites").into_iter().map(read).collect();
    for (page, text) in pages() {
        let blocks = text.split("```yaml\n").skip(1).filter(|block| block.starts_with("suite:"));
        let shown = blocks.map(|block| block.split("```").next().unwrap_or_default().to_owned());
        texts.extend(shown.map(|text| (page.clone(), text)));
    }
    let parsed = texts.into_iter().map(|(file, text)| {
        let file = file.strip_prefix(root()).expect("a path in here").display().to_string();
        (file, serde_yaml::from_str(&text).expect("YAML"))
    });
    parsed.collect()
}

/// Returns the shortest value of each key in a suite: a list or a map, or else a number or a name.
pub(super) fn quotations(grammars: &[(&str, Node)]) -> Quotations {
    let mut found = Quotations::new();
    for (file, suite) in suites() {
        let study = suite["study"].as_str().unwrap_or("convergence");
        let (_, node) = grammars.iter().find(|(name, _)| *name == study).expect("a study");
        quote(node, &suite, (study, ""), &mut |key, name, value| {
            let text = format!("{name}: {}", flow(value));
            let rank = |text: &str| (!text.ends_with([']', '}']), text.len());
            let known = found.get(&key);
            if known.is_none_or(|(best, _)| rank(&text) < rank(best)) {
                found.insert(key, (text, file.clone()));
            }
        });
    }
    found
}

fn quote(
    node: &Node,
    value: &Value,
    (study, path): (&str, &str),
    found: &mut dyn FnMut(String, &str, &Value),
) {
    match value {
        Value::Mapping(map) => {
            for (name, value) in map {
                let text = name.as_str().unwrap_or_default();
                // The entry for full runs has the same keys as the entry itself.
                let known = node.keys.get(text).filter(|_| text != "full");
                let is_invented = known.is_none() && node.named.is_some();
                let at = if is_invented { path.to_owned() } else { joined(path, text) };
                found(key_of(study, &at), text, value);
                let (below, at) = match (known, &node.named) {
                    (Some(below), _) => (below, at.as_str()),
                    (None, Some(below)) => (below.as_ref(), at.as_str()),
                    (None, None) => (node, path),
                };
                quote(below, value, (study, at), found);
            }
        }
        Value::Sequence(list) => {
            let below = node.member.as_deref().unwrap_or(node);
            for value in list {
                quote(below, value, (study, path), found);
            }
        }
        _ => {}
    }
}

/// Formats YAML on one line.
fn flow(value: &Value) -> String {
    let parts = |parts: Vec<String>, (open, close)| format!("{open}{}{close}", parts.join(", "));
    match value {
        Value::Sequence(list) => parts(list.iter().map(flow).collect(), ('[', ']')),
        Value::Mapping(map) => {
            let entry = |(key, value): (&Value, &Value)| format!("{}: {}", flow(key), flow(value));
            parts(map.iter().map(entry).collect(), ('{', '}'))
        }
        Value::String(text) if text.chars().any(|c| "*,:{}[]#&!|>'\"%@`".contains(c)) => {
            format!("\"{}\"", text.trim())
        }
        plain => serde_yaml::to_string(plain).expect("YAML").trim().to_owned(),
    }
}

/// Returns the pages with their texts.
pub(super) fn pages() -> Vec<(PathBuf, String)> {
    let folder = root().join("docs/grammar");
    let entries = std::fs::read_dir(folder).expect("pages");
    let mut pages: Vec<PathBuf> = entries.map(|entry| entry.expect("a page").path()).collect();
    pages.sort();
    let read = |path: PathBuf| {
        let text = std::fs::read_to_string(&path).expect("a page");
        (path, text)
    };
    pages.into_iter().map(read).collect()
}

/// Returns key and row of a line that describes a key.
fn row(line: &str) -> Option<(&str, &str)> {
    let (key, rest) = line.strip_prefix("| `")?.split_once("` | ")?;
    (rest.matches(" | ").count() >= 2 && rest.ends_with('|')).then_some((key, rest))
}

/// Returns the rows of all pages, by key.
pub(super) fn rows(pages: &[(PathBuf, String)]) -> BTreeMap<&str, Vec<&str>> {
    let mut rows: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    let lines = pages.iter().flat_map(|(_, text)| text.lines());
    lines.filter_map(row).for_each(|(key, rest)| rows.entry(key).or_default().push(rest));
    rows
}

/// Replaces the last cell of each row in the page.
pub(super) fn with_quotations(page: &str, found: &Quotations) -> String {
    let renew = |line: &str| {
        let Some((key, _)) = row(line) else { return line.to_owned() };
        let (before, _) = line.trim_end_matches('|').rsplit_once('|').expect("cells");
        let cell = found.get(key).map_or("in no suite".to_owned(), |(text, file)| {
            let name = Path::new(file).file_stem().unwrap_or_default().to_string_lossy();
            let link = format!("[{name}](../../{file})");
            let is_short = text.chars().count() <= LONGEST && !text.contains(['`', '\n']);
            if is_short { format!("`{}`, {link}", text.replace('|', "\\|")) } else { link }
        });
        format!("{before}| {cell} |")
    };
    page.lines().map(|line| renew(line) + "\n").collect()
}

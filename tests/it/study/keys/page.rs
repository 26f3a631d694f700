//! Reads and writes the tables of docs/keys.md.

use super::leaf::Change;
use super::reasons::reason;
use super::search::{Found, Row};
use std::collections::BTreeMap;
use std::path::PathBuf;

const BEGIN: &str = "<!-- written by ci/keys -->\n";
const END: &str = "<!-- end -->";

/// Maximum predicted time (s) of a suite in the sample, and the stride of the sample.
const QUICK: f64 = 0.015;
const EVERY: usize = 4;

/// A row of the table of numbers.
pub(super) struct Line {
    /// Number of suites that use the key.
    suites: usize,
    /// Smallest change that a gate notices; empty if no change is noticed.
    pub(super) least: String,
    gate: String,
    /// Suite and case of the gate.
    place: String,
    seconds: String,
    /// Reason in the table why a change of 1 % is not noticed.
    pub(super) reason: String,
}

/// Allowed names of a key, each with the number of suites and the reason in the table.
pub(super) type Names = BTreeMap<(String, String), (usize, String)>;

/// A row of the sample.
pub(super) struct Sampled {
    pub(super) key: String,
    pub(super) suite: String,
    pub(super) least: Change,
}

fn file() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("docs/keys.md")
}

/// Returns the cells of the rows in the tables, without the headings.
fn rows<const N: usize>() -> Vec<[String; N]> {
    let text = std::fs::read_to_string(file()).expect("docs/keys.md");
    let table = text.split_once(BEGIN).and_then(|(_, rest)| rest.split_once(END));
    let lines = table.expect("a table").0.lines().filter(|line| line.starts_with("| `"));
    let cells = lines.map(|line| {
        let inside = line.strip_prefix('|').and_then(|line| line.strip_suffix('|'));
        inside.expect("a row").split('|').map(|cell| cell.trim().to_owned()).collect()
    });
    cells.filter_map(|cells: Vec<String>| cells.try_into().ok()).collect()
}

/// Returns the text before the first `sign`, and the text between the first two.
fn within(text: &str, sign: char) -> (&str, &str) {
    let (before, rest) = text.split_once(sign).unwrap_or((text, ""));
    (before, rest.split(sign).next().unwrap_or_default())
}

/// Returns the rows of numbers, by key.
pub(super) fn numbers() -> BTreeMap<String, Line> {
    let line = |[key, suites, least, said, place, seconds]: [String; 6]| {
        let (gate, reason) = within(&said, '*');
        let (gate, reason) = (gate.trim_end_matches("; ").to_owned(), reason.to_owned());
        let suites = suites.parse().expect("a number of suites");
        (key.replace('`', ""), Line { suites, least, gate, place, seconds, reason })
    };
    rows().into_iter().map(line).collect()
}

/// Returns the rows of names.
pub(super) fn names() -> Names {
    let of_row = |[key, names]: [String; 2]| -> Vec<_> {
        let parts: Vec<&str> = names.split('`').skip(1).collect();
        let word = |pair: &[&str]| {
            let (count, reason) = within(pair[1], '*');
            let count = count.split([',', '(']).next().unwrap_or_default().trim();
            let found = (count.parse().expect("a number of suites"), reason.to_owned());
            ((key.replace('`', ""), pair[0].to_owned()), found)
        };
        parts.chunks_exact(2).map(word).collect()
    };
    rows().into_iter().flat_map(of_row).collect()
}

/// Returns a sample of the numbers whose changes a quick suite notices.
pub(super) fn sample() -> Vec<Sampled> {
    let known = [1.01, 1.001, 1.0001].map(Change::Times).map(|change| (change.shown(), change));
    let quick = numbers().into_iter().filter_map(|(key, line)| {
        let (_, least) = known.iter().find(|(text, _)| *text == line.least)?;
        let suite = within(&line.place, '`').1.to_owned();
        let is_quick = line.seconds.parse::<f64>().ok()? <= QUICK;
        (is_quick && line.gate != "load").then_some(Sampled { key, suite, least: *least })
    });
    quick.skip(EVERY / 2).step_by(EVERY).collect()
}

impl Row {
    fn line(&self) -> Line {
        let Self { suites, .. } = *self;
        let none = || Line {
            suites,
            least: String::new(),
            gate: String::new(),
            place: String::new(),
            seconds: String::new(),
            reason: String::new(),
        };
        self.seen.as_ref().map_or_else(none, |seen| {
            let case = seen.case.as_ref().map_or_else(String::new, |case| format!(", `{case}`"));
            Line {
                least: seen.least.shown(),
                gate: seen.gate.clone(),
                place: format!("`{}`{case}", seen.suite),
                seconds: format!("{:.3}", seen.seconds),
                ..none()
            }
        })
    }

    /// Formats the row of the table.
    pub(super) fn shown(&self) -> String {
        self.line().shown(&self.key)
    }
}

impl Line {
    fn shown(&self, key: &str) -> String {
        let Self { suites, least, gate, place, seconds, .. } = self;
        let said = reason(key).map_or_else(String::new, |reason| format!("*{reason}*"));
        let both = if gate.is_empty() || said.is_empty() { "" } else { "; " };
        format!("| `{key}` | {suites} | {least} | {gate}{both}{said} | {place} | {seconds} |")
    }
}

/// Writes the tables. Rows of keys that were not tested do not change.
pub(super) fn write(found: &Found) {
    let mut lines = numbers();
    lines.retain(|key, _| found.keys.contains(key));
    lines.extend(found.rows.iter().map(|row| (row.key.clone(), row.line())));
    let noticed = lines.values().filter(|line| !line.least.is_empty()).count();
    let mut text = vec![
        format!("{} numbers; a change of {noticed} of them is noticed.", lines.len()),
        String::new(),
        "| key | suites | least change | gate that notices | suite, case | s |".to_owned(),
        "|---|--:|--:|---|---|--:|".to_owned(),
    ];
    text.extend(lines.iter().map(|(key, line)| line.shown(key)));
    let unused = found.names.values().filter(|suites| **suites == 0).count();
    text.push(format!("\n{} names; {unused} of them are in no suite.\n", found.names.len()));
    text.push("| key | names, with the number of suites |\n|---|---|".to_owned());
    let mut by_key: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for ((key, name), suites) in &found.names {
        let said = reason(&format!("{key}: {name}"));
        let said = said.map_or_else(String::new, |reason| format!(" (*{reason}*)"));
        by_key.entry(key).or_default().push(format!("`{name}` {suites}{said}"));
    }
    text.extend(by_key.iter().map(|(key, names)| format!("| `{key}` | {} |", names.join(", "))));
    let page = std::fs::read_to_string(file()).expect("docs/keys.md");
    let (head, rest) = page.split_once(BEGIN).expect("the begin of the tables");
    let (_, tail) = rest.split_once(END).expect("the end of the tables");
    let page = format!("{head}{BEGIN}{}\n{END}{tail}", text.join("\n"));
    std::fs::write(file(), page).expect("docs/keys.md is writable");
}

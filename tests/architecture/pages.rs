//! Tables of documents that are generated from the suites: written by `ci/pages`, checked by a
//! test.
//!
//! A table is between `<!-- suites of FOLDER -->` and `<!-- end -->`. Quotations of reports must be
//! in a snapshot.

use crate::markdown::Document;
use crate::source::texts;
use serde_yaml::Value;
use std::collections::BTreeMap;

/// Page of the tables of suites.
pub(crate) const SUITES: &str = "docs/suites.md";

const END: &str = "<!-- end -->";

/// A suite, as far as tables tell.
#[derive(Debug)]
pub(crate) struct Row {
    pub(crate) folder: String,
    pub(crate) name: String,
    cells: String,
}

/// Every suite below `verification/`.
pub(crate) fn suites() -> Vec<Row> {
    texts("verification", ".yaml").iter().map(|(file, text)| row(file, text)).collect()
}

fn row(file: &str, text: &str) -> Row {
    let suite: Value = serde_yaml::from_str(text).unwrap_or_else(|what| panic!("{file}: {what}"));
    let folder = file.split('/').nth(1).expect("a folder").to_owned();
    let word = |key: &str| suite[key].as_str().unwrap_or_default().to_owned();
    let (name, study) = (word("suite"), word("study").replace('_', " "));
    let study = if study.is_empty() { refined(&suite).to_owned() } else { study };
    let dimension = suite["scene"]["dimension"].as_u64().unwrap_or(1);
    let methods = methods(&suite["methods"]);
    let (title, link) = (word("title").replace('|', "\\|"), format!("../{file}"));
    let cells = format!("| [`{name}`]({link}) | {title} | {study} | {dimension} | {methods} |");
    Row { folder, name, cells }
}

/// The kind of a convergence study, by its refined keys.
fn refined(suite: &Value) -> &'static str {
    let is_list = |key: &str| suite["refine"][key].is_sequence();
    match (is_list("cells"), is_list("dt"), is_list("ppc")) {
        (true, true, _) => "order in space and time",
        (true, ..) => "order in space",
        (_, true, _) => "order in time",
        (_, _, true) => "order in particles",
        _ => "one grid",
    }
}

/// The names under each key of all entries: `mpm: linear, cpdi; flip; musl, usl`.
fn methods(list: &Value) -> String {
    let mut solvers: BTreeMap<String, BTreeMap<usize, Vec<String>>> = BTreeMap::new();
    let entries = list.as_sequence().into_iter().flatten().filter_map(Value::as_mapping);
    for (solver, settings) in entries.flatten() {
        let keys = solvers.entry(words(solver).concat()).or_default();
        for (at, key) in ["basis", "element", "transfer", "scheme"].iter().enumerate() {
            for name in words(&settings[key]) {
                let names = keys.entry(at).or_default();
                if !names.contains(&name) {
                    names.push(name);
                }
            }
        }
    }
    let settings = |keys: BTreeMap<usize, Vec<String>>| {
        keys.into_values().map(|names| names.join(", ")).collect::<Vec<_>>().join("; ")
    };
    let told = solvers.into_iter().map(|(solver, keys)| format!("{solver}: {}", settings(keys)));
    told.collect::<Vec<_>>().join(" / ")
}

/// A name, the names of a list, or `xpic 8` for a name with a number.
fn words(value: &Value) -> Vec<String> {
    match value {
        Value::String(word) => vec![word.clone()],
        Value::Sequence(list) => list.iter().flat_map(words).collect(),
        Value::Mapping(map) => {
            let pair = |(name, number): (&Value, &Value)| {
                format!("{} {}", words(name).concat(), number.as_u64().unwrap_or_default())
            };
            map.iter().map(pair).collect()
        }
        _ => Vec::new(),
    }
}

/// The page with regenerated tables, and the folders without a table in the page.
pub(crate) fn with_tables(page: &str, suites: &[Row]) -> (String, Vec<String>) {
    let mut folders: BTreeMap<&str, String> = BTreeMap::new();
    for row in suites {
        let table = folders.entry(&row.folder).or_insert_with(|| {
            "\n| suite | title | study | D | methods |\n|---|---|---|--:|---|\n".to_owned()
        });
        *table += &format!("{}\n", row.cells);
    }
    let (mut page, mut missing) = (page.to_owned(), Vec::new());
    for (folder, table) in folders {
        let begin = format!("<!-- suites of {folder} -->\n");
        let parts = page.split_once(&begin).and_then(|(before, rest)| {
            let (_, after) = rest.split_once(END)?;
            Some(format!("{before}{begin}{table}\n{END}{after}"))
        });
        match parts {
            Some(text) => page = text,
            None => missing.push(folder.to_owned()),
        }
    }
    (page, missing)
}

/// Pages that quote reports, in blocks of text that are indented as reports are.
pub(crate) const QUOTING: [&str; 1] = ["docs/judge.md"];

/// Lines of wrong quotations in a page. The lines of a correct quotation are in one snapshot, in
/// this order.
pub(crate) fn misquoted(page: &Document) -> (usize, Vec<usize>) {
    let snapshots = texts("verification", ".snap");
    let is_of = |quoted: &str, (_, report): &(String, String)| {
        let mut lines = report.lines();
        quoted.lines().all(|wanted| wanted.is_empty() || lines.any(|line| line == wanted))
    };
    let quoting = page.blocks.iter().filter(|b| b.language == "text" && b.text.starts_with("  "));
    let quoting: Vec<_> = quoting.collect();
    let wrong = quoting.iter().filter(|block| !snapshots.iter().any(|s| is_of(&block.text, s)));
    (quoting.len(), wrong.map(|block| block.line).collect())
}

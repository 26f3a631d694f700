//! The tables of docs/methods.md show in which folders of suites each method converges.

use super::with_table;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::Source;
use mpm_verify::verify::Verdict;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

const PAGE: &str = "docs/methods.md";

/// Parts of a method. Each has a table with one column for each name.
const PARTS: [&str; 2] = ["basis", "transfer"];

/// Minimum number of bases for which a suite has its own row.
const FEWEST: usize = 3;

/// A case with an expected verdict.
struct Asked {
    folder: String,
    suite: String,
    settings: Vec<(String, String)>,
    converges: bool,
    /// Expected order or expected verdict.
    outcome: String,
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn asked() -> Vec<Asked> {
    let files = Source::files_in(&root().join("verification")).expect("suites");
    let of_file = |file: &std::path::PathBuf| -> Vec<Asked> {
        let source = Source::read(file).expect("a readable suite").trusted();
        let suite = Suite::load(&source).unwrap_or_else(|found| panic!("{found}"));
        let cases = suite.convergence().map(|plan| plan.cases.as_slice());
        let asked = cases.unwrap_or_default().iter().filter_map(|case| {
            let expectation = case.expectation.as_ref()?;
            let verdict = expectation.verdict?;
            let converges = verdict == Verdict::Converging;
            let middle = |(low, high): (f64, f64)| format!("{:.1}", 0.5 * (low + high));
            let order = expectation.order.filter(|_| converges).map(middle);
            let outcome = order.unwrap_or_else(|| verdict.name().to_owned());
            let (folder, suite) = (suite.group.clone(), suite.name.clone());
            let settings = case.method.settings();
            Some(Asked { folder, suite, settings, converges, outcome })
        });
        asked.collect()
    };
    files.par_iter().flat_map_iter(of_file).collect()
}

/// Returns the name of a part of the method.
fn part_of<'a>(case: &'a Asked, part: &str) -> Option<&'a str> {
    let setting = case.settings.iter().find(|(key, _)| key == part);
    setting.map(|(_, name)| name.as_str())
}

/// Creates the heading of a table with a column for each name.
fn head(first: &str, names: &BTreeSet<&str>) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    format!("\n| {first} | {} |\n|---|{}\n", names.join(" | "), "---|".repeat(names.len()))
}

/// Creates the table of the expectations of suites with several bases, in the order of folders.
fn outcomes(asked: &[Asked]) -> String {
    let mut cells: BTreeMap<(&str, &str), BTreeMap<&str, BTreeSet<&str>>> = BTreeMap::new();
    for case in asked {
        let Some(basis) = part_of(case, "basis") else { continue };
        let row = cells.entry((&case.folder, &case.suite)).or_default();
        row.entry(basis).or_default().insert(&case.outcome);
    }
    let bases: BTreeSet<&str> = cells.values().flat_map(|row| row.keys().copied()).collect();
    let mut table = head("suite", &bases);
    for ((folder, suite), row) in cells.iter().filter(|(_, row)| row.len() >= FEWEST) {
        let cell = |basis: &&str| {
            let told = row.get(basis).map(|all| all.iter().copied().collect::<Vec<_>>());
            told.map_or(" |".to_owned(), |all| format!(" {} |", all.join(", ")))
        };
        let cells: String = bases.iter().map(cell).collect();
        table += &format!("| [{suite}](../verification/{folder}/{suite}.snap) |{cells}\n");
    }
    table
}

/// Creates a table with the numbers of converging and of all cases, by folder and name of a part.
fn table(part: &str, asked: &[Asked]) -> String {
    let mut counts: BTreeMap<(&str, &str), (usize, usize)> = BTreeMap::new();
    for case in asked {
        let Some(name) = part_of(case, part) else { continue };
        let (some, all) = counts.entry((&case.folder, name)).or_default();
        *some += usize::from(case.converges);
        *all += 1;
    }
    let names: BTreeSet<&str> = counts.keys().map(|(_, name)| *name).collect();
    let folders: BTreeSet<&str> = counts.keys().map(|(folder, _)| *folder).collect();
    let mut table = head("suites", &names);
    for folder in folders {
        let cell = |name: &&str| {
            let count = counts.get(&(folder, name));
            count.map_or(" |".to_owned(), |(some, all)| format!(" {some} of {all} |"))
        };
        let cells: String = names.iter().map(cell).collect();
        table += &format!("| [{folder}](../verification/{folder}/README.md) |{cells}\n");
    }
    table
}

/// Returns the current page and the generated page.
fn page() -> (String, String) {
    let (page, asked) = (std::fs::read_to_string(root().join(PAGE)).expect(PAGE), asked());
    let anew = PARTS
        .iter()
        .fold(with_table(&page, "methods by suite", &outcomes(&asked)), |page, part| {
            with_table(&page, &format!("methods by {part}"), &table(part, &asked))
        });
    (page, anew)
}

#[test]
fn page_of_methods_is_up_to_date() {
    let (page, anew) = page();
    assert!(page == anew, "{PAGE} is stale: run ci/pages");
}

#[test]
#[ignore = "ci/pages runs it"]
fn the_page_of_methods_is_written() {
    std::fs::write(root().join(PAGE), page().1).expect("a page is written");
}

//! The tables of docs/methods.md: in which folders of suites which method converges.

use mpm_verify::suite::yaml::Source;
use mpm_verify::suite::{ConvergencePlan, Suite};
use mpm_verify::verify::Verdict;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

const PAGE: &str = "docs/methods.md";

/// Parts of a method that a table has a column for each name of.
const PARTS: [&str; 2] = ["basis", "transfer"];

/// A case that is asked for a verdict.
struct Asked {
    folder: String,
    settings: Vec<(String, String)>,
    converges: bool,
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn asked() -> Vec<Asked> {
    let files = Source::files_in(&root().join("verification")).expect("suites");
    let of_file = |file: &std::path::PathBuf| -> Vec<Asked> {
        let source = Source::read(file).expect("a readable suite");
        let suite = Suite::load(&source).unwrap_or_else(|found| panic!("{found}"));
        let cases = suite.plan::<ConvergencePlan>().map(|plan| plan.cases.as_slice());
        let asked = cases.unwrap_or_default().iter().filter_map(|case| {
            let verdict = case.expectation.as_ref()?.verdict?;
            let (folder, settings) = (suite.group.clone(), case.method.settings());
            Some(Asked { folder, settings, converges: verdict == Verdict::Converging })
        });
        asked.collect()
    };
    files.par_iter().flat_map_iter(of_file).collect()
}

/// Cases that converge and all, by folder and name of a part.
fn table(part: &str, asked: &[Asked]) -> String {
    let mut counts: BTreeMap<(&str, &str), (usize, usize)> = BTreeMap::new();
    for case in asked {
        let name = case.settings.iter().find(|(key, _)| key == part);
        let Some((_, name)) = name else { continue };
        let (some, all) = counts.entry((&case.folder, name)).or_default();
        *some += usize::from(case.converges);
        *all += 1;
    }
    let names: BTreeSet<&str> = counts.keys().map(|(_, name)| *name).collect();
    let folders: BTreeSet<&str> = counts.keys().map(|(folder, _)| *folder).collect();
    let heads: String = names.iter().map(|name| format!(" `{name}` |")).collect();
    let mut table = format!("\n| suites |{heads}\n|---|{}\n", "---|".repeat(names.len()));
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

/// The page as it is, and as it should be.
fn page() -> (String, String) {
    let (page, asked) = (std::fs::read_to_string(root().join(PAGE)).expect(PAGE), asked());
    let anew = PARTS.iter().fold(page.clone(), |page, part| {
        let begin = format!("<!-- methods by {part} -->\n");
        let (before, rest) = page.split_once(&begin).expect("a place for the table");
        let (_, after) = rest.split_once("<!-- end -->").expect("its end");
        format!("{before}{begin}{}\n<!-- end -->{after}", table(part, &asked))
    });
    (page, anew)
}

#[test]
fn the_page_of_methods_is_that_of_the_suites() {
    let (page, anew) = page();
    assert!(page == anew, "{PAGE} is stale: run ci/pages");
}

#[test]
#[ignore = "ci/pages runs it"]
fn the_page_of_methods_is_written() {
    std::fs::write(root().join(PAGE), page().1).expect("a page is written");
}

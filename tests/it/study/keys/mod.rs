//! Every key and name of the grammar must be checked by a gate (docs/keys.md).

#[path = "../../../defects/gate.rs"]
mod gate;
mod grammar;
mod leaf;
mod manual;
mod page;
mod reasons;
mod required;
mod search;
mod solver;

use grammar::{Node, STUDIES};
use leaf::shared;
use mpm_verify::suite::yaml::Source;
use rayon::prelude::*;
use solver::Known;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::LazyLock;

/// For each key of the grammar: whether it may be a number, and its allowed names.
type Keys = BTreeMap<String, (bool, Vec<String>)>;

/// Returns every key that takes a number or one of several names, for all kinds of study that run a
/// method of this crate. Keys of gradient studies are tested in `external::differentiate`.
fn keys(grammars: &[(&str, Node)]) -> Keys {
    let mut keys = Keys::new();
    for (study, grammar) in grammars.iter().filter(|(study, _)| *study != "gradient") {
        grammar.visit("", &mut |key, node| {
            let (is_number, names) = keys.entry(shared(study, key)).or_default();
            *is_number |= node.is_number;
            let with_settings = node.keys.iter().filter(|_| node.is_choice).map(|(name, _)| name);
            names.extend(node.names.iter().chain(with_settings).cloned());
            names.sort();
            names.dedup();
        });
    }
    keys
}

/// Grammar of each kind of study.
static GRAMMARS: LazyLock<Vec<(&str, Node)>> =
    LazyLock::new(|| STUDIES.map(|study| (study, Node::of_study(study))).into());

/// Returns the suites of the repository, cheap ones first.
fn suites() -> Vec<Known> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("verification");
    let files = Source::files_in(&folder).expect("suites");
    let mut suites: Vec<Known> = files.par_iter().map(|file| Known::read(file)).collect();
    suites.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    suites
}

/// Asserts that docs/keys.md and the grammar have the same keys.
fn same<T: Ord + std::fmt::Debug>(grammar: &BTreeSet<T>, page: &BTreeSet<T>) {
    let missing: Vec<&T> = grammar.difference(page).collect();
    assert!(missing.is_empty(), "not in docs/keys.md; run ci/keys: {missing:?}");
    let gone: Vec<&T> = page.difference(grammar).collect();
    assert!(gone.is_empty(), "in docs/keys.md, and no words: {gone:?}");
}

#[test]
fn every_key_and_name_has_its_row() {
    let keys = keys(&GRAMMARS);
    let (rows, names) = (page::numbers(), page::names());
    let numbers = keys.iter().filter(|(_, (is_number, _))| *is_number).map(|(key, _)| key);
    same(&numbers.collect(), &rows.keys().collect());
    let known = keys.iter().flat_map(|(key, (_, names))| names.iter().map(move |name| (key, name)));
    same(&known.collect(), &names.keys().map(|(key, name)| (key, name)).collect());
    let wrong = reasons::wrong(&rows, &names);
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn a_sample_is_still_noticed() {
    let (suites, sample) = (suites(), page::sample());
    assert!(sample.len() >= 5, "only {} rows", sample.len());
    sample.par_iter().for_each(|row| search::still_noticed(row, &GRAMMARS, &suites));
}

#[test]
#[ignore = "ci/keys runs it"]
fn every_key_is_noticed() {
    let suites = suites();
    let part = std::env::var("KEYS").unwrap_or_default();
    page::write(&search::search(&keys(&GRAMMARS), &part, &GRAMMARS, &suites));
    let wrong = reasons::wrong(&page::numbers(), &page::names());
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn every_key_has_a_row_in_the_manual() {
    let (keys, pages) = (manual::keys(&GRAMMARS), manual::pages());
    let rows = manual::rows(&pages);
    let missing: Vec<&String> =
        keys.keys().filter(|key| !rows.contains_key(key.as_str())).collect();
    assert!(missing.is_empty(), "no row in docs/grammar: {missing:?}");
    for (key, rows) in rows {
        assert_eq!(rows.len(), 1, "rows of `{key}` in docs/grammar");
        let names = keys.get(key).unwrap_or_else(|| panic!("docs/grammar: there is no `{key}`"));
        let untold = names.iter().filter(|name| !rows[0].contains(&format!("`{name}`")));
        let untold: Vec<&String> = untold.collect();
        assert!(untold.is_empty(), "docs/grammar: the row of `{key}` has not {untold:?}");
    }
}

#[test]
fn the_manual_has_every_verdict() {
    let (pages, verdicts) = (manual::pages(), mpm_verify::verify::Verdict::ALL);
    let row = manual::rows(&pages)["expect.verdict"][0];
    let spelt = verdicts.map(|verdict| format!("`{}`", verdict.name().replace([' ', '-'], "_")));
    let untold: Vec<&String> = spelt.iter().filter(|name| !row.contains(*name)).collect();
    assert!(untold.is_empty(), "docs/grammar: the row of `expect.verdict` has not {untold:?}");
}

/// A key is marked `required` if it is required wherever it is allowed. A key with a default is
/// optional somewhere.
#[test]
fn manual_lists_required_keys() {
    let (required, pages) = (required::required(), manual::pages());
    let mut held = 0;
    for (key, rows) in manual::rows(&pages) {
        let default = rows[0].split(" | ").nth(1).unwrap_or_default();
        let (Some(found), false) = (required.get(key), default.is_empty()) else { continue };
        let is_conditional = default != "required" && default.starts_with("required");
        let is_right =
            if default == "required" { !found.contains(&false) } else { found.contains(&false) };
        assert!(is_conditional || is_right, "docs/grammar: `{key}`, default {default}");
        held += 1;
    }
    assert!(held > 150, "only {held} rows are in the schema");
}

#[test]
fn the_manual_quotes_suites() {
    let found = manual::quotations(&GRAMMARS);
    for (path, page) in manual::pages() {
        let anew = manual::with_quotations(&page, &found);
        assert!(page == anew, "{} is stale: run ci/pages", path.display());
    }
}

#[test]
#[ignore = "ci/pages runs it"]
fn the_manual_is_written() {
    let found = manual::quotations(&GRAMMARS);
    for (path, page) in manual::pages() {
        std::fs::write(path, manual::with_quotations(&page, &found)).expect("a page is written");
    }
}

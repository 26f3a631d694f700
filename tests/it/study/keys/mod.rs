//! The pages in docs/grammar must list every key and name of the grammar.

mod grammar;
mod manual;
mod required;

use grammar::{Node, STUDIES};
use std::sync::LazyLock;

/// Grammar of each kind of study.
static GRAMMARS: LazyLock<Vec<(&str, Node)>> =
    LazyLock::new(|| STUDIES.map(|study| (study, Node::of_study(study))).into());

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
    let spelt =
        verdicts.iter().map(|verdict| format!("`{}`", verdict.name().replace([' ', '-'], "_")));
    let untold: Vec<String> = spelt.filter(|name| !row.contains(name)).collect();
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

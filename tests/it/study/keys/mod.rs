//! The pages in docs/grammar must list every key and name of the grammar.

mod grammar;
mod manual;

use grammar::Node;
use std::sync::LazyLock;

/// Grammar of each kind of study.
static GRAMMARS: LazyLock<Vec<(&str, Node)>> = LazyLock::new(grammar::studies);

/// A key is marked `required` if it is required wherever it is allowed. A key with a default is
/// optional somewhere.
#[test]
fn every_key_has_a_row_in_the_manual() {
    let (keys, pages) = (manual::keys(&GRAMMARS), manual::pages());
    let rows = manual::rows(&pages);
    let missing: Vec<&String> =
        keys.keys().filter(|key| !rows.contains_key(key.as_str())).collect();
    assert!(missing.is_empty(), "no row in docs/grammar: {missing:?}");
    for (key, rows) in rows {
        assert_eq!(rows.len(), 1, "rows of `{key}` in docs/grammar");
        let known = keys.get(key);
        let (names, required) =
            known.unwrap_or_else(|| panic!("docs/grammar: there is no `{key}`"));
        let untold = names.iter().filter(|name| !rows[0].contains(&format!("`{name}`")));
        let untold: Vec<&&str> = untold.collect();
        assert!(untold.is_empty(), "docs/grammar: the row of `{key}` has not {untold:?}");
        let default = rows[0].split(" | ").nth(1).unwrap_or_default();
        let is_conditional = default != "required" && default.starts_with("required");
        let is_right = required.contains(&false) != (default == "required");
        assert!(
            default.is_empty() || is_conditional || is_right,
            "docs/grammar: `{key}`, default {default}"
        );
    }
    assert!(keys.len() > 150, "only {} keys", keys.len());
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

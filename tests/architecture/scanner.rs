//! Checks that each scanner still finds a planted breach, so that no rule passes only because its
//! scanner finds nothing.

use crate::documents::{Repository, stale};
use crate::graph::{cycles, edges};
use crate::markdown::Document;
use crate::rules;
use crate::rules::{Breach, IMPORT_RULES};
use crate::source::{Source, of_files, with_tests};
use crate::words;

fn owned(files: &[(&str, &str)]) -> Vec<(String, String)> {
    files.iter().map(|(file, text)| ((*file).to_owned(), (*text).to_owned())).collect()
}

fn sources(files: &[(&str, &str)]) -> Vec<Source> {
    of_files(&owned(files))
}

fn places(breaches: &[Breach]) -> Vec<String> {
    breaches.iter().map(|breach| format!("{}:{}", breach.file, breach.line)).collect()
}

/// The import of `b` by `a` is found through a re-export, and not in strings or comments.
#[test]
fn cycle_and_forbidden_import_are_found() {
    let edges = edges(&sources(&[
        ("crates/solvers/src/mpm/mod.rs", "mod grid; pub use grid::Grid;"),
        (
            "crates/solvers/src/mpm/grid.rs",
            "// crate::suite::A\nuse crate::exact::Claim;\npub struct Grid;",
        ),
        (
            "crates/judge/src/exact/mod.rs",
            "const A: &str = \"crate::suite::A\";\nuse crate::mpm::Grid;\npub struct Claim;",
        ),
        ("crates/suites/src/suite/mod.rs", "pub struct A;"),
    ]));
    assert_eq!(cycles(&edges).iter().map(Vec::len).collect::<Vec<_>>(), [2]);
    let breaches = IMPORT_RULES.iter().flat_map(|rule| rules::forbidden_imports(rule, &edges));
    let breaches: Vec<Breach> = breaches.collect();
    assert_eq!(
        places(&breaches),
        ["crates/solvers/src/mpm/grid.rs:2", "crates/judge/src/exact/mod.rs:2"]
    );
}

#[test]
fn breaches_of_code_rules_are_found() {
    let long = "fn f() {}\n".repeat(rules::MOST_LINES + 1);
    let planted = sources(&[
        ("src/long.rs", &long),
        ("crates/solvers/src/mpm/utils.rs", "mod inner { fn f(x: f64) { x.mul_add(x.sin(), x) } }"),
        ("src/a.rs", "struct Row; fn f() { map(f64::exp) }"),
        ("src/b.rs", "#[cfg(test)]\nmod tests { use serde_yaml::Value; }\nenum Row {}"),
    ]);
    let utils = ["crates/solvers/src/mpm/utils.rs:1"];
    assert_eq!(places(&rules::long(&planted, &[])), ["src/long.rs:501"]);
    assert_eq!(places(&rules::nameless(&planted)), utils);
    assert_eq!(places(&rules::nested(&planted)), utils);
    assert_eq!(places(&rules::fused(&planted)), utils);
    assert_eq!(
        places(&rules::platform_calls(&planted)),
        ["crates/solvers/src/mpm/utils.rs:1", "src/a.rs:1"]
    );
    assert!(
        rules::mentions(&planted, &[&["serde_yaml"]], "crates/suites/src/suite/").is_empty(),
        "only tests"
    );
    assert_eq!(places(&words::twice(&planted, &[])), ["src/b.rs:3"]);
    let tests = with_tests(&owned(&[(
        "crates/solvers/src/fem/tests/time.rs",
        "fn f() { Solver::new(setup); }",
    )]));
    assert_eq!(rules::tests_with(&tests, &[&["Solver", "::", "new"]]).len(), 1);
}

#[test]
fn unclear_prose_is_found() {
    let text =
        "let a = \"of which\";\n/// an error but\n/// for rounding\n/// What a thing does.\n";
    let text = owned(&[("src/a.rs", text)]);
    assert_eq!(places(&words::unclear_phrases(&words::of_comments(&text))), ["src/a.rs:2"]);
    assert_eq!(places(&words::comments(&text)), ["src/a.rs:4"]);
}

#[test]
fn stale_names_in_documents_are_found() {
    let files = ["README.md", "docs/page.md", "crates/solvers/src/mpm/grid.rs", "ci/check"]
        .map(str::to_owned);
    let texts = owned(&[(
        "crates/solvers/src/mpm/grid.rs",
        "pub struct Grid; impl Grid { fn locate() {} }",
    )]);
    let has = Repository::new(&files, &texts, "[[bench]]\nname = \"transfer\"\n");
    for (text, count) in [
        ("see [the grid](../crates/solvers/src/mpm/gird.rs)", 1),
        ("see [it](#two)", 1),
        ("in `mpm/gird.rs`", 1),
        ("by `mpm::grid::Gird`", 1),
        ("```console\nbash ci/chekc\n```", 1),
        ("```console\ncargo bench --bench trasnfer\n```", 1),
        ("```json\n{\"verdict\": 1}}\n```", 1),
        (
            "[a](../crates/solvers/src/mpm/grid.rs) `mpm/grid.rs` `Grid::locate` `h/(c + |v|)`\n```console\nbash ci/check\n```",
            0,
        ),
    ] {
        let page = Document::new("docs/page.md", text);
        let found = stale(&page, std::slice::from_ref(&page), &has);
        assert_eq!(found.len(), count, "{text}: {found:?}");
    }
}

//! Tests of the scanners of words and of documents, on small texts with planted mistakes.

use crate::documents::{Repository, stale};
use crate::markdown::Document;
use crate::rules::Breach;
use crate::source::of_files;
use crate::{exercises, words};
use rstest::rstest;

fn owned(files: &[(&str, &str)]) -> Vec<(String, String)> {
    files.iter().map(|(file, text)| ((*file).to_owned(), (*text).to_owned())).collect()
}

fn places(breaches: &[Breach]) -> Vec<String> {
    breaches.iter().map(|breach| format!("{}:{}", breach.file, breach.line)).collect()
}

#[rstest]
#[case::a_type("/// x\npub(crate) struct Census;", &["src/a.rs:2"])]
#[case::a_trait("pub trait Touch<T> {}", &["src/a.rs:1"])]
#[case::a_function("fn f() {\n    solver.safe_step()\n}", &["src/a.rs:2"])]
#[case::a_variant("enum Wall { Hold }", &[])]
#[case::a_string("const A: &str = \"Census, safe_step\";", &[])]
#[case::a_longer_word("struct CensusOfX; fn unsafe_step() {}", &[])]
fn an_old_word_is_found(#[case] code: &str, #[case] expected: &[&str]) {
    assert_eq!(places(&words::old(&of_files(&owned(&[("src/a.rs", code)])))), expected);
}

#[rstest]
#[case::a_column("let column = (\"carried\", 8);", 1)]
#[case::a_key("\n| `unrest` |\n", 1)]
#[case::in_prose("a stress carried through cells, a safely chosen step", 0)]
#[case::a_longer_word("an unsafe_step of unrestricted size", 0)]
fn an_old_word_of_reports_is_found(#[case] text: &str, #[case] count: usize) {
    assert_eq!(words::old_phrases(&owned(&[("docs/a.md", text)])).len(), count);
}

#[rstest]
#[case::in_a_line("because: a bar of which the end moves", &["verification/a.yaml:1"])]
#[case::in_upper_case("# Whatever the law", &["verification/a.yaml:1"])]
#[case::across_lines("about: |\n  the error of\n  which the cause is known\n", &["verification/a.yaml:2"])]
#[case::across_lines_of_a_comment("# the error but\n# for rounding\n", &["verification/a.yaml:1"])]
#[case::on_two_lines("but for a\nbut for b\n", &["verification/a.yaml:1", "verification/a.yaml:2"])]
#[case::a_longer_word("a bar withheld to the end, beside_x", &[])]
fn an_unclear_phrase_is_found(#[case] text: &str, #[case] expected: &[&str]) {
    let breaches = words::unclear_phrases(&owned(&[("verification/a.yaml", text)]));
    assert_eq!(places(&breaches), expected);
}

#[rstest]
#[case::in_a_comment("fn f() {} \n// a bar of which the end moves", &["src/a.rs:2"])]
#[case::across_lines("    /// the error but\n    /// for rounding\n", &["src/a.rs:1"])]
#[case::in_a_string("let a = \"a bar of which the end moves\";", &[])]
#[case::across_an_item("/// an error but\nfn f() {}\n/// for rounding\n", &[])]
fn an_unclear_phrase_of_a_comment_is_found(#[case] text: &str, #[case] expected: &[&str]) {
    let comments = words::of_comments(&owned(&[("src/a.rs", text)]));
    assert_eq!(places(&words::unclear_phrases(&comments)), expected);
}

#[rstest]
fn an_old_name_of_a_file_is_found() {
    let files = ["src/mpm/spots.rs", "src/pricing/mod.rs", "src/mpm/spotsy.rs"].map(str::to_owned);
    assert_eq!(places(&words::old_files(&files)), ["src/mpm/spots.rs:1", "src/pricing/mod.rs:1"]);
}

#[rstest]
#[case::two_types("struct Row;", "enum Row {}", 1)]
#[case::declared_by_two_traits("trait A { type Row; }", "trait B {\ntype Row: Clone; }", 1)]
#[case::an_alias("struct Row;", "type Row = u8;", 1)]
#[case::in_a_function("struct Row;", "fn f() { struct Row; }", 1)]
#[case::given_by_two_implementations(
    "impl A for X { type Row = u8; }",
    "impl A for Y { type Row = u8; }",
    0
)]
#[case::after_an_implementation("impl A for X { fn f() {} }\nstruct Row;", "struct Row;", 1)]
#[case::for_tests("struct Row;", "#[cfg(test)]\nmod tests { struct Row; }", 0)]
#[case::allowed("struct Value;", "struct Value;", 0)]
fn a_name_of_two_types_is_found(#[case] a: &str, #[case] b: &str, #[case] count: usize) {
    let sources = of_files(&owned(&[("src/a.rs", a), ("src/b.rs", b)]));
    let found = words::twice(&sources, &[("Value", "why")]);
    assert_eq!(found.len(), count, "{found:?}");
    assert!(found.iter().all(|breach| breach.file == "src/b.rs"));
}

#[rstest]
#[case::what("/// What a thing does.", true)]
#[case::whatever("\n    //! Whatever it is.", true)]
#[case::no_documentation("// What was measured.", true)]
#[case::the_same("/// The same in 2-D.", true)]
#[case::a_limit("/// Fewest levels.", true)]
#[case::on_a_second_line("/// Errors.\n/// Those of `f`.", true)]
#[case::later("/// Says what it is.", false)]
#[case::a_longer_word("/// Mostly harmless.", false)]
#[case::in_code("const A: &str = \"What\";", false)]
fn a_comment_with_an_unclear_beginning_is_found(#[case] text: &str, #[case] found: bool) {
    let breaches = words::comments(&owned(&[("src/a.rs", text)]));
    assert_eq!(places(&breaches).len(), usize::from(found));
}

#[rstest]
fn a_long_line_of_a_comment_is_found() {
    let line = |columns: usize| format!("fn f() {{}}\n//! {}", "x".repeat(columns - 4));
    let found = |columns| places(&words::comments(&owned(&[("src/a.rs", &line(columns))])));
    assert_eq!(found(101), ["src/a.rs:2"]);
    assert!(found(100).is_empty());
    let code = format!("let x = \"{}\"; // short", "x".repeat(100));
    assert!(words::comments(&owned(&[("src/a.rs", &code)])).is_empty(), "code is rustfmt's");
}

const MANIFEST: &str = "[[bench]]\nname = \"transfer\"\n";

/// Mistakes in a document `docs/page.md` of a small repository.
fn mistakes(text: &str) -> Vec<String> {
    let files = [
        "README.md",
        "docs/page.md",
        "src/mpm/mod.rs",
        "src/mpm/grid.rs",
        "src/report/json.rs",
        "ci/check",
        "tests/cli.rs",
        "verification/bar.yaml",
        "verification/bar.snap",
    ];
    let texts = owned(&[
        ("src/mpm/grid.rs", "pub struct Grid; impl Grid { fn locate() {} }"),
        ("src/report/json.rs", "row(\"verdict\", 1)"),
    ]);
    let has = Repository::new(&files.map(str::to_owned), &texts, MANIFEST);
    let documents = [
        Document::new("docs/page.md", text),
        Document::new("README.md", "# Two words, one `sign`\n"),
    ];
    stale(&documents[0], &documents, &has).into_iter().map(|breach| breach.what).collect()
}

#[rstest]
#[case::link("see [the grid](../src/mpm/gird.rs)")]
#[case::link_beside("see [it](src/mpm/grid.rs)")]
#[case::heading("see [it](../README.md#two-words)")]
#[case::heading_here("# One\nsee [it](#two)")]
#[case::path("in `src/mpm/gird.rs`")]
#[case::path_in_src("in `mpm/gird.rs`")]
#[case::one_of_two_paths("in `src/mpm/{grid,gird}.rs`")]
#[case::file_name("in `gird.rs`")]
#[case::module("by `mpm::gird`")]
#[case::item("by `mpm::grid::Gird`")]
#[case::type_name("a `GridCell`")]
#[case::script("by `ci/chekc`")]
#[case::script_in_a_block("```console\nbash ci/chekc\n```")]
#[case::cargo("```sh\ncargo tset\n```")]
#[case::cargo_in_text("with `cargo bench --bench trasnfer`")]
#[case::bench("```console\nMPM_BENCH=full cargo bench --bench trasnfer -- 2d  # slow\n```")]
#[case::test("```console\ncargo test --test clii\n```")]
#[case::flag("```console\ncargo run --relaese\n```")]
#[case::layout("```text\nsrc/mpm, src/mmp   the solver\n```")]
#[case::layout_module("```text\n -> mpm::gird  words\n```")]
#[case::json("```json\n{\"verdict\": 1}}\n```")]
#[case::json_key("```json\n{\"verdict\": [{\"verdit\": 1}]}\n```")]
fn mistake_in_a_document_is_found(#[case] text: &str) {
    let found = mistakes(text);
    assert_eq!(found.len(), 1, "{found:?}");
}

#[rstest]
#[case::links("[a](../src/mpm/grid.rs) [b](https://a.b/c.rs) [c](../README.md#two-words-one-sign)")]
#[case::paths("`src/mpm/grid.rs`, `mpm/grid.rs`, `grid.rs`, `ci/check`, `src/mpm/`, `page.md`")]
#[case::any("`verification/*.yaml`, `verification/NAME.snap`")]
#[case::names("`mpm::Grid`, `mpm::grid::Grid::locate`, `Grid`, `std::fs::read`, `T::default()`")]
#[case::no_paths("`h/(c + |v|)`, `n_left/h`, `a.yaml`, `1/64`, `E/rho`, `x^2`")]
#[case::commands(
    "```console\ncargo test bar\ncargo bench --bench transfer -- 2d\nbash ci/check\n```"
)]
#[case::other_commands("```console\ngit switch main\nmpm-verify run\n```")]
#[case::layout("```text\nsrc/mpm, src/mpm/{mod,grid}.rs   the solver\n -> mpm::grid  words\n```")]
#[case::json("```json\n{\"verdict\": [1, null]}\n```")]
fn a_sound_document_passes(#[case] text: &str) {
    assert_eq!(mistakes(text), [""; 0]);
}

#[test]
fn exercise_that_differs_from_the_compiled_member_is_found() {
    let page = "File: tests/exercises/spin.rs\n\n```rust\nstruct A;\n```\n";
    let stale = exercises::stale(&[Document::new("docs/exercises/effect.md", page)]);
    assert!(stale.iter().any(|line| line.contains("spin.rs differs")), "{stale:?}");
    assert!(stale.iter().any(|line| line.contains("no page shows")), "{stale:?}");
}

#[test]
fn exercise_that_touches_too_many_files_is_found() {
    let text =
        "A permanent figure belongs in `src/verify`.\n\nIn `src/lib.rs`:\n\nIn\n`src/no.rs`:\n";
    let wrong = exercises::touching_too_much(&[Document::new("docs/exercises/figure.md", text)]);
    let expected = [
        "docs/exercises/basis.md is missing",
        "docs/exercises/figure.md: there is no src/no.rs",
        "docs/exercises/figure.md: 3 files, not 1 to 1: src/lib.rs, src/no.rs, src/verify",
    ];
    for line in expected {
        assert!(wrong.iter().any(|found| found == line), "{line}: {wrong:?}");
    }
}

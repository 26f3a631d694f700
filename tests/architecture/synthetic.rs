//! Tests of the scanner of imports, on small crates with planted breaches.

use crate::graph::{Edge, cycles, edges};
use crate::rules;
use crate::rules::IMPORT_RULES;
use crate::source::{Source, of_files, with_tests};
use crate::token::tokens;
use rstest::rstest;

fn sources(files: &[(&str, &str)]) -> Vec<Source> {
    let owned: Vec<_> = files.iter().map(|(f, t)| ((*f).to_owned(), (*t).to_owned())).collect();
    of_files(&owned)
}

/// `from -> to` for every import, in the order of the files.
fn arrows(files: &[(&str, &str)]) -> Vec<String> {
    let arrow = |edge: &Edge| format!("{} -> {}", edge.from.join("::"), edge.to.join("::"));
    let mut found: Vec<String> = edges(&sources(files)).iter().map(arrow).collect();
    found.dedup();
    found
}

fn words(text: &str) -> Vec<String> {
    tokens(text).into_iter().map(|token| token.text).collect()
}

#[rstest]
#[case::line_comment("a // crate::b\nc")]
#[case::documentation("/// [`crate::b`]\na //! x.sin()\nc")]
#[case::nested_comment("a /* /* crate::b */ \" */ c")]
#[case::string(r#"a "crate::b \" // \\" c"#)]
#[case::raw_string("a r#\"crate::b \" \\\"# c")]
#[case::byte_string(r#"a b"crate::b" br"\" c"#)]
#[case::character(r#"a '"' '\'' b'"' '\u{27}' c"#)]
#[case::lifetime("a 'crate c")]
#[case::string_over_lines("a \"x\n\ny\" c")]
fn comments_and_strings_are_skipped(#[case] text: &str) {
    assert_eq!(words(text), ["a", "c"]);
    let (last, lines) = (tokens(text).pop().map(|token| token.line), text.lines().count());
    assert_eq!(last, Some(lines), "lines are counted through it");
}

#[rstest]
fn punctuation_and_identifiers_are_tokens() {
    assert_eq!(
        words("a::b<'x>(r#type, 2.sin())"),
        ["a", "::", "b", "<", ">", "(", "type", ",", "2", ".", "sin", "(", ")", ")"]
    );
}

#[rstest]
#[case::braces("use crate::{b::{self, X as Y}, c::*};", &["a -> b", "a -> c"])]
#[case::super_in_code("fn f() -> super::b::X { crate::c::f::<1>() }", &["a -> b", "a -> c"])]
#[case::through_a_name("use crate::b;\nfn f() { b::f() }", &["a -> b"])]
#[case::only_a_name("use crate::b;", &[])]
#[case::other_crates("use std::b::X; use ::b::X; use serde::{b, c::Y};", &[])]
#[case::exported("pub use crate::b::X;", &["a -> b"])]
#[case::within_a_visibility("pub(in crate::b) fn f() {}", &[])]
#[case::precise_capture("fn f<'x>(x: &'x u8) -> impl Sized + use<'x> { b::f(x) }", &[])]
#[case::in_a_macro_rule("macro_rules! m { () => { $crate::b::X; crate::c::f() } }", &[])]
#[case::under_cfg_test("#[cfg(test)]\n#[allow(x)]\nmod tests { use crate::b::X; }", &[])]
#[case::after_cfg_test("#[cfg(test)]\nuse crate::b::X;\nuse crate::c::Y;", &["a -> c"])]
fn imports_are_read(#[case] code: &str, #[case] expected: &[&str]) {
    let others = [("src/b.rs", "pub struct X;"), ("src/c.rs", "pub struct Y;")];
    assert_eq!(arrows(&[&[("src/a.rs", code)], &others[..]].concat()), expected);
}

#[rstest]
#[case::re_exported("use crate::m::Grid;", &["a -> m::grid"])]
#[case::renamed("use crate::m::Net as N;", &["a -> m::grid"])]
#[case::twice_re_exported("use crate::Grid;", &["a -> m::grid"])]
#[case::a_variant("use crate::m::Grid::Fine;", &["a -> m::grid"])]
#[case::an_item_named_like_its_module("use crate::m::read;", &["a -> m::read"])]
#[case::a_function_named_like_a_module("use crate::m::grid;", &["a -> m"])]
#[case::defined_in_the_folder("use crate::m::Own;", &["a -> m"])]
fn a_re_export_leads_to_the_definition(#[case] code: &str, #[case] expected: &[&str]) {
    let folder = "mod grid; mod read; pub use grid::{Grid, Grid as Net}; pub use read::read; \
                  pub struct Own; pub fn grid() {}";
    let mut found = arrows(&[
        ("src/lib.rs", "mod a; mod m; pub use m::Grid;"),
        ("src/a.rs", code),
        ("src/m/mod.rs", folder),
        ("src/m/grid.rs", "pub enum Grid { Fine }"),
        ("src/m/read.rs", "pub fn read() {}"),
    ]);
    found.retain(|arrow| arrow.starts_with('a'));
    assert_eq!(found, expected);
}

#[rstest]
fn siblings_may_meet_through_their_folder() {
    let crate_of = [
        ("src/m/mod.rs", "mod a; mod b; pub use a::A; pub use b::B;"),
        ("src/m/a.rs", "use crate::m::B;"),
        ("src/m/b.rs", "pub struct B;"),
    ];
    assert_eq!(arrows(&crate_of), ["m::a -> m::b"]);
    assert!(cycles(&edges(&sources(&crate_of))).is_empty());
}

#[rstest]
#[case::two("use crate::b::B;", "use super::a::A;", 2)]
#[case::through_a_folder("use crate::m::C;", "fn f(a: crate::a::A) {}", 2)]
#[case::three("use crate::b::B;", "use crate::m::C;", 3)]
fn a_planted_cycle_is_found(#[case] a: &str, #[case] b: &str, #[case] length: usize) {
    let edges = edges(&sources(&[
        ("src/a.rs", a),
        ("src/b.rs", b),
        ("src/m/mod.rs", "mod c; pub use c::C;"),
        ("src/m/c.rs", "use crate::a::A;"),
    ]));
    let found = cycles(&edges);
    assert_eq!(found.iter().map(Vec::len).collect::<Vec<_>>(), [length]);
}

#[rstest]
fn a_folder_and_its_child_can_form_a_cycle() {
    let planted = [
        ("src/m/mod.rs", "mod c; pub struct Own; fn f() { c::g() }"),
        ("src/m/c.rs", "use super::Own;"),
    ];
    assert_eq!(cycles(&edges(&sources(&planted))).len(), 1);
}

#[rstest]
#[case("src/mpm/grid.rs", "use crate::verify::Claim;", 1)]
#[case("src/mpm/grid.rs", "use crate::{named::named, subject::Subject};", 0)]
#[case("src/fem/bar.rs", "fn f() { crate::mpm::g() }", 1)]
#[case("src/verify/run.rs", "\nuse crate::mpm::Solver;", 1)]
#[case("src/verify/run.rs", "use crate::{exact::Truth, subject::Subject};", 0)]
#[case("src/report/text.rs", "use super::super::suite::Suite;", 1)]
#[case("src/exact/motion.rs", "pub use crate::fem::Bar;", 1)]
#[case("src/study/setup/dispatch.rs", "use crate::{mpm::Solver, fem::Bar, verify::Claim};", 0)]
#[case("src/suite/compile.rs", "use crate::{report::Row, suite::grammar::Spec};", 0)]
#[case("src/suite/compile.rs", "use crate::study::Runner;", 1)]
#[case("src/suite/model.rs", "use crate::suite::compile::Suite;", 1)]
#[case("src/suite/grammar/step.rs", "use super::super::yaml::Place;", 0)]
#[case("src/suite/yaml/read.rs", "use crate::suite::grammar::Spec;", 1)]
fn a_planted_forbidden_import_is_found(
    #[case] file: &str,
    #[case] code: &str,
    #[case] breaches: usize,
) {
    let parts = "named subject mpm fem exact verify report suite suite/yaml suite/grammar study";
    let folders: Vec<String> = parts.split(' ').map(|part| format!("src/{part}/mod.rs")).collect();
    let mut files = vec![(file, code)];
    files.extend(folders.iter().map(|folder| (folder.as_str(), "")));
    let edges = edges(&sources(&files));
    let found: Vec<_> =
        IMPORT_RULES.iter().flat_map(|rule| rules::forbidden_imports(rule, &edges)).collect();
    assert_eq!(found.len(), breaches, "{found:?}");
    assert!(found.iter().all(|breach| breach.file == file && breach.line == code.lines().count()));
}

#[rstest]
#[case::method("src/mpm/a.rs", "fn f(x: f64) -> f64 { x.sin() }", 1)]
#[case::power("src/mpm/a.rs", "fn f(x: f64) -> f64 {\n(x + 1.0).powi(2) * x.powf(0.5) }", 2)]
#[case::as_a_value("src/mpm/a.rs", "fn f() { map(f64::exp) }", 1)]
#[case::of_a_number("src/exact/formula/a.rs", "fn f<N: Number>(x: N) -> N { x.sin() }", 0)]
#[case::not_of_a_number("src/exact/formula/a.rs", "fn f() { map(f64::exp) }", 1)]
#[case::fine("src/mpm/a.rs", "fn f(x: f64) -> f64 { libm::sin(x).sqrt() + x.sin }", 0)]
fn a_planted_platform_function_is_found(
    #[case] file: &str,
    #[case] code: &str,
    #[case] count: usize,
) {
    assert_eq!(rules::platform_calls(&sources(&[(file, code)])).len(), count);
}

#[test]
fn tests_that_run_a_solver_are_found_in_tests_only() {
    let step = "fn f() { Solver::new(setup); }";
    let planted = [
        ("src/code.rs", step.to_owned()),
        ("src/tested.rs", format!("{step}\n#[cfg(test)]\nmod tests {{\n{step}\n}}")),
        ("src/mpm.rs", "#[cfg(test)]\nmod laws;\nmod solver;".to_owned()),
        ("src/mpm/laws.rs", step.to_owned()),
        ("src/fem/tests/time.rs", format!("// Solver::new\n{step}")),
    ];
    let planted = with_tests(&planted.map(|(file, text)| (file.to_owned(), text)));
    let found = rules::tests_with(&planted, &[&["Solver", "::", "new"], &["Runner"]]);
    let found: Vec<String> = found.iter().map(|b| format!("{}:{}", b.file, b.line)).collect();
    assert_eq!(found, ["src/fem/tests/time.rs:2", "src/mpm/laws.rs:1", "src/tested.rs:4"]);
}

#[rstest]
fn other_planted_breaches_are_found() {
    let body = "fn f() {}\n".repeat(rules::MOST_LINES);
    let long = format!("{body}fn g() {{}}\n");
    let tested = format!("{body}#[cfg(test)]\nmod tests {{\n    fn t() {{}}\n}}\n");
    let planted = sources(&[
        ("src/long.rs", &long),
        ("src/tested.rs", &tested),
        ("src/mpm/utils.rs", "mod inner { fn f(x: f64) { x.mul_add(x, x) } }"),
        ("src/mpm/foundation/simd/plain.rs", "fn f(x: f64) { x.mul_add(x, libm::fma(x, x, x)) }"),
        ("src/mpm/tests/common.rs", "use serde_yaml::Value;"),
        ("src/both.rs", "use crate::mpm::Solver;\nuse crate::fem::Bar;"),
    ]);
    let files = |found: Vec<rules::Breach>| -> Vec<String> {
        found.into_iter().map(|breach| format!("{}:{}", breach.file, breach.line)).collect()
    };
    assert_eq!(files(rules::long(&planted, &[])), ["src/long.rs:501"]);
    assert!(rules::long(&planted, &[("src/long.rs", "why")]).is_empty());
    assert_eq!(files(rules::nameless(&planted)), ["src/mpm/utils.rs:1"]);
    assert_eq!(files(rules::nested(&planted)), ["src/mpm/utils.rs:1"]);
    assert_eq!(files(rules::fused(&planted)), ["src/mpm/utils.rs:1"]);
    let both: [&[&str]; 2] = [&["Solver"], &["Bar"]];
    assert_eq!(files(rules::mentions(&planted, &both, "src/suite/")), ["src/both.rs:2"]);
    assert!(rules::mentions(&planted, &both, "src/both.rs").is_empty());
    assert!(rules::mentions(&planted, &[&["serde_yaml"]], "src/suite/").is_empty(), "only tests");
}

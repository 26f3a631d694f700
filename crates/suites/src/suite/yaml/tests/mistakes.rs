//! Tests of single mistakes in the sample: position, message and advice.

use super::{SAMPLE, Suite};
use crate::suite::yaml::{Diagnostic, OneOrMany, Ordered, Source, read, refuse};
use rstest::rstest;
use serde::de::{DeserializeOwned, IgnoredAny};
use serde::{Deserialize, Deserializer};

fn wrong<T: DeserializeOwned>(yaml: &str) -> Diagnostic {
    let source = Source::from_text("bar.yaml", yaml);
    source.and_then(|source| read::<T>(&source)).err().expect("a mistake")
}

fn check(diagnostic: &Diagnostic, place: (usize, usize, usize), message: &str, help: &str) {
    let found = diagnostic.place().expect("a place");
    let found = (found.line(), found.column(), found.length());
    assert_eq!((found, diagnostic.message()), (place, message), "\n{diagnostic}");
    assert_eq!(diagnostic.help().unwrap_or_default(), help, "\n{diagnostic}");
}

#[rstest]
#[case::unknown_key("cells:", "cels:", (9, 10, 4), "unknown key `cels`", "did you mean `cells`?")]
#[case::unknown_key_far("ppc", "thickness", (9, 30, 9), "unknown key `thickness`", "possible keys: `cells`, `ppc`, `until`")]
#[case::capitals("dimension:", "Dimension:", (4, 3, 9), "unknown key `Dimension`", "did you mean `dimension`?")]
#[case::unknown_member("linear_elastic", "linear-elastic", (6, 14, 14), "unknown name `linear-elastic`", "did you mean `linear_elastic`?")]
#[case::unknown_bare_name("left: fixed", "left: fxied", (7, 20, 5), "unknown name `fxied`", "did you mean `fixed`?")]
#[case::unknown_in_a_list("musl, usl", "musl, leapfrog", (11, 57, 8), "unknown name `leapfrog`", "possible names: `musl`, `usl`")]
#[case::forged("cells:", "\"x`, expected `y\":", (9, 10, 17), "unknown key `x`, expected `y`", "possible keys: `cells`, `ppc`, `until`")]
#[case::like_an_error("basis: linear", "basis: invalid indentation", (11, 18, 19), "unknown name `invalid indentation`", "possible names: `linear`, `quadratic_bspline`")]
#[case::like_another_error("ppc: 4", "ppc: found a tab character", (9, 35, 21), "expected a whole number from 0 to 65535, found the string \"found a tab character\"", "")]
#[case::missing(", density: rho", "", (6, 30, 1), "missing key `density` in `linear_elastic`", "add `density: VALUE` in `linear_elastic`")]
#[case::missing_at_the_root("suite: vibrating-bar\n", "", (1, 1, 10), "missing key `suite`", "add `suite: VALUE`")]
#[case::missing_in_a_block("  dimension: 1\n", "", (4, 3, 4), "missing key `dimension` in `scene`", "add `dimension: VALUE` in `scene`")]
#[case::nothing_there("  - mpm: {basis: linear, transfer: flip, scheme: [musl, usl]}", "  - mpm:", (11, 9, 0), "missing key `basis` in `mpm`", "add `basis: VALUE` in `mpm`")]
#[case::text_for_a_count("5, 10", "five, 10", (9, 18, 4), "expected a whole number, zero or more, found the string \"five\"", "")]
#[case::quoted_number("5, 10", "\"5\", 10", (9, 18, 3), "expected a whole number, zero or more, found the string \"5\"", "remove the quotes")]
#[case::negative_count("5, 10", "-5, 10", (9, 18, 2), "expected a whole number, zero or more, found the number -5", "")]
#[case::fraction("5, 10", "5.5, 10", (9, 18, 3), "expected a whole number, zero or more, found the number 5.5", "")]
#[case::out_of_range("dimension: 1", "dimension: 300", (4, 14, 3), "expected a whole number from 0 to 255, found the number 300", "")]
#[case::list_for_a_number("ppc: 4", "ppc: [4]", (9, 35, 1), "expected a whole number from 0 to 65535, found a list", "")]
#[case::number_for_a_list("[5, 10, 20]", "5", (9, 17, 1), "expected a list, found the number 5", "")]
#[case::word_for_a_map("{cells: [5, 10, 20], ppc: 4}", "fine", (9, 9, 4), "expected a map (`key: value`), found the string \"fine\"", "")]
#[case::flag("  dimension: 1", "  quiet: 1\n  dimension: 1", (4, 10, 1), "expected `true` or `false`, found the number 1", "")]
#[case::flag_for_a_formula("poisson: 0", "poisson: true", (6, 50, 4), "expected a finite number or a formula, found `true`", "")]
#[case::nothing_for_a_formula("poisson: 0", "poisson: ~", (6, 50, 1), "expected a finite number or a formula, found nothing", "")]
#[case::map_for_a_formula("L: 25", "L: {a: 1}", (2, 17, 1), "expected a finite number or a formula, found a map (`key: value`)", "")]
#[case::list_for_a_name("basis: linear", "basis: [linear]", (11, 18, 1), "expected a name, or a name with its settings, found a list", "")]
#[case::too_long("[1.9, 2.1]", "[1.9, 2.1, 3]", (13, 13, 1), "expected a list of 2 values, found 3", "")]
#[case::too_short("[1.9, 2.1]", "[1.9]", (13, 13, 1), "expected a list of 2 values, found 1", "")]
#[case::settings_where_none("left: fixed", "left: {fixed: {a: 1}}", (7, 21, 5), "`fixed` takes no settings", "write the bare name `fixed`")]
#[case::settings_lacking("{linear_elastic: {young: E, poisson: 0, density: rho}}", "linear_elastic", (6, 13, 14), "`linear_elastic` needs settings", "write `linear_elastic: ...` with its settings")]
#[case::two_names("{box: {from: [0], to: [L]}}", "{box: {from: [0], to: [L]}, ball: 1}", (5, 9, 1), "one name with its settings is expected here, found none or several", "write `{NAME: {...}}`; a list holds several")]
#[case::two_names_of_many("{linear_elastic: {young: E, poisson: 0, density: rho}}", "{neo_hookean: {young: E}, rigid: 1}", (6, 13, 1), "one name with its settings is expected here, found none or several", "write `{NAME: {...}}`; a list holds several")]
#[case::no_name("{box: {from: [0], to: [L]}}", "{}", (5, 9, 1), "one name with its settings is expected here, found none or several", "write `{NAME: {...}}`; a list holds several")]
#[case::twice("ppc: 4", "ppc: 4, cells: [1]", (9, 38, 5), "the key `cells` is given twice", "keep one of the two")]
#[case::parameter_twice("rho: 1,", "rho: 1, L: 3,", (2, 37, 1), "the key `L` is given twice", "keep one of the two")]
#[case::not_a_number("poisson: 0", "poisson: .nan", (6, 50, 4), "expected a finite number, found NaN", "")]
#[case::infinite("[1.9, 2.1]", "[1.9, .inf]", (13, 19, 4), "expected a finite number, found infinity", "")]
#[case::empty_list("[musl, usl]", "[]", (11, 50, 1), "an empty list selects nothing", "")]
#[case::key_of_a_list("L: 25", "[L]: 25", (2, 14, 1), "expected a name as key, found a list", "")]
#[case::tab("  dimension", "\tdimension", (4, 1, 1), "tab used for indentation; YAML needs spaces", "")]
#[case::tab_after_spaces("  - {order", "  \t- {order", (13, 3, 1), "tab used for indentation; YAML needs spaces", "")]
#[case::tab_under_a_value("  body", "\tbody", (5, 1, 1), "tab used for indentation; YAML needs spaces", "")]
#[case::open_bracket("[5, 10, 20]", "[5, 10, 20", (9, 17, 1), "this `[` is not closed before a `}`", "the `}` is on line 9, column 35")]
#[case::crossed_brackets("to: [L]}}", "to: [L}}}", (5, 31, 1), "this `[` is not closed before a `}`", "the `}` is on line 5, column 33")]
#[case::open_bracket_before_a_key("[5, 10, 20], ppc: 4}", "[5, 10, 20", (9, 17, 1), "this `[` is not closed before line 10", "close it; lines inside brackets need more indentation than their key")]
#[case::indentation_in_brackets("poisson: 0, ", "\npoisson: 0, ", (6, 30, 1), "this `{` is not closed before line 7", "close it; lines inside brackets need more indentation than their key")]
#[case::after_a_quote("vibrating-bar", "'vibrating' bar", (1, 20, 3), "text after a closing quote", "put the whole value in quotes")]
#[case::tab_in_the_first_line("suite:", "\tsuite:", (1, 1, 1), "tab used for indentation; YAML needs spaces", "")]
#[case::tab_after_a_key("dimension: 1", "dimension:\t1", (4, 13, 1), "expected a space here, found a tab", "replace the tab by a space")]
#[case::no_comma_in_a_map("L: 25, E", "L: 25 E", (2, 21, 1), "expected `,` or `}` here", "keys of a map are separated by `,`")]
#[case::open_to_the_end("\"...\"}", "\"...\"", (13, 5, 1), "this `{` is never closed", "")]
#[case::stray_bracket("dimension: 1", "dimension: ]", (4, 14, 1), "`]` without a `[` before it", "")]
#[case::open_quote("\"...\"", "\"...", (13, 34, 1), "this quote is never closed", "")]
#[case::no_comma("[1.9, 2.1]", "[1.9 , [2.1] 3]", (13, 26, 1), "expected `,` or `]` here", "entries of a list are separated by `,`")]
#[case::colon_in_text("vibrating-bar", "vibrating: bar", (1, 17, 1), "`:` is not possible here", "check the indentation; put text that holds `: ` in quotes")]
#[case::at_sign("vibrating-bar", "@bar", (1, 8, 1), "a value cannot start with this character", "put the value in quotes")]
#[case::star("poisson: 0", "poisson: *nu", (6, 50, 1), "anchors and aliases are not supported", "put text in quotes; give a value a name under `parameters`")]
#[case::too_far_in("  dimension", "   dimension", (5, 3, 4), "expected a key here", "check the indentation, and quotes around text that holds `:`, `#` or quotes")]
#[case::escape("pi/", "\\pi/", (2, 45, 1), "unknown escape in double quotes", "use single quotes to keep `\\` as it is")]
#[case::second_document("refine:", "---\nrefine:", (9, 1, 1), "a second document starts here", "put each suite in a file of its own")]
#[case::after_the_end("refine:", "...\nrefine:", (10, 1, 1), "a second document starts here", "put each suite in a file of its own")]
fn in_the_sample(
    #[case] right: &str,
    #[case] mistaken: &str,
    #[case] place: (usize, usize, usize),
    #[case] message: &str,
    #[case] help: &str,
) {
    assert!(SAMPLE.contains(right), "{right}");
    check(&wrong::<Suite>(&SAMPLE.replacen(right, mistaken, 1)), place, message, help);
}

/// Mistakes in a file of a few lines: message, and start of the place.
#[rstest]
#[case::bracket_before_a_key("a: {b: 2, c: 4\nd: {e: 1}", (1, 4), "this `{` is not closed before line 2")]
#[case::bracket_before_an_entry("a:\n  - {b: {c: d}\n  - {e: f}", (2, 5), "this `{` is not closed before line 3")]
#[case::bracket_in_a_list("a:\n  b:\n  - [0, 0]\n  - [1, 0\n  - [1, 1]", (4, 5), "this `[` is not closed before line 5")]
#[case::crossed_before_an_entry("a:\n  - {b: {c: d, e: [f, g}}\n  - h", (2, 19), "this `[` is not closed before a `}`")]
#[case::crossed_by_the_next_value("a: {b: [0, c: [8]}}", (1, 8), "this `[` is not closed before a `}`")]
#[case::crossed_by_the_map("a: {b: [0, c: 8}", (1, 8), "this `[` is not closed before a `}`")]
#[case::crossed_in_a_line("a: {b: [0, c: 8}\nd: 1", (1, 8), "this `[` is not closed before a `}`")]
#[case::stray_after_a_list("a:\n- [0, 0]\n- [1, 0]]", (3, 9), "`]` without a `[` before it")]
#[case::stray_in_a_list("a:\n- [0, 0]\n- }", (3, 3), "`}` without a `{` before it")]
#[case::stray_in_text("a: x]\nb: [1, 2", (2, 4), "this `[` is never closed")]
#[case::no_comma_in_json("{\n\"a\": 1\n\"b\": 2\n}", (3, 4), "expected `,` or `}` here")]
#[case::closed_too_far_left("a:\n  b: {c: 1\n}", (3, 1), "text in brackets needs more indentation than its key")]
#[case::no_comma_in_lines("a: {b: 1,\n    c: 2\n    d: 3}", (3, 6), "expected `,` or `}` here")]
#[case::comment_then_indentation("a:\n  b: 1 # m\n   c: 2", (3, 4), "expected a key here")]
#[case::comment_then_tab("a: b # name\n\tc: d", (2, 1), "tab used for indentation; YAML needs spaces")]
#[case::tab_after_a_map("a: {b: 2}\n\tc: {d: 1}", (2, 1), "tab used for indentation; YAML needs spaces")]
#[case::tab_after_a_block("a: |\n  Some text.\n\tMore text.\nb: c", (3, 1), "tab used for indentation; YAML needs spaces")]
#[case::tab_in_a_block("a:\n  b: {c: 1}\n  \td: 1", (3, 3), "tab used for indentation; YAML needs spaces")]
#[case::tab_in_a_list("a:\n- [0, 0]\n\t- [1, 0]", (3, 1), "tab used for indentation; YAML needs spaces")]
#[case::tab_alone("a: b\n\t\nc: d", (2, 1), "tab used for indentation; YAML needs spaces")]
#[case::tab_before_a_comment("\t# c\na: b", (1, 1), "tab used for indentation; YAML needs spaces")]
#[case::quote_closed_later("a: {b: \"0.1*h, c: 1}\nd: 2\ne: [\"x\"]", (1, 8), "this quote is closed only on line 3")]
#[case::quote_not_on_its_line("a: \"b\nc: \"d\"", (1, 4), "this quote is not closed on its line")]
#[case::bullet("a:\n  * b: 1", (2, 3), "anchors and aliases are not supported")]
#[case::ampersand("a: & b", (1, 4), "anchors and aliases are not supported")]
#[case::exclamation("a: !important! b", (1, 4), "tags are not supported")]
#[case::exclamations("a: !foo!bar b", (1, 4), "tags are not supported")]
#[case::bracket_in_an_escaped_text("a: {b: \"c\\\"[\", d: 1\ne: 2", (1, 4), "this `{` is not closed before line 2")]
#[case::negative_number("a: [1,\n-1\nb: 2", (1, 4), "this `[` is not closed before line 2")]
#[case::no_value_before_a_tab("a: {b: 1}\nc:\t\nd: [", (3, 4), "this `[` is never closed")]
#[case::version_and_text("%YAML 1.2 x\n---\na: 1", (1, 1), "this is not valid YAML: while scanning a directive, did not find expected comment or line break")]
#[case::indicator_in_text("a: |0 b\n", (1, 4), "text after `|` or `>` starts on the next line")]
#[case::stray_dash("a:\n  b: 1\n  - c: 2", (3, 3), "expected a key here")]
#[case::no_blank_before_a_comment("a: \"b\"#c", (1, 7), "expected a blank before the comment")]
#[case::bar_in_brackets("a: [U, |V|]", (1, 8), "a value cannot start with this character")]
#[case::blanks_before_a_block("a: |\n      \n  b", (3, 3), "the indentation of this block of text is unclear")]
#[case::indented_first_line(" a: b\nc: d", (2, 1), "expected the end of the file here")]
fn in_a_few_lines(#[case] yaml: &str, #[case] place: (usize, usize), #[case] message: &str) {
    let found = wrong::<IgnoredAny>(yaml);
    let at = found.place().expect("a place");
    assert_eq!(((at.line(), at.column()), found.message()), (place, message), "\n{found}");
}

#[test]
fn an_empty_value_before_a_tab_is_no_tab_error() {
    let found =
        wrong::<Suite>(&SAMPLE.replace("refine: {cells: [5, 10, 20], ppc: 4}", "refine:\t"));
    assert_eq!(found.message(), "missing key `cells` in `refine`");
}

#[rstest]
#[case::empty("")]
#[case::blank("  \n\n")]
#[case::comments("# nothing\n# yet\n")]
#[case::mark("---\n")]
#[case::null("~\n")]
#[case::capital_null("Null\n")]
fn an_empty_file(#[case] yaml: &str) {
    let diagnostic = wrong::<Suite>(yaml);
    assert_eq!(diagnostic.message(), "the file is empty; a suite starts with `suite: NAME`");
    assert!(diagnostic.place().is_some());
}

#[test]
fn a_list_or_a_word_as_the_whole_file() {
    let message = "expected a map (`key: value`), found a list";
    check(&wrong::<Suite>("- suite: bar"), (1, 1, 1), message, "");
    let message = "expected a map (`key: value`), found the string \"bar\"";
    check(&wrong::<Suite>("bar"), (1, 1, 3), message, "");
}

#[test]
fn nested_value_types_keep_the_place() {
    type Nested = Ordered<OneOrMany<Ordered<OneOrMany<u8>>>>;
    let message = "expected a whole number from 0 to 255, found the string \"x\"";
    check(&wrong::<Nested>("a:\n- b: [1, x]"), (2, 10, 1), message, "");
    check(&wrong::<Nested>("a: {b: x}"), (1, 8, 1), message, "");
    check(&wrong::<Nested>("a: [{b: []}]"), (1, 9, 1), "an empty list selects nothing", "");
    check(
        &wrong::<Nested>("a: 3"),
        (1, 4, 1),
        "expected a map (`key: value`), found the number 3",
        "",
    );
}

#[derive(Debug)]
struct Even;

impl<'de> Deserialize<'de> for Even {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match u8::deserialize(deserializer)? {
            7 => Err(serde::de::Error::custom("seven: a lucky one")),
            odd if odd % 2 == 1 => Err(refuse("odd: no", "an even number", "add one")),
            _ => Ok(Self),
        }
    }
}

#[test]
fn refusals_of_other_types_keep_message_and_help() {
    let diagnostic = wrong::<Ordered<Even>>("{a: 2, b c: 3}");
    assert_eq!(diagnostic.label(), Some("an even number"));
    // An error that is raised after parsing a value is located at the enclosing map or list.
    assert_eq!((diagnostic.message(), diagnostic.help()), ("odd: no", Some("add one")));
    assert_eq!(wrong::<Ordered<Even>>("a: 7").message(), "seven: a lucky one");
}

#[test]
fn diagnostic_is_formatted_like_a_compiler_error() {
    let diagnostic = wrong::<Suite>(&SAMPLE.replacen("cells:", "cels:", 1));
    let want = "\
error: unknown key `cels`
 --> bar.yaml:9:10
  |
9 | refine: {cels: [5, 10, 20], ppc: 4}
  |          ^^^^ not a known key
  |
  = help: did you mean `cells`?";
    assert_eq!(diagnostic.to_string(), want);
    assert_eq!(diagnostic.one_line(), "bar.yaml:9:10: unknown key `cels`");
}

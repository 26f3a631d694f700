//! Tests of malicious and accidentally harmful files.

use super::{SAMPLE, Suite};
use crate::suite::yaml::tree::build;
use crate::suite::yaml::{Diagnostic, MAX_ENTRIES, Source, read};
use rstest::rstest;
use saphyr_parser::Parser;
use serde::de::IgnoredAny;

fn refused(yaml: &str) -> Diagnostic {
    let source = Source::from_text("hostile.yaml", yaml);
    source.and_then(|source| read::<IgnoredAny>(&source)).unwrap_err()
}

fn lines(count: usize, line: impl Fn(usize) -> String) -> String {
    (0..count).map(line).collect::<Vec<_>>().join("\n")
}

const DEEP: &str = "lists and maps nest more than 64 deep";
const LONG_LIST: &str = "this list has more than 1000 entries";
const LONG_MAP: &str = "this map has more than 1000 entries";

#[rstest]
#[case::huge("[".repeat(200_000), "the file is too large: 196 KiB, at most 64 KiB")]
#[case::flow_lists("[".repeat(60_000), DEEP)]
#[case::flow_maps("{a: ".repeat(16_000), DEEP)]
#[case::dashes("- ".repeat(30_000), DEEP)]
#[case::questions("? ".repeat(30_000), "expected a name as key, found a map (`key: value`)")]
#[case::block_maps(lines(300, |n| format!("{}a:", " ".repeat(n))), DEEP)]
#[case::mixed(format!("{}{}", "- ".repeat(40), "[".repeat(40)), DEEP)]
#[case::hidden_behind_quoted_closers(format!("{}{}", "['x]]]]]',".repeat(4_000), "]"), DEEP)]
#[case::hidden_behind_comments(format!("{}{}", "[ # ]]\n".repeat(4_000), "]"), DEEP)]
#[case::after_a_block_scalar(format!("a: |\n  \"[\nb: {}", "[".repeat(60_000)), DEEP)]
#[case::after_a_folded_plain(format!("a: x\n  \"[\nb: {}", "[".repeat(60_000)), DEEP)]
#[case::alias_bomb(
    "a: &a [x, x]\nb: &b [*a, *a]\nc: [*b, *b]".to_owned(),
    "anchors and aliases are not supported"
)]
#[case::itself("&a [*a]".to_owned(), "anchors and aliases are not supported")]
#[case::tag("a: !box 1".to_owned(), "tags are not supported")]
#[case::merge("a: {b: 1}\n<<: {c: 1}".to_owned(), "merge keys are not supported")]
#[case::long_list(format!("[{}]", "0,".repeat(30_000)), LONG_LIST)]
#[case::long_map(lines(6000, |n| format!("k{n}: 0")), LONG_MAP)]
#[case::long_list_in_a_map(format!("{{a: [{}0], b: 1}}", "[0],".repeat(1000)), LONG_LIST)]
#[case::long_list_of_lines(lines(4000, |_| "- {a: 1, b: 2}".to_owned()), LONG_LIST)]
#[case::long_list_of_a_key(format!("a:\n{}\nb: 1", lines(1001, |_| "- 0".to_owned())), LONG_LIST)]
#[case::long_map_in_a_list(format!("[{{{}}}]", lines(1001, |n| format!("k{n}: [0, 0],"))), LONG_MAP)]
#[case::long_map_of_bare_keys(format!("{{{}}}", lines(1001, |n| format!("k{n},"))), LONG_MAP)]
#[case::long_map_of_stated_keys(lines(1001, |n| format!("? k{n}")), LONG_MAP)]
#[case::directive("%é😀😀@😀\n---\n''".to_owned(), "directives are not supported")]
#[case::directive_after_the_end("a: 1\n...\n%é😀😀@😀\n---\n''".to_owned(), "a second document starts here")]
#[case::long_line(format!("a: {}: b", "x".repeat(65_000)), "`:` is not possible here")]
#[case::control("a: \u{1b}[2J".to_owned(), "character U+001B is not allowed")]
#[case::line_separator("a: \u{2028}b".to_owned(), "character U+2028 is not allowed")]
#[case::lone_return("a: 1\rb: 2".to_owned(), "character U+000D is not allowed")]
fn is_refused_before_the_rest_is_parsed(#[case] yaml: String, #[case] message: &str) {
    let diagnostic = refused(&yaml);
    assert_eq!(diagnostic.message(), message);
    let shown = diagnostic.to_string();
    assert!(shown.lines().all(|line| line.chars().count() < 400), "{shown}");
    assert!(!shown.contains(['\u{1b}', '\r']));
    let mut events = 0;
    let _ = build("hostile.yaml", &yaml, Parser::new_from_str(&yaml).inspect(|_| events += 1));
    // The largest entry of a list in these files, `{a: 1, b: 2}`, has six events.
    assert!(events <= 6 * (MAX_ENTRIES + 1) + 10, "{events} events");
}

#[rstest]
#[case::nesting(format!("{}{}", "[".repeat(64), "]".repeat(64)))]
#[case::list(format!("[{}]", "0,".repeat(1000)))]
#[case::lists_of_two_keys(format!("a:\n{0}\nb:\n{0}", lines(1000, |_| "- 0".to_owned())))]
#[case::map_of_lists(lines(1000, |n| format!("k{n}:\n- [0, 0]\n- {{a: 0}}")))]
#[case::map_of_stated_keys(lines(1000, |n| format!("? k{n}\n: 0")))]
#[case::maps_in_a_list(lines(1000, |n| format!("- a: {n}\n  b: [{n}, {n}]")))]
fn up_to_the_maximum_is_accepted(#[case] yaml: String) {
    read::<IgnoredAny>(&Source::from_text("long", yaml).unwrap()).unwrap();
}

#[test]
fn a_key_of_sixty_kilobytes_is_shown_in_part() {
    let yaml = format!("{}: 1\n{SAMPLE}", "k".repeat(900));
    let source = Source::from_text("long.yaml", yaml).unwrap();
    let diagnostic = read::<Suite>(&source).unwrap_err();
    assert!(diagnostic.message().starts_with("unknown key `kkkk"));
    assert!(diagnostic.message().ends_with('…'));
    let shown = diagnostic.to_string();
    assert!(shown.lines().all(|line| line.chars().count() < 400), "{shown}");
}

#[test]
fn invisible_and_reordering_characters_are_escaped() {
    let yaml = "suite: {\u{202e}olleh: 1}";
    let source = Source::from_text("bidi\u{7}.yaml", yaml).unwrap();
    let diagnostic = read::<Suite>(&source).unwrap_err();
    let shown = diagnostic.to_string();
    assert!(!shown.contains(['\u{202e}', '\u{7}']), "{shown}");
    assert_eq!(diagnostic.file(), "bidi\\u{7}.yaml");
}

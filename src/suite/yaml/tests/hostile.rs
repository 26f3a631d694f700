//! Tests of malicious and accidentally harmful files.

use super::{SAMPLE, Suite};
use crate::suite::yaml::{Diagnostic, Source, read};
use rstest::rstest;
use serde::de::IgnoredAny;
use std::time::{Duration, Instant};

fn refused(yaml: &str) -> Diagnostic {
    let source = Source::from_text("hostile.yaml", yaml);
    source.and_then(|source| read::<IgnoredAny>(&source)).unwrap_err()
}

fn lines(count: usize, line: impl Fn(usize) -> String) -> String {
    (0..count).map(line).collect::<Vec<_>>().join("\n")
}

const DEEP: &str = "lists and maps nest more than 64 deep";

#[rstest]
#[case::huge("[".repeat(200_000), "the file is too large: 196 KiB, at most 64 KiB")]
#[case::flow_lists("[".repeat(60_000), DEEP)]
#[case::flow_maps("{a: ".repeat(16_000), DEEP)]
#[case::dashes("- ".repeat(30_000), DEEP)]
#[case::questions("? ".repeat(30_000), DEEP)]
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
#[case::long_list(format!("[{}]", "0,".repeat(1001)), "this list has more than 1000 entries")]
#[case::long_map(
    lines(1001, |n| format!("k{n}: 0")),
    "this map has more than 1000 entries"
)]
#[case::long_line(format!("a: {}: b", "x".repeat(65_000)), "`:` is not possible here")]
#[case::control("a: \u{1b}[2J".to_owned(), "character U+001B is not allowed")]
#[case::line_separator("a: \u{2028}b".to_owned(), "character U+2028 is not allowed")]
#[case::lone_return("a: 1\rb: 2".to_owned(), "character U+000D is not allowed")]
fn is_refused_at_once(#[case] yaml: String, #[case] message: &str) {
    let refuse = || {
        let start = Instant::now();
        let diagnostic = refused(&yaml);
        assert_eq!(diagnostic.message(), message);
        let shown = diagnostic.to_string();
        assert!(shown.lines().all(|line| line.chars().count() < 400), "{shown}");
        assert!(!shown.contains(['\u{1b}', '\r']));
        start.elapsed()
    };
    // One of several runs must be quick, because other processes may delay single runs.
    let is_quick = (0..20).any(|_| refuse() < Duration::from_millis(100));
    assert!(is_quick, "took a tenth of a second, twenty times");
}

#[test]
fn nesting_up_to_the_maximum_is_accepted() {
    let yaml = format!("{}{}", "[".repeat(64), "]".repeat(64));
    read::<IgnoredAny>(&Source::from_text("deep", yaml).unwrap()).unwrap();
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

//! Malicious files, and files that are harmful by accident, are refused immediately with a message.

use super::{BAD_INPUT, Folder, assert_contains};
use rstest::rstest;
use std::time::{Duration, Instant};

#[rstest]
#[case::fifty_megabytes("a".repeat(50_000_000).into_bytes(), "the file is too large: 48829 KiB, at most 64 KiB")]
#[case::deep_nesting("[".repeat(60_000).into_bytes(), "lists and maps nest more than 64 deep")]
#[case::an_alias_bomb(
    b"a: &a [x, x]\nb: &b [*a, *a]\nc: [*b, *b]\n".to_vec(),
    "anchors and aliases are not supported"
)]
#[case::not_text(b"suite: \xff\xfe\n".to_vec(), "the file is not UTF-8 text: byte 7 does not fit")]
#[case::nothing(Vec::new(), "the file is empty; a suite starts with `suite: NAME`")]
fn a_file_of(#[case] bytes: Vec<u8>, #[case] message: &str) {
    let folder = Folder::with("bad.yaml", bytes);
    for command in ["check", "run", "list", "explain"] {
        refused(&folder, &[command, "bad.yaml"], &[message, "bad.yaml"]);
    }
}

#[test]
fn folder_in_place_of_a_file_is_refused() {
    let folder = Folder::with("suites/bad.yaml/notes.txt", "");
    refused(&folder, &["check", "suites"], &["this is a folder, not a suite file", "bad.yaml"]);
}

#[test]
fn missing_file_is_refused() {
    let words = ["there is no such file", "missing.yaml"];
    refused(&Folder::new(), &["run", "missing.yaml"], &words);
}

/// Asserts exit status 2, an error message, no output, and no delay.
fn refused(folder: &Folder, arguments: &[&str], words: &[&str]) {
    let start = Instant::now();
    let found = folder.call(arguments);
    assert!(start.elapsed() < Duration::from_secs(1), "{:?}", start.elapsed());
    assert_eq!((found.code, found.out.as_str()), (BAD_INPUT, ""));
    assert_contains(&found.errors, words);
}

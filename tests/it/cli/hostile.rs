//! Malicious files, and files that are harmful by accident, are refused with a message.

use super::{BAD_INPUT, Folder, assert_contains};
use rstest::rstest;

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

/// Asserts exit status 2, an error message and no output.
fn refused(folder: &Folder, arguments: &[&str], words: &[&str]) {
    let found = folder.call(arguments);
    assert_eq!((found.code, found.out.as_str()), (BAD_INPUT, ""));
    assert_contains(&found.errors, words);
}

/// Creates a sound suite without expectations.
fn exploring() -> String {
    super::BAR[..super::BAR.find("expect:").expect("expectations")].to_owned()
}

/// Arguments and file names that are not UTF-8 are read, or refused with status 0 to 2.
#[cfg(unix)]
#[rstest]
#[case::suite(b"q\xff.yaml", None, 0)]
#[case::missing(b"r\xff.yaml", None, BAD_INPUT)]
#[case::folder(b"d\xff", None, 0)]
#[case::out(b"out\xff", Some("--out"), 0)]
#[case::resume(b"kept\xff", Some("--resume"), 0)]
fn arguments_that_are_not_utf8_do_not_panic(
    #[case] name: &[u8],
    #[case] option: Option<&str>,
    #[case] code: i32,
) {
    use std::os::unix::ffi::OsStrExt;
    let name = std::ffi::OsStr::from_bytes(name);
    let folder = Folder::with("good.yaml", super::on_one_grid(&exploring()));
    let text = folder.read("good.yaml");
    let inner = folder.path().join(std::ffi::OsStr::from_bytes(b"d\xff"));
    std::fs::create_dir(&inner).expect("a folder");
    let own = std::ffi::OsStr::from_bytes(b"q\xff.yaml");
    for place in [folder.path(), &inner] {
        std::fs::write(place.join(own), &text).expect("a file");
    }
    let mut command = folder.command(&["run", "--brief"]);
    match option {
        Some(option) => command.arg(option).arg(name).arg("good.yaml"),
        None => command.arg(name),
    };
    let output = command.output().expect("the program starts");
    assert_eq!(output.status.code(), Some(code), "{}", String::from_utf8_lossy(&output.stderr));
}

/// Characters that YAML does not treat as spaces are reported at their position.
#[rstest]
#[case::no_break_space("young:\u{a0}100", "character U+00A0 is not allowed")]
#[case::no_break_space_as_indentation("\n\u{a0}young: 100", "character U+00A0 is not allowed")]
#[case::zero_width_space("you\u{200b}ng: 100", "character U+200B is not allowed")]
#[case::decimal_comma("young: 0,05", "unknown key `05`")]
fn invisible_character_is_named(#[case] entry: &str, #[case] message: &str) {
    let text = exploring().replace("young: 100", entry);
    let folder = Folder::with("bad.yaml", text);
    let parts: &[&str] = if entry.contains(',') {
        &[message, "a decimal point"]
    } else {
        &[message, "an invisible character"]
    };
    refused(&folder, &["check", "bad.yaml"], parts);
}

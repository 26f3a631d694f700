//! Malicious files, and files that are harmful by accident, are refused with a message.

use super::{BAD_INPUT, Folder, assert_contains};
use rstest::rstest;

/// The tests of the YAML reader state the messages of other files.
#[test]
fn unreadable_file_is_refused_by_every_command() {
    let folder = Folder::with("bad.yaml", vec![b'a'; 50_000_000]);
    folder.write("suites/bad.yaml/notes.txt", "");
    for command in ["check", "run", "list", "explain"] {
        for (file, name, message) in [
            ("bad.yaml", "bad.yaml", "the file is too large: 48829 KiB, at most 64 KiB"),
            ("suites", "bad.yaml", "this is a folder, not a suite file"),
            ("missing.yaml", "missing.yaml", "there is no such file"),
        ] {
            refused(&folder, &[command, file], &[message, name]);
        }
    }
}

/// Asserts exit status 2, an error message and no output.
fn refused(folder: &Folder, arguments: &[&str], words: &[&str]) {
    let found = folder.call(arguments);
    assert_eq!((found.code, found.out.as_str()), (BAD_INPUT, ""));
    assert_contains(&found.errors, words);
}

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
#[case::no_break_space("young:\u{a0}100", "U+00A0 is not allowed", "an invisible character")]
#[case::indentation("\n\u{a0}young: 100", "U+00A0 is not allowed", "an invisible character")]
#[case::zero_width("you\u{200b}ng: 100", "U+200B is not allowed", "an invisible character")]
#[case::decimal_comma("young: 0,05", "unknown key `05`", "a decimal point")]
fn invisible_character_is_named(#[case] entry: &str, #[case] message: &str, #[case] help: &str) {
    let folder = Folder::with("bad.yaml", exploring().replace("young: 100", entry));
    refused(&folder, &["check", "bad.yaml"], &[message, help]);
}

//! Tests of invalid files.

use crate::suite::yaml::{Diagnostic, MAX_BYTES, Source};
use rstest::rstest;
use std::env::temp_dir;
use std::fs;
use std::path::{Path, PathBuf};

struct Temporary(PathBuf);

impl Temporary {
    fn new(name: &str) -> Self {
        Self(temp_dir().join(format!("mpm-verify-{}-{name}", std::process::id())))
    }

    fn holding(name: &str, bytes: &[u8]) -> Self {
        let temporary = Self::new(name);
        fs::write(&temporary.0, bytes).unwrap();
        temporary
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.0);
    }
}

fn refused(path: &Path) -> Diagnostic {
    let diagnostic = Source::read(path).unwrap_err();
    assert_eq!(diagnostic.file(), path.display().to_string());
    diagnostic
}

#[test]
fn valid_file_keeps_its_given_name() {
    let file = Temporary::holding("good.yaml", b"\xef\xbb\xbfsuite: bar\n");
    let source = Source::read(&file.0).unwrap();
    assert_eq!(source.name(), file.0.display().to_string());
    assert_eq!(source.text(), "suite: bar\n");
}

#[test]
fn missing_file_and_folder_are_refused() {
    let diagnostic = refused(Path::new("no/such.yaml"));
    assert_eq!(diagnostic.one_line(), "no/such.yaml: there is no such file");
    assert_eq!(refused(&temp_dir()).help(), Some("name a file in it"));
}

/// A named pipe is refused, because opening it without a writer would block.
#[cfg(unix)]
#[test]
fn a_named_pipe() {
    let pipe = Temporary::new("pipe.yaml");
    let made = std::process::Command::new("mkfifo").arg(&pipe.0).status();
    assert!(made.is_ok_and(|status| status.success()), "no `mkfifo`");
    let diagnostic = refused(&pipe.0);
    assert_eq!(diagnostic.message(), "this is a named pipe, not a suite file");
    let help = diagnostic.help().unwrap_or_default();
    assert!(help.contains("/dev/stdin"), "{help}");
}

#[cfg(unix)]
#[test]
fn an_endless_device_is_not_read_to_its_end() {
    let message = "the file is too large: at most 64 KiB";
    assert_eq!(refused(Path::new("/dev/zero")).message(), message);
}

#[test]
fn maximum_size_is_exact() {
    assert!(Source::from_text("full", "#".repeat(MAX_BYTES)).is_ok());
    let diagnostic = Source::from_text("over", "#".repeat(MAX_BYTES + 1)).unwrap_err();
    assert_eq!(diagnostic.one_line(), "over: the file is too large: 65 KiB, at most 64 KiB");
}

#[rstest]
#[case("latin", b"a: 1\nb: \xe9t\xe9\n", (2, 4), 8, "save the file as UTF-8")]
#[case("cut", b"a: \xc3", (1, 4), 3, "save the file as UTF-8")]
#[case("utf16", b"\xff\xfea\0:\0", (1, 1), 0, "save the file as UTF-8 (it looks like UTF-16)")]
fn not_utf8(
    #[case] name: &str,
    #[case] bytes: &[u8],
    #[case] place: (usize, usize),
    #[case] offset: usize,
    #[case] help: &str,
) {
    let file = Temporary::holding(name, bytes);
    let diagnostic = refused(&file.0);
    let found = diagnostic.place().unwrap();
    assert_eq!((found.line(), found.column()), place);
    let message = format!("the file is not UTF-8 text: byte {offset} does not fit");
    assert_eq!(diagnostic.message(), message);
    assert_eq!(diagnostic.help(), Some(help));
}

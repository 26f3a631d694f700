//! Standard output and standard error. All that is printed goes through here, so that what could
//! not be written is known in the end.

use super::colour;
use mpm_verify::suite::yaml::Diagnostic;
use std::io::{self, ErrorKind, Write};
use std::sync::OnceLock;

/// The first failure to write to standard output.
static FAILURE: OnceLock<String> = OnceLock::new();

/// Prints to standard output, with colours if that is a terminal.
pub(in crate::cli) fn print(text: &str) {
    let painted = colour::painted(text);
    note(anstream::stdout().lock(), painted.as_bytes());
}

/// Prints what need not be text.
pub(in crate::cli) fn print_bytes(bytes: &[u8]) {
    note(io::stdout().lock(), bytes);
}

/// Why something could not be printed, if so.
pub(in crate::cli) fn failure() -> Option<&'static str> {
    FAILURE.get().map(String::as_str)
}

/// Prints to standard error.
pub(in crate::cli) fn complain(text: &str) {
    let _ = writeln!(anstream::stderr().lock(), "{}", colour::painted(text.trim_end()));
}

/// Prints a diagnostic to standard error.
pub(in crate::cli) fn diagnose(diagnostic: &Diagnostic) {
    complain(&diagnostic.styled());
}

/// Keeps the outcome of what was written. A reader that has gone away (`mpm-verify | head`) is no
/// failure.
pub(in crate::cli) fn keep(outcome: io::Result<()>) {
    if let Err(error) = outcome
        && error.kind() != ErrorKind::BrokenPipe
    {
        FAILURE.get_or_init(|| format!("error: standard output cannot be written: {error}"));
    }
}

fn note(mut out: impl Write, bytes: &[u8]) {
    keep(out.write_all(bytes).and_then(|()| out.flush()));
}

//! Printing that survives a closed pipe.

use std::io::Write;

/// Prints to standard output. A reader that has gone away (`mpm-verify | head`) is no error.
pub(super) fn print(text: &str) {
    print_bytes(text.as_bytes());
}

/// The same with what need not be text.
pub(super) fn print_bytes(bytes: &[u8]) {
    let mut out = std::io::stdout().lock();
    let _ = out.write_all(bytes).and_then(|()| out.flush());
}

/// Prints to standard error.
pub(super) fn complain(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{}", text.trim_end());
}

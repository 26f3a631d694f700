//! Names of suites.

use crate::suite::evaluator::Evaluator;
use crate::suite::yaml::{Diagnostic, Path};

/// A name becomes part of test and file names.
pub(super) fn refuse_unusable_name(
    evaluator: &Evaluator<'_>,
    name: &str,
) -> Result<(), Diagnostic> {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if !name.is_empty() && name.len() <= 64 && name.chars().all(plain) {
        return Ok(());
    }
    let diagnostic = evaluator.diagnostic(&Path::top("suite"), "this is not a name for a suite");
    Err(diagnostic.with_label("expected lower-case letters, digits and hyphens, at most 64"))
}

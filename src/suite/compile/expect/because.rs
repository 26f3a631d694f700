//! The reason that a claim of a suite states.

use crate::suite::evaluator::Evaluator;
use crate::suite::yaml::{Diagnostic, Path};

/// The reason that stands at `path` for what is `stated` there, which must say something.
pub(crate) fn because(
    evaluator: &Evaluator<'_>,
    path: &Path,
    stated: &str,
    text: &str,
) -> Result<String, Diagnostic> {
    let text = text.trim();
    if !text.is_empty() {
        return Ok(text.to_owned());
    }
    let message = format!("{stated} needs its reason");
    let diagnostic = evaluator.diagnostic(&path.then("because"), &message);
    Err(diagnostic.with_label("expected words"))
}

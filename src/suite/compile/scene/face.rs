//! Faces of the body, by name.

use crate::suite::evaluator::{Evaluator, suggestion};
use crate::suite::model::scene::FACES;
use crate::suite::yaml::{Diagnostic, Path};

/// Number of the face that a suite calls `name`; the name is a key or a value of the file.
pub(crate) fn face(
    evaluator: &Evaluator<'_>,
    path: &Path,
    name: &str,
    dimension: usize,
    is_key: bool,
) -> Result<usize, Diagnostic> {
    let known = &FACES[..2 * dimension];
    known.iter().position(|face| *face == name).ok_or_else(|| {
        let message = format!("a body of dimension {dimension} has no face `{name}`");
        let diagnostic = if is_key {
            evaluator.diagnostic_at_key(path, &message)
        } else {
            evaluator.diagnostic(path, &message)
        };
        diagnostic.with_help(&suggestion("faces", name, known))
    })
}

//! Boxes, from words.

use super::lengths::{LONGEST, SHORTEST};
use crate::suite::evaluator::{Evaluator, shown};
use crate::suite::grammar::BoxSpec;
use crate::suite::yaml::{Diagnostic, Path};

/// Lowest and highest corner of a box.
///
/// # Errors
/// A complaint about a box that is empty, too small or too large.
pub(crate) fn corners(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &BoxSpec,
    dimension: usize,
) -> Result<(Vec<f64>, Vec<f64>), Diagnostic> {
    let from = evaluator.point(&path.then("from"), &words.from, dimension)?;
    let to = evaluator.point(&path.then("to"), &words.to, dimension)?;
    for axis in 0..dimension {
        if !(from[axis] < to[axis]) {
            let (from, to) = (shown(from[axis]), shown(to[axis]));
            let message = format!("the box ends at {to} and starts at {from}");
            let diagnostic = evaluator.diagnostic(&path.then("to").then(axis), &message);
            return Err(diagnostic.with_label("expected a number above that of `from`"));
        }
        // Squares of lengths appear in second derivatives, cubes in volumes.
        let length = to[axis] - from[axis];
        if !(SHORTEST..=LONGEST).contains(&length) {
            let message = format!("the box is {} m long", shown(length));
            let diagnostic = evaluator.diagnostic(&path.then("to").then(axis), &message);
            let label = format!("expected a length from {SHORTEST:e} to {LONGEST:e}");
            return Err(diagnostic.with_label(&label));
        }
    }
    Ok((from, to))
}

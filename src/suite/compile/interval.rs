//! Two ends, the lower one first.

use crate::suite::evaluator::Evaluator;
use crate::suite::yaml::{Diagnostic, NumberText, Path};

/// Two ends, the lower one first.
pub(crate) fn interval(
    evaluator: &Evaluator<'_>,
    path: &Path,
    pair: &[NumberText],
) -> Result<(f64, f64), Diagnostic> {
    let [low, high] = pair else {
        let diagnostic = evaluator.diagnostic(path, "an interval has two ends");
        return Err(diagnostic.with_label("expected [low, high]"));
    };
    let low = evaluator.number(&path.then(0), low)?;
    let high = evaluator.number(&path.then(1), high)?;
    if low <= high {
        return Ok((low, high));
    }
    let message = format!("the interval ends at {high} and starts at {low}");
    Err(evaluator.diagnostic(path, &message).with_label("expected [low, high]"))
}

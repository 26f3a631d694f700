//! Two ends, the lower one first.

use super::{evaluator::Binder, path::Path};
use crate::suite::yaml::{Complaint, NumberText};

/// Two ends, the lower one first.
pub(crate) fn interval(
    binder: &Binder<'_>,
    path: &Path,
    pair: &[NumberText],
) -> Result<(f64, f64), Complaint> {
    let [low, high] = pair else {
        let complaint = binder.complain(path, "an interval has two ends");
        return Err(complaint.with_label("expected [low, high]"));
    };
    let low = binder.number(&path.then(0), low)?;
    let high = binder.number(&path.then(1), high)?;
    if low <= high {
        return Ok((low, high));
    }
    let message = format!("the interval ends at {high} and starts at {low}");
    Err(binder.complain(path, &message).with_label("expected [low, high]"))
}

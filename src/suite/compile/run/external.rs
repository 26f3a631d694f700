//! An entry of `methods` for a solver that is not of this crate.

use crate::subject::{HIGHEST_ORDER, LONGEST_NAME, is_solver_name};
use crate::suite::evaluator::{Evaluator, shown};
use crate::suite::yaml::{Diagnostic, NumberText, Path};

/// The name of a solver.
pub(super) fn solver_name(
    evaluator: &Evaluator<'_>,
    path: &Path,
    name: &str,
) -> Result<String, Diagnostic> {
    if is_solver_name(name) {
        return Ok(name.to_owned());
    }
    let diagnostic = evaluator.diagnostic(&path.then("name"), "this is not a name for a solver");
    let label = format!("expected up to {LONGEST_NAME} letters, digits, `-`, `_` or `.`");
    Err(diagnostic.with_label(&label))
}

/// The order that theory gives a solver: two, unless it is stated.
pub(super) fn formal_order(
    evaluator: &Evaluator<'_>,
    path: &Path,
    text: Option<&NumberText>,
) -> Result<f64, Diagnostic> {
    let (Some(text), path) = (text, path.then("formal_order")) else { return Ok(2.0) };
    let order = evaluator.positive(&path, text, "the formal order")?;
    if order <= HIGHEST_ORDER {
        return Ok(order);
    }
    let message = format!("the formal order is {}", shown(order));
    let diagnostic = evaluator.diagnostic(&path, &message);
    Err(diagnostic.with_label(&format!("expected one up to {HIGHEST_ORDER}")))
}

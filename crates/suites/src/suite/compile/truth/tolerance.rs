//! Tolerances of exact and linearised solutions.

use crate::exact::{Linearised, Problem, Violation};
use crate::suite::evaluator::SuitePath;
use crate::suite::grammar::ExactSpec;
use crate::suite::yaml::{Diagnostic, NumberText};

/// Default tolerance (relative residual), above the rounding errors of second derivatives.
pub(crate) const TOLERANCE: f64 = 1e-8;

const MOST: f64 = 1e-2;

pub(crate) fn tolerance(
    path: &SuitePath<'_>,
    text: Option<&NumberText>,
) -> Result<f64, Diagnostic> {
    let Some(text) = text else { return Ok(TOLERANCE) };
    let path = path.then("tolerance");
    let tolerance = path.positive(text, "the tolerance")?;
    if tolerance <= MOST {
        return Ok(tolerance);
    }
    let message = format!("a tolerance of {tolerance} would let a wrong solution pass");
    path.expected("at most 1e-2", &message)
}

pub(crate) fn tolerances(
    path: &SuitePath<'_>,
    spec: &ExactSpec,
) -> Result<(f64, Option<Linearised>), Diagnostic> {
    let exact = tolerance(path, spec.tolerance.as_ref())?;
    let Some(spec) = &spec.linearised else { return Ok((exact, None)) };
    let path = path.then("linearised");
    let tolerance = tolerance(&path, Some(&spec.tolerance))?;
    let because = path.because("this linearised solution", &spec.because)?;
    Ok((exact, Some(Linearised { tolerance, because })))
}

/// Returns the diagnostic about a violation in `problem`. The message includes the residual of the
/// law if the suite has the key `linearised`, or if this key could make the suite valid.
pub(crate) fn violated(
    path: &SuitePath<'_>,
    problem: &Problem,
    violation: &Violation,
) -> Diagnostic {
    let tolerance = if problem.linearised.is_none() { problem.tolerance } else { f64::INFINITY };
    let diagnostic = no_solution(path, violation, tolerance);
    let left = problem.residual();
    match &problem.linearised {
        Some(stated) if left > stated.tolerance => {
            let allowed = stated.tolerance;
            let found = format!("the residual is {left:.2e} of the terms of the equations");
            diagnostic
                .with_label(&format!("{found}, above the stated `tolerance` of {allowed:.2e}"))
        }
        None if problem.equation.is_finite() && left > problem.tolerance && left <= MOST => {
            let help = format!(
                "correct the formula, or the scene; if the solution is linearised (its residual is \
                 {left:.2e} of the terms of the equations), add `linearised: {{tolerance: ..., \
                 because: ...}}`"
            );
            diagnostic.with_help(&help)
        }
        _ => diagnostic,
    }
}

/// Maximum relative residual that rounding or a truncated series can explain.
const ROUNDING: f64 = 1e-5;

pub(crate) fn if_rounded(violation: &Violation, tolerance: f64) -> String {
    match violation.accepted_by(tolerance) {
        Some(accepted) if accepted <= ROUNDING => format!(
            "; if the formula is exact to {accepted:.0e} of its largest term only, state \
             `tolerance: {:.0e}` next to it",
            2.0 * accepted
        ),
        _ => String::new(),
    }
}

pub(crate) fn no_solution(
    path: &SuitePath<'_>,
    violation: &Violation,
    tolerance: f64,
) -> Diagnostic {
    let rounded = if_rounded(violation, tolerance);
    let diagnostic = path.then("displacement").then(0).diagnostic(&violation.to_string());
    diagnostic.with_label("this is not a solution of the problem that the scene states").with_help(
        &format!("correct the formula, or the scene: loads, boundary, initial state{rounded}"),
    )
}

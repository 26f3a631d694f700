//! A tolerance for a linearised solution that needs none, or one that is far smaller.

use super::subject::Preflight;
use crate::suite::compile::truth::tolerance::TOLERANCE;
use crate::suite::yaml::{Diagnostic, Severity};

/// Residuals that the tolerance may be worth, before another solution would pass.
const MOST: f64 = 100.0;

/// Notes a tolerance that is larger than what the solution leaves by orders of magnitude.
pub(crate) fn check(preflight: &Preflight<'_>) -> Vec<Diagnostic> {
    let Some(problem) = &preflight.plan.exact else { return Vec::new() };
    let Some(stated) = &problem.linearised else { return Vec::new() };
    let (left, allowed) = (problem.residual(), stated.tolerance);
    let help = if left <= TOLERANCE {
        "nothing is left of the law but rounding: remove `linearised`".to_owned()
    } else if allowed > MOST * left {
        let enough: f64 = format!("{:.0e}", 2.0 * left).parse().unwrap_or(left);
        format!("{enough:e} is enough, and lets fewer wrong solutions pass")
    } else {
        return Vec::new();
    };
    let message = format!(
        "{allowed:.1e} of the terms of the equations may be left, and the solution leaves {left:.1e}"
    );
    let path = preflight.truth().then("linearised").then("tolerance");
    vec![preflight.finding(Severity::Note, &path, &message).with_help(&help)]
}

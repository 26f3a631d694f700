//! A suite from its parts.

use super::evaluator::{DeclaredParameter, Evaluator};
use super::path::Path;
use crate::suite::model::Suite;
use crate::suite::model::study_plan::StudyPlan;
use crate::suite::yaml::{Diagnostic, Ordered};
use std::sync::Arc;

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

/// A suite with this name, title, source and text about it.
pub(super) fn assemble(
    [name, title, source, about]: [String; 4],
    parameters: Vec<DeclaredParameter>,
    functions: &Ordered<String>,
    plan: impl StudyPlan,
) -> Suite {
    let (functions, study) = (functions.as_slice().to_vec(), Arc::new(plan));
    let group = String::new();
    Suite { name, group, title, source, about, parameters, functions, study, fingerprint: 0 }
}

//! A suite from its parts.

use crate::suite::evaluator::DeclaredParameter;
use crate::suite::model::Suite;
use crate::suite::model::study_plan::StudyPlan;
use crate::suite::yaml::Ordered;
use std::sync::Arc;

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

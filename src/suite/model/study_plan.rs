//! Plan of a study, of any kind.

use super::method::{ExternalMethod, GateTerms};
use std::any::Any;
use std::fmt::Debug;
use std::sync::Arc;

/// Checked values of one kind of study.
pub trait StudyPlan: Any + Debug + Send + Sync {
    /// Names of the cases, in order.
    fn case_names(&self) -> Vec<&str>;

    /// Summary of the expectation of the case with this index, and its reason; `None` if the suite
    /// explores.
    ///
    /// # Panics
    /// If there is no such case.
    fn expectation(&self, case: usize) -> Option<(String, &str)>;

    /// This study with only the cases for whose index `keep` returns true.
    fn only(&self, keep: &dyn Fn(usize) -> bool) -> Arc<dyn StudyPlan>;

    /// The study with an external solver in place of its methods, gated on `terms`, if any; `None`
    /// for a study of the inside of a method.
    fn of_external(
        &self,
        _solver: ExternalMethod<'_>,
        _terms: Option<&GateTerms>,
    ) -> Option<Arc<dyn StudyPlan>> {
        None
    }
}

/// The members of a list for whose index `keep` returns true.
pub(super) fn kept<T: Clone>(all: &[T], keep: &dyn Fn(usize) -> bool) -> Vec<T> {
    let kept = all.iter().enumerate().filter(|(i, _)| keep(*i));
    kept.map(|(_, member)| member.clone()).collect()
}

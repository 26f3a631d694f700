//! Plan of a study, of any kind.

use std::any::Any;
use std::fmt::Debug;

/// Checked values of one kind of study.
pub trait StudyPlan: Any + Debug + Send + Sync {
    /// Names of the cases, in order.
    fn case_names(&self) -> Vec<&str>;

    /// Summary of the expectation of the case with this index, and the suite's reason for it; none
    /// of a suite that explores.
    ///
    /// # Panics
    /// If there is no such case.
    fn expectation(&self, case: usize) -> Option<(String, &str)>;
}

//! The interface of results of a kind of study.

use std::any::Any;
use std::fmt::Debug;

/// Results of one kind of study. What shows them is listed in `report::study`.
pub trait StudyResults: Any + Debug + Send + Sync {
    /// Whether the method fails at the problem, be that expected of it or not.
    fn fails(&self) -> bool {
        false
    }
}

//! The interface of a kind of study in reports.

use crate::report::figure::drawing::Figure;
use crate::verify::{CaseOutcome, SuiteOutcome};
use serde_json::{Map, Value};

/// How the results of one kind of study are shown; cases of other kinds add nothing.
pub(crate) trait StudyReport: Sync {
    /// Lines about all cases of a suite.
    fn overview(&self, _lines: &mut Vec<String>, _outcome: &SuiteOutcome) {}

    /// Tables of one case.
    fn tables(&self, lines: &mut Vec<String>, case: &CaseOutcome);

    /// Keys of one case in JSON, null where the case is of another kind.
    fn json(&self, case: &CaseOutcome) -> Map<String, Value>;

    /// Figures of a suite.
    fn figures(&self, outcome: &SuiteOutcome) -> Vec<Figure>;
}

/// The members of an object that `json!` makes.
pub(crate) fn members(object: Value) -> Map<String, Value> {
    match object {
        Value::Object(members) => members,
        _ => Map::new(),
    }
}

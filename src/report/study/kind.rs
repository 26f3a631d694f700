//! The interface of a kind of study in reports.

use crate::report::figure::drawing::Figure;
use crate::verify::{CaseOutcome, StudyResults, SuiteOutcome};
use serde_json::{Map, Value};

/// How the results of one kind of study are shown; cases of other kinds add nothing.
pub(crate) trait StudyReport: Sync {
    /// Tables of all cases of a suite.
    fn tables(&self, lines: &mut Vec<String>, cases: &[CaseOutcome]);

    /// Remarks on one case that no table has.
    fn remarks(&self, _case: &CaseOutcome) -> Vec<String> {
        Vec::new()
    }

    /// Keys of one case in JSON, null where the case is of another kind.
    fn json(&self, case: &CaseOutcome) -> Map<String, Value>;

    /// Figures of a suite.
    fn figures(&self, outcome: &SuiteOutcome) -> Vec<Figure>;
}

/// Studies of one kind, with the names of their cases.
pub(crate) fn studies<R: StudyResults>(cases: &[CaseOutcome]) -> Vec<(&str, &R)> {
    cases.iter().filter_map(|case| Some((case.case.as_str(), case.results()?))).collect()
}

/// The members of an object that `json!` makes.
pub(crate) fn members(object: Value) -> Map<String, Value> {
    match object {
        Value::Object(members) => members,
        _ => Map::new(),
    }
}

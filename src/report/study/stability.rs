//! Stability studies in reports.

use super::kind::{StudyReport, members};
use crate::report::figure::drawing::Figure;
use crate::report::figure::sweep;
use crate::report::json::stability::study;
use crate::report::text::stability;
use crate::verify::{CaseOutcome, SuiteOutcome};
use serde_json::{Map, Value, json};

/// Shows [`StabilityStudy`](crate::verify::StabilityStudy).
pub(crate) struct StabilityReport;

impl StudyReport for StabilityReport {
    fn overview(&self, lines: &mut Vec<String>, outcome: &SuiteOutcome) {
        stability::overview(lines, outcome);
    }

    fn tables(&self, lines: &mut Vec<String>, case: &CaseOutcome) {
        if let Some(results) = case.results() {
            stability::tables(lines, results);
        }
    }

    fn json(&self, case: &CaseOutcome) -> Map<String, Value> {
        members(json!({"stability": case.results().map(study)}))
    }

    fn figures(&self, outcome: &SuiteOutcome) -> Vec<Figure> {
        let map = stability::map(outcome).map(|svg| (format!("{}.svg", outcome.suite), svg));
        let named = map.into_iter().chain(sweep::figures(outcome));
        named.map(|(file, svg)| Figure { file, svg }).collect()
    }
}

//! Stability studies in reports.

use super::kind::{StudyReport, members, studies};
use crate::report::figure::drawing::Figure;
use crate::report::figure::sweep;
use crate::report::json::stability::study;
use crate::report::text::stability;
use crate::verify::{CaseOutcome, SuiteOutcome};
use serde_json::{Map, Value, json};

/// Shows [`StabilityStudy`](crate::verify::StabilityStudy).
pub(crate) struct StabilityReport;

impl StudyReport for StabilityReport {
    fn tables(&self, lines: &mut Vec<String>, cases: &[CaseOutcome]) {
        stability::tables(lines, &studies(cases));
    }

    fn remarks(&self, case: &CaseOutcome) -> Vec<String> {
        case.results().map_or(Vec::new(), stability::remarks)
    }

    fn json(&self, case: &CaseOutcome) -> Map<String, Value> {
        members(json!({"stability": case.results().map(study)}))
    }

    fn figures(&self, outcome: &SuiteOutcome) -> Vec<Figure> {
        let limits = stability::map(outcome).map(|map| Figure {
            file: format!("{}.svg", outcome.suite),
            svg: map.to_svg(),
            pgfplots: map.to_pgfplots(),
        });
        limits.into_iter().chain(sweep::figures(outcome)).collect()
    }
}

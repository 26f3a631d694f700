//! Internal-force studies in reports.

use super::kind::{StudyReport, members};
use crate::report::columns::{force, json_object};
use crate::report::figure::drawing::Figure;
use crate::report::figure::study;
use crate::report::text::table::Table;
use crate::verify::{CaseOutcome, InternalForce, SuiteOutcome};
use serde_json::{Map, Value, json};

/// Shows [`InternalForce`].
pub(crate) struct InternalForceReport;

impl StudyReport for InternalForceReport {
    fn tables(&self, lines: &mut Vec<String>, cases: &[CaseOutcome]) {
        for case in cases {
            if let Some(InternalForce { rows }) = case.results() {
                lines.extend([String::new(), format!("  {}", case.case)]);
                lines.extend(Table::new(&force::columns(), rows).lines());
            }
        }
    }

    fn json(&self, case: &CaseOutcome) -> Map<String, Value> {
        let study: Option<&InternalForce> = case.results();
        let columns = force::columns();
        let objects = |study: &InternalForce| -> Value {
            study.rows.iter().map(|row| json_object(&columns, row)).collect()
        };
        members(json!({"forces": study.map(objects)}))
    }

    fn figures(&self, outcome: &SuiteOutcome) -> Vec<Figure> {
        study::forces(outcome).into_iter().collect()
    }
}

//! A diagnosis as JSON.

use super::number::{interval, number};
use crate::report::text::diagnosis::paragraph;
use crate::verify::{ChangedRun, Diagnosis};
use serde_json::{Value, json};

/// The finding on one case: the paragraph of the text, and the runs behind it.
pub fn diagnosis_json(found: &Diagnosis) -> Value {
    let run = |run: &ChangedRun| {
        json!({
            "change": run.change,
            "cause": run.cause,
            "remedy": run.remedy,
            "verdict": run.verdict.name(),
            "order": run.order.map(interval),
            "ratio": number(run.ratio),
        })
    };
    json!({
        "case": found.case,
        "formal_order": number(found.formal_order),
        "verdict": found.judgement.verdict.name(),
        "sound": found.is_sound(),
        "finding": paragraph(found),
        "cause": found.found().map(|(run, _)| run.cause),
        "remedy": found.found().map(|(run, _)| run.remedy),
        "levels": found.levels,
        "runs": found.runs.iter().map(run).collect::<Vec<_>>(),
        "beyond_budget": found.skipped,
    })
}

//! A diagnosis as JSON.

use crate::report::columns::{interval, number};
use crate::report::text::diagnosis::paragraph;
use crate::verify::{Cause, ChangedRun, Diagnosis};
use serde_json::{Value, json};

/// The diagnosis of one case: the paragraph of the text, and its runs.
pub fn diagnosis_json(found: &Diagnosis) -> Value {
    // The ratio to an error that is not finite is undefined.
    let finite = |ratio: f64| Some(ratio).filter(|ratio| ratio.is_finite());
    let run = |run: &ChangedRun| {
        json!({
            "change": run.change,
            "cause": run.cause,
            "remedy": run.remedy,
            "verdict": run.verdict.name(),
            "order": run.order.map(interval),
            "error": number(run.error),
            "ratio": finite(run.ratio),
            "relative_ratio": finite(run.relative_ratio),
        })
    };
    let causes = found.causes();
    let cause = |cause: &Cause<'_>| json!({"cause": cause.cause(), "remedy": cause.remedy()});
    json!({
        "case": found.case,
        "formal_order": number(found.formal_order),
        "verdict": found.judgement.verdict.name(),
        "sound": found.is_sound(),
        "finding": paragraph(found),
        "cause": causes.first().map(Cause::cause),
        "remedy": causes.first().and_then(Cause::remedy),
        "causes": causes.iter().map(cause).collect::<Vec<_>>(),
        "levels": found.levels,
        "runs": found.runs.iter().map(run).collect::<Vec<_>>(),
        "beyond_budget": found.skipped,
    })
}

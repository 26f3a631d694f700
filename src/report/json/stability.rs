//! Stability studies in the JSON document.

use super::number::number;
use crate::verify::{Critical, RunFigure, StabilityLimit, StabilityRow, StabilityStudy, Trial};
use serde_json::{Map, Value, json};

/// The rows of a study.
pub(crate) fn study(study: &StabilityStudy) -> Value {
    json!({
        "swept": study.swept,
        "sought": study.sought,
        "rows": study.rows.iter().map(row).collect::<Vec<_>>(),
    })
}

fn row(row: &StabilityRow) -> Value {
    let critical = row.critical.as_ref();
    json!({
        "value": number(row.value),
        "run": row.trial.as_ref().map(run),
        "predicted": critical.and_then(|critical| critical.predicted).map(|p| limit(p.limit)),
        "observed": critical.and_then(|critical| critical.observed).map(limit),
        "confirmed": critical.map(confirmed),
        "refused": row.refused,
    })
}

fn run(trial: &Trial) -> Value {
    let figure = |figure: &RunFigure| (figure.name().to_owned(), number(figure.of(trial)));
    json!({
        "verdict": trial.verdict.name(),
        "why": trial.why,
        "figures": RunFigure::ALL.iter().map(figure).collect::<Map<_, _>>(),
    })
}

fn limit(limit: StabilityLimit) -> Value {
    let (side, value) = match limit {
        StabilityLimit::At(value) => ("at", value),
        StabilityLimit::Above(value) => ("above", value),
        StabilityLimit::Below(value) => ("below", value),
    };
    json!({ side: number(value) })
}

fn confirmed(critical: &Critical) -> Value {
    let run = |(share, trial): &(f64, Trial)| json!({"share": number(*share), "verdict": trial.verdict.name(), "steps": trial.steps});
    critical.confirmed.iter().map(run).collect()
}

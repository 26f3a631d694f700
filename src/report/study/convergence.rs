//! Convergence studies in reports.

use super::kind::{StudyReport, members};
use crate::report::columns::{json_object, level};
use crate::report::figure::drawing::Figure;
use crate::report::figure::study;
use crate::report::json::number::number;
use crate::report::text::levels;
use crate::report::text::prose::row;
use crate::verify::{
    Axis, CaseOutcome, Convergence, Floor, FloorCause, Interval, LevelOutcome, Probe, SuiteOutcome,
};
use serde_json::{Map, Value, json};

/// Shows [`Convergence`].
pub(crate) struct ConvergenceReport;

impl StudyReport for ConvergenceReport {
    fn tables(&self, lines: &mut Vec<String>, case: &CaseOutcome) {
        if let Some(study) = case.convergence() {
            tables(lines, study);
        }
    }

    fn json(&self, case: &CaseOutcome) -> Map<String, Value> {
        let study = case.convergence();
        let columns = level::json_columns();
        let levels = study.into_iter().flat_map(level::rows);
        members(json!({
            "axis": study.map(|study| study.axis.name()),
            "formal_order": study
                .filter(|study| study.axis != Axis::Particles)
                .map(|study| number(study.formal_order)),
            "judge": study.filter(|study| study.compared).map(judge),
            "observed_order": study.and_then(|study| study.judgement.order).map(interval),
            "floor": study.and_then(|study| study.floor.as_ref()).map(floor),
            "levels": levels.map(|row| json_object(&columns, &row)).collect::<Vec<_>>(),
        }))
    }

    fn figures(&self, outcome: &SuiteOutcome) -> Vec<Figure> {
        study::figures(outcome)
    }
}

fn tables(lines: &mut Vec<String>, study: &Convergence) {
    levels::tables(lines, study);
    let too_long: Vec<String> = study
        .levels
        .iter()
        .filter(|level| level.is_too_long())
        .map(|level| level.name(study.axis))
        .collect();
    if !too_long.is_empty() {
        lines.push(String::new());
        let text = "steps are longer than the stable time step";
        row(lines, "warning", &format!("{}: {text}", too_long.join(", ")));
    }
    let failure = |level: &LevelOutcome| Some((level.name(study.axis), level.run.failure.clone()?));
    for (level, failure) in study.levels.iter().filter_map(failure) {
        lines.push(String::new());
        row(lines, "failure", &format!("{level}: {failure}"));
    }
    if let Some(lost) = order_lost(study) {
        lines.push(String::new());
        row(lines, "crossing", &lost);
    }
}

/// Where particles begin to change their cell, and what that does to the order.
fn order_lost(study: &Convergence) -> Option<String> {
    let first = study.levels.iter().find(|level| level.run.counters.crossings.unwrap_or(0) > 0)?;
    let crossings = first.run.counters.crossings?;
    let finest = study.levels.last()?;
    if study.levels.len() == 1 {
        return Some(format!("particles change their cell {crossings} times"));
    }
    let pair = |level: &LevelOutcome| {
        level.order.map_or("no order".to_owned(), |order| format!("order {order:.2}"))
    };
    Some(format!(
        "particles change their cell from {} on ({crossings} crossings, {} against the next \
         coarser level); on the finest level, {}, {} crossings and {}",
        first.name(study.axis),
        pair(first),
        finest.name(study.axis),
        finest.run.counters.crossings.unwrap_or(0),
        pair(finest),
    ))
}

/// Quantity and norm of the judged errors, and what they are divided by.
fn judge(study: &Convergence) -> Value {
    json!({"of": study.of.name(), "norm": study.norm, "scale": study.scale.map(number)})
}

fn interval(order: Interval) -> Value {
    json!({"value": number(order.value), "low": number(order.low), "high": number(order.high)})
}

fn floor(floor: &Floor) -> Value {
    let probe = |probe: &Probe| {
        json!({
            "axis": probe.axis.name(),
            "error": probe.error.as_ref().ok().copied().map(number),
            "failure": probe.error.as_ref().err(),
        })
    };
    json!({
        "cause": floor.cause().map(FloorCause::name),
        "error": number(floor.error),
        "probes": floor.probes.iter().map(probe).collect::<Vec<_>>(),
    })
}

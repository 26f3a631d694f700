//! Convergence studies in reports.

use super::kind::{StudyReport, members, studies};
use crate::report::columns::number::{interval, number};
use crate::report::columns::{json_object, level};
use crate::report::figure::drawing::Figure;
use crate::report::figure::study;
use crate::report::text::levels;
use crate::verify::{
    Axis, CaseOutcome, Convergence, Floor, FloorCause, LevelOutcome, Probe, SuiteOutcome,
};
use serde_json::{Map, Value, json};

/// Shows [`Convergence`].
pub(crate) struct ConvergenceReport;

impl StudyReport for ConvergenceReport {
    fn tables(&self, lines: &mut Vec<String>, cases: &[CaseOutcome]) {
        levels::tables(lines, &studies(cases));
    }

    fn remarks(&self, case: &CaseOutcome) -> Vec<String> {
        case.convergence().map_or(Vec::new(), remarks)
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

/// Steps that are too long, runs that broke, and whose error a floor is.
fn remarks(study: &Convergence) -> Vec<String> {
    let too_long = study.levels.iter().filter(|level| level.is_too_long());
    let too_long: Vec<String> = too_long.map(|level| level.name(study.axis)).collect();
    let too_long = (!too_long.is_empty())
        .then(|| format!("steps are longer than the stable time step: {}", too_long.join(", ")));
    let failure = |level: &LevelOutcome| {
        Some(format!("{}: {}", level.name(study.axis), level.run.failure.clone()?))
    };
    let failures = study.levels.iter().filter_map(failure);
    let floor = study.floor.iter().filter(|floor| !floor.probes.is_empty()).map(Floor::sentence);
    too_long.into_iter().chain(failures).chain(floor).collect()
}

/// Quantity and norm of the judged errors, and what they are divided by.
fn judge(study: &Convergence) -> Value {
    json!({"of": study.of.name(), "norm": study.norm.name(), "scale": study.scale.map(number)})
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

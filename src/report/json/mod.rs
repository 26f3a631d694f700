//! Reports as JSON, an interface for programs.

pub(crate) mod schema;
use crate::report::columns::cost::json_columns as cost_columns;
use crate::report::columns::timed_level::{json_columns as timed_columns, rows, timing};
use crate::report::columns::{interval, json_objects, number};
use crate::report::text::diagnosis::paragraph;
use crate::verify::{CaseOutcome, Cause, ChangedRun, Diagnosis, Ranking, TimedSuite, by_transfers};
use serde_json::{Value, json};

/// Converts rankings to JSON, one entry for each problem. `work` is the name of the unit of work.
pub(crate) fn rankings(rankings: &[Ranking], work: &str) -> Vec<Value> {
    let ranking = |ranking: &Ranking| {
        json!({
            "problem": ranking.problem,
            "size": number(ranking.size),
            "work": work,
            "targets": ranking.targets,
            "methods": json_objects(&cost_columns(ranking), &ranking.rows),
        })
    };
    rankings.iter().map(ranking).collect()
}

/// Converts the diagnosis of one case to JSON: the paragraph of the text report, and the runs.
pub fn diagnosis_json(found: &Diagnosis) -> Value {
    // The ratio is undefined if an error is not finite or if the reference error is zero.
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

/// Creates the JSON document, indented and with a final newline.
pub fn timed_json(timed: &[TimedSuite]) -> String {
    let suites = timed.iter().map(suite).collect::<Vec<_>>();
    format!("{:#}\n", json!({ "suites": suites }))
}

fn suite(timed: &TimedSuite) -> Value {
    let machine = &timed.machine;
    let case = |(index, case): (usize, &CaseOutcome)| {
        json!({
            "case": case.case,
            "levels": json_objects(&timed_columns(), rows(timed, index)),
        })
    };
    let cases = timed.outcome.cases.iter().enumerate();
    let mut cost = rankings(&timed.by_seconds(), "seconds");
    cost.extend(rankings(&by_transfers(&timed.outcome.cases), "transfers"));
    json!({
        "suite": timed.outcome.suite,
        "machine": {
            "cores": machine.cores,
            "load": machine.load.map(|load| load.map(number)),
            "waited": machine.waited.map(number),
            "fixed_loop": machine.fixed_loop.map(timing),
        },
        "cases": cases.map(case).collect::<Vec<_>>(),
        "cost": cost,
    })
}

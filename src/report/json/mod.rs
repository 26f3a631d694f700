//! Reports as JSON, an interface for programs.

pub(crate) mod schema;
use crate::report::columns::cost::{json_columns as cost_columns, model, models};
use crate::report::columns::timed_level::{json_columns as timed_columns, rows, timing};
use crate::report::columns::{interval, json_object, number};
use crate::report::text::diagnosis::paragraph;
use crate::verify::{
    BestCandidate, CaseOutcome, Cause, ChangedRun, Diagnosis, Machine, Ranking, TimedSuite,
};
use serde_json::{Value, json};

/// Converts rankings to JSON, one entry for each problem. `work` is the name of the unit of work.
pub(crate) fn rankings(rankings: &[Ranking], work: &str) -> Value {
    let ranking = |ranking: &Ranking| {
        let columns = cost_columns(ranking);
        json!({
            "problem": ranking.problem,
            "size": number(ranking.size),
            "work": work,
            "targets": ranking.targets,
            "methods": ranking.rows.iter().map(|row| json_object(&columns, row)).collect::<Vec<_>>(),
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

/// Creates the JSON document, indented and with a final newline. `best` contains names of suites
/// with their best candidates.
pub fn timed_json(timed: &[TimedSuite], best: &[(String, BestCandidate)]) -> String {
    let suites = timed.iter().map(suite).chain(best.iter().map(|(name, found)| {
        json!({"suite": name, "machine": null, "cases": [], "cost": [], "best_candidate": candidate(found)})
    }));
    format!("{:#}\n", json!({ "suites": suites.collect::<Vec<_>>() }))
}

fn suite(timed: &TimedSuite) -> Value {
    let cases = timed.outcome.cases.iter().enumerate();
    let ranked = [
        (rankings(&timed.by_seconds(), "seconds")),
        (rankings(&timed.by_transfers(), "transfers")),
    ];
    let cost: Vec<Value> = ranked.iter().filter_map(Value::as_array).flatten().cloned().collect();
    json!({
        "suite": timed.outcome.suite,
        "machine": machine(&timed.machine),
        "cases": cases.map(|(index, one)| case(timed, index, one)).collect::<Vec<_>>(),
        "cost": cost,
        "best_candidate": null,
    })
}

fn machine(machine: &Machine) -> Value {
    json!({
        "cores": machine.cores,
        "load": machine.load.map(|load| load.map(number)),
        "waited": machine.waited.map(number),
        "fixed_loop": machine.fixed_loop.map(timing),
    })
}

fn case(timed: &TimedSuite, index: usize, case: &CaseOutcome) -> Value {
    let columns = timed_columns();
    let fitted = timed.model(index).map(|(model, off)| (case.case.clone(), model, off));
    json!({
        "case": case.case,
        "model": fitted.map(|fitted| json_object(&models(), &fitted)),
        "levels": rows(timed, index).map(|row| json_object(&columns, &row)).collect::<Vec<_>>(),
    })
}

fn candidate(best: &BestCandidate) -> Value {
    let ([predicted, measured], (error, found)) = (best.seconds, best.error);
    json!({
        "budget": number(best.budget),
        "case": best.case,
        "cells": best.cells,
        "dt": number(best.dt),
        "ppc": best.ppc,
        "seconds": {"predicted": number(predicted), "measured": number(measured)},
        "error": {"predicted": number(error.value), "low": number(error.low),
            "high": number(error.high), "measured": number(found)},
        "beyond": best.beyond,
        "limit": best.limit,
        "failure": best.failure,
        "model": json_object(&model(), &best.model),
        "fitted": best.fitted,
    })
}

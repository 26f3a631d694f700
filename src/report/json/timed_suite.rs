//! Timed suites as JSON.
//!
//! ```json
//! {"suites": [{"suite": "...",
//!   "machine": {"cores": 2, "load": [0.1, 0.2], "waited": 0.0,
//!     "fixed_loop": {"median": 1e-3, "low": 1e-3, "high": 1e-3, "repeats": 40}},
//!   "cases": [{"case": "...",
//!     "model": {"transfer": 2e-9, "particle": 0.0, "node": 1e-9, "step": 0.0, "finest_off": 0.03},
//!     "levels": [{"cells": 5, "dt": 1e-3, "ppc": 4, "error": 1e-2, "transfers": 120000,
//!       "particle_updates": 10000, "steps": 500, "bytes": 720000, "failure": null,
//!       "seconds": {"median": 2e-3, "low": 2e-3, "high": 2e-3, "repeats": 25}}]}],
//!   "cost": [{"work": "seconds", ...}, {"work": "transfers", ...}], "best_candidate": null}]}
//! ```
//!
//! `error` is over the size of the solution, `bytes` the minimum traffic of particle data: bytes of
//! a particle times particle updates. `cost` is that of reports. `best_candidate` is the result for
//! a budget; the document then has no other keys. Its `error` has a prediction with a 95 %
//! interval, and a measured value.

use super::cost::rankings;
use crate::report::columns::cost::{model, models};
use crate::report::columns::json_object;
use crate::report::columns::number;
use crate::report::columns::timed_level::{json_columns, rows, timing};
use crate::verify::{BestCandidate, CaseOutcome, Machine, TimedSuite};
use serde_json::{Value, json};

/// The document, indented, with a newline at its end. A suite has either been timed or searched for
/// its best candidate.
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
    let columns = json_columns();
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

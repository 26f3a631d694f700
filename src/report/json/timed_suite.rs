//! What suites cost in seconds as JSON.
//!
//! ```json
//! {"suites": [{"suite": "...",
//!   "machine": {"cores": 2, "load": [0.1, 0.2], "waited": 0.0, "fixed_loop": {"median": 1e-3, "low": 1e-3, "high": 1e-3, "repeats": 40}},
//!   "cases": [{"case": "...",
//!     "model": {"transfer": 2e-9, "particle": 0.0, "node": 1e-9, "step": 0.0, "finest_off": 0.03},
//!     "levels": [{"cells": 5, "dt": 1e-3, "ppc": 4, "error": 1e-2, "transfers": 120000,
//!       "particle_updates": 10000, "steps": 500, "bytes": 720000, "failure": null,
//!       "seconds": {"median": 2e-3, "low": 2e-3, "high": 2e-3, "repeats": 25}}]}],
//!   "cost": [{"work": "seconds", ...}, {"work": "transfers", ...}], "bid": null}]}
//! ```
//!
//! `error` is over the size of the solution, `bytes` the particle data that the steps have passed over at
//! least: those of a particle times particle updates. `cost` is that of reports. `bid` is what came of a
//! budget; then there is nothing else.

use super::{cost::rankings, number::number};
use crate::{
    subject::{Column, Holder, Profile},
    verify::{Bid, CaseOutcome, LevelOutcome, Load, Machine, Model, TimedSuite, Timing},
};
use serde_json::{Value, json};

/// The document, indented, with a newline at its end. A suite has either been priced or bid for.
pub fn priced_json(priced: &[TimedSuite], bids: &[(String, Bid)]) -> String {
    let suites = priced.iter().map(suite).chain(bids.iter().map(|(name, found)| {
        json!({"suite": name, "machine": null, "cases": [], "cost": [], "bid": bid(found)})
    }));
    format!("{:#}\n", json!({ "suites": suites.collect::<Vec<_>>() }))
}

fn suite(priced: &TimedSuite) -> Value {
    let cases = priced.outcome.cases.iter().enumerate();
    let ranked = [
        (rankings(&priced.by_seconds(), "seconds")),
        (rankings(&priced.by_transfers(), "transfers")),
    ];
    let cost: Vec<Value> = ranked.iter().filter_map(Value::as_array).flatten().cloned().collect();
    json!({
        "suite": priced.outcome.suite,
        "machine": machine(&priced.machine),
        "cases": cases.map(|(index, one)| case(priced, index, one)).collect::<Vec<_>>(),
        "cost": cost,
        "bid": null,
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

fn timing(timing: Timing) -> Value {
    let Timing { median, low, high, repeats } = timing;
    json!({"median": number(median), "low": number(low), "high": number(high), "repeats": repeats})
}

fn case(priced: &TimedSuite, index: usize, case: &CaseOutcome) -> Value {
    let levels = case.convergence().map_or(&[][..], |study| &study.levels);
    let size = case.convergence().map_or(f64::NAN, |study| study.yardstick.size);
    let bytes = case.profile.as_ref().map(of_a_particle);
    let level = |(level, (load, timing)): (&LevelOutcome, &(Load, Option<Timing>))| {
        one_level(level, load, *timing, size, bytes)
    };
    let fitted = priced.model(index).map(|(found, off)| {
        let mut value = model(&found);
        value["finest_off"] = off.map_or(Value::Null, number);
        value
    });
    json!({
        "case": case.case,
        "model": fitted,
        "levels": levels.iter().zip(&priced.levels[index]).map(level).collect::<Vec<_>>(),
    })
}

/// Bytes that every particle has.
fn of_a_particle(profile: &Profile) -> usize {
    let whole =
        |column: &&Column| column.holder == Holder::Particle && column.entries == profile.particles;
    profile.columns.iter().filter(whole).map(|column| column.bytes).sum()
}

fn one_level(
    level: &LevelOutcome,
    load: &Load,
    measured: Option<Timing>,
    size: f64,
    bytes: Option<usize>,
) -> Value {
    json!({
        "cells": level.cells,
        "dt": number(level.dt),
        "ppc": level.ppc,
        "error": number(level.error / size),
        "transfers": level.run.counters.transfers,
        "particle_updates": load.updates as u64,
        "steps": level.run.steps,
        "bytes": bytes.map(|bytes| bytes as u64 * load.updates as u64),
        "failure": level.run.failure,
        "seconds": measured.map(timing),
    })
}

fn model(model: &Model) -> Value {
    let [transfer, particle, node, step] = model.seconds.map(number);
    json!({"transfer": transfer, "particle": particle, "node": node, "step": step})
}

fn bid(bid: &Bid) -> Value {
    let pair = |[predicted, measured]: [f64; 2]| json!({"predicted": number(predicted), "measured": number(measured)});
    json!({
        "budget": number(bid.budget),
        "case": bid.case,
        "cells": bid.cells,
        "dt": number(bid.dt),
        "ppc": bid.ppc,
        "seconds": pair(bid.seconds),
        "error": pair(bid.error),
        "beyond": bid.beyond,
        "limit": bid.limit,
        "failure": bid.failure,
        "model": model(&bid.model),
        "fitted": bid.fitted,
    })
}

//! Columns of the levels of a timed suite.

use super::{Cell, TableColumn, number, short};
use crate::subject::{ColumnSize, Holder, Profile};
use crate::verify::{CaseOutcome, LevelOutcome, TimedSuite, Timing, Workload};
use serde_json::{Value, json};

pub(crate) struct TimedLevel<'a> {
    case: &'a CaseOutcome,
    level: &'a LevelOutcome,
    /// Size of the solution, by which errors are divided.
    size: f64,
    load: &'a Workload,
    timing: Option<Timing>,
}

type TimedColumn<'a> = TableColumn<'a, TimedLevel<'a>>;

/// Returns the levels of the case with this index, coarse to fine.
pub(crate) fn rows(suite: &TimedSuite, case: usize) -> impl Iterator<Item = TimedLevel<'_>> {
    let outcome = &suite.outcome.cases[case];
    let levels = outcome
        .convergence()
        .into_iter()
        .flat_map(|study| study.levels.iter().map(|level| (level, study.error_scale.size)));
    levels.zip(&suite.levels[case]).map(move |((level, size), (load, timing))| TimedLevel {
        case: outcome,
        level,
        size,
        load,
        timing: *timing,
    })
}

pub(crate) fn columns<'a>() -> [TimedColumn<'a>; 10] {
    [
        TimedColumn::text("case", "case", |row| row.case.case.clone()).flush_left(),
        TimedColumn::plain("cells", "cells", "cells along the first axis", |row| row.level.cells),
        TimedColumn::number("dt", "dt", "time step (s)", short, |row| row.level.dt),
        TimedColumn::plain("ppc", "ppc", "particles per cell (MPM)", |row| row.level.ppc),
        TimedColumn::new("error", "error", "error, relative to the size of the solution", |row| {
            let error = Cell::number(row.level.error / row.size, short);
            error.or_failed(row.level.run.failure.as_ref())
        }),
        TimedColumn::plain("transfers", "transfers", "particle-node pairs of P2G and G2P", |row| {
            Some(row.level.run.counters.transfers).filter(|count| *count > 0)
        }),
        TimedColumn::new("seconds", "seconds", "time of the steps, median of the repeats", |row| {
            let text = Cell::text(row.timing.map(|timing| short(timing.median)));
            Cell { json: row.timing.map_or(Value::Null, timing), ..text }
        }),
        TimedColumn::text("quartiles", "quartiles of the time (s)", |row| {
            row.timing.map(|timing| format!("{}..{}", short(timing.low), short(timing.high)))
        }),
        TimedColumn::text("repeats", "repeats", |row| row.timing.map(|timing| timing.repeats)),
        TimedColumn::text("ns/transfer", "time of a transfer (ns)", |row| {
            let transfers = row.level.run.counters.transfers as f64;
            let timing = row.timing.filter(|_| transfers > 0.0)?;
            Some(format!("{:.2}", 1e9 * timing.median / transfers))
        }),
    ]
}

pub(crate) fn json_columns<'a>() -> Vec<TimedColumn<'a>> {
    let bytes = "size of the particle columns, summed over all particle updates (B)";
    let mut list: Vec<_> = columns().into();
    list.extend([
        TimedColumn::json("particle_updates", "particles times steps", |row| {
            row.load.updates as u64
        }),
        TimedColumn::json("steps", "steps taken", |row| row.level.run.steps),
        TimedColumn::json("bytes", bytes, |row| {
            let bytes = row.case.profile.as_ref().map(bytes_of_a_particle);
            bytes.map(|bytes| bytes as u64 * row.load.updates as u64)
        }),
        TimedColumn::json("failure", "reason and time of the failure", |row| {
            row.level.run.failure.clone()
        }),
    ]);
    list
}

pub(crate) fn timing(timing: Timing) -> Value {
    let Timing { median, low, high, repeats } = timing;
    json!({"median": number(median), "low": number(low), "high": number(high), "repeats": repeats})
}

/// Returns the memory per particle (bytes), without columns that only some particles have.
fn bytes_of_a_particle(profile: &Profile) -> usize {
    let whole = |column: &&ColumnSize| {
        column.holder == Holder::Particle && column.entries == profile.particles
    };
    profile.columns.iter().filter(whole).map(|column| column.bytes).sum()
}

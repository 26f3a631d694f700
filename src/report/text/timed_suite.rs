//! What a suite costs in seconds, as text: what depends on the machine is shown here and in no snapshot.

use super::{
    cost::{TRANSFERS, cost, short},
    table::{Table, optional},
};
use crate::verify::{Bid, LevelOutcome, Machine, Model, Ranked, Ranking, TimedSuite, Timing};

/// The report of a suite whose levels have been timed. `varied` says that there are cases besides the
/// suite's own, whose best splits are shown.
pub fn priced(priced: &TimedSuite, varied: bool) -> String {
    let mut text = format!("{}: {}\n\n", priced.outcome.suite, priced.outcome.title);
    text += &machine(&priced.machine);
    text += &row("seconds", SECONDS);
    text += &format!("\n{}", lines(&levels(priced)));
    if let Some(models) = models(priced) {
        text += &format!("\n{}", lines(&models));
    }
    let (by_seconds, by_transfers) = (priced.by_seconds(), priced.by_transfers());
    for (seconds, transfers) in by_seconds.iter().zip(&by_transfers) {
        text += &format!("\n{}", cost(seconds, "seconds"));
        if varied {
            text += &format!("\n{}", lines(&splits(seconds)));
        }
        text += &format!("\n{}", cost(transfers, TRANSFERS));
    }
    if by_seconds.is_empty() {
        text += "\n  no case has levels enough, and an exact size, to rank\n";
    }
    text
}

const SECONDS: &str = "of the steps alone, one thread, median of repeats that take turns";

fn row(key: &str, value: &str) -> String {
    format!("  {key:18}{value}\n")
}

fn lines(lines: &[String]) -> String {
    lines.join("\n") + "\n"
}

/// Cores, load, and noise.
pub(crate) fn machine(machine: &Machine) -> String {
    let cores = if machine.cores == 1 { "core" } else { "cores" };
    let load = machine.load.map_or("load not known".to_owned(), |[before, after]| {
        format!("load {before:.2} before, {after:.2} after")
    });
    let noise = machine.fixed_loop.map_or(String::new(), |timing| {
        let (spread, looks) = (100.0 * timing.spread(), timing.repeats);
        format!("; a fixed loop spreads by {spread:.1} % between quartiles ({looks} looks)")
    });
    let waited = machine.waited.map_or("waiting for a core counts".to_owned(), |share| {
        format!("{:.0} % of the time waiting for a core, left out", 100.0 * share)
    });
    row("machine", &format!("{} {cores}, {load}", machine.cores))
        + &row("noise", &format!("{waited}{noise}"))
}

/// Every level of every case: what it gave and took.
fn levels(priced: &TimedSuite) -> Vec<String> {
    let heads = [
        "case",
        "cells",
        "dt",
        "ppc",
        "error",
        "transfers",
        "seconds",
        "quartiles",
        "repeats",
        "ns/transfer",
    ];
    let mut table = Table::new(&heads);
    for (case, timed) in priced.outcome.cases.iter().zip(&priced.levels) {
        let Some(study) = case.convergence() else { continue };
        for (level, (_, timing)) in study.levels.iter().zip(timed) {
            let error = match &level.run.failure {
                Some(_) => "failed".to_owned(),
                None => short(level.error / study.yardstick.size),
            };
            let figures = [case.case.clone(), level.cells.to_string(), short(level.dt)];
            let rest = [optional(level.ppc), error, level.run.counters.transfers.to_string()];
            table
                .row(figures.into_iter().chain(rest).chain(timing_cells(level, *timing)).collect());
        }
    }
    table.flush_left(&[0]).without_empty_columns().lines()
}

fn timing_cells(level: &LevelOutcome, timing: Option<Timing>) -> [String; 4] {
    let nanoseconds = |timing: &Timing| 1e9 * timing.median / level.run.counters.transfers as f64;
    [
        optional(timing.map(|timing| short(timing.median))),
        optional(timing.map(|timing| format!("{}..{}", short(timing.low), short(timing.high)))),
        optional(timing.map(|timing| timing.repeats)),
        optional(timing.as_ref().map(|timing| format!("{:.2}", nanoseconds(timing)))),
    ]
}

/// The cost model of each case, and how well it predicts the finest level before that runs.
fn models(priced: &TimedSuite) -> Option<Vec<String>> {
    let heads = ["cost model, ns", "a transfer", "a particle", "a node", "a step", "finest"];
    let mut table = Table::new(&heads);
    let mut any = false;
    for (index, case) in priced.outcome.cases.iter().enumerate() {
        let Some((model, off)) = priced.model(index) else { continue };
        any = true;
        let cells = model.seconds.iter().map(|seconds| nanoseconds(*seconds));
        let off = optional(off.map(|off| format!("{:+.0} %", 100.0 * off)));
        let name = std::iter::once(case.case.clone());
        table.row(name.chain(cells).chain(std::iter::once(off)).collect());
    }
    any.then(|| table.flush_left(&[0]).lines())
}

fn nanoseconds(seconds: f64) -> String {
    if seconds == 0.0 { "-".to_owned() } else { format!("{:.2}", 1e9 * seconds) }
}

/// The cheapest setting for each target, of all that were varied.
fn splits(ranking: &Ranking) -> Vec<String> {
    let mut table = Table::new(&["best split for", "case", "h", "seconds"]);
    for (k, target) in ranking.targets.iter().enumerate() {
        let reached = ranking.rows.iter().filter(|row| row.reaches[k].work().is_some());
        let cost = |row: &Ranked| row.reaches[k].work().unwrap_or(f64::NAN);
        let best = reached.min_by(|a, b| cost(a).total_cmp(&cost(b)));
        let cells = match best {
            None => ["not reached".to_owned(), "-".to_owned(), "-".to_owned()],
            Some(row) => [
                row.contender.name.clone(),
                optional(row.reaches[k].spacing().map(short)),
                super::cost::work(row.reaches[k]),
            ],
        };
        table.row(std::iter::once(format!("<= {target:e}")).chain(cells).collect());
    }
    table.flush_left(&[0, 1]).lines()
}

/// What came of a budget.
pub fn bid(suite: &str, bid: &Bid) -> String {
    let Bid { budget, case, cells, dt, ppc, seconds, error, .. } = bid;
    let mut text = format!("{suite}: the most accurate setting predicted within {budget} s\n\n");
    text += &row("case", case);
    let ppc = ppc.map_or(String::new(), |ppc| format!(", {ppc} particles per cell"));
    let beyond = if bid.beyond { ", finer than all levels of the suite" } else { "" };
    text += &row("setting", &format!("{cells} cells, dt = {} s{ppc}{beyond}", short(*dt)));
    let mut table = Table::new(&["", "predicted", "measured", "off"]);
    for (name, [predicted, measured]) in [("seconds", seconds), ("error", error)] {
        let off = format!("{:+.0} %", 100.0 * (predicted / measured - 1.0));
        table.row(vec![name.to_owned(), short(*predicted), short(*measured), off]);
    }
    text += &format!("\n{}\n", lines(&table.flush_left(&[0]).lines()));
    text += &row("share of budget", &format!("{:.0} %", 100.0 * seconds[1] / budget));
    text += &row("model", &model(&bid.model, bid.fitted));
    if let Some(limit) = bid.limit {
        text += &row("nothing finer", limit);
    }
    if let Some(failure) = &bid.failure {
        text += &row("failure", failure);
    }
    text
}

fn model(model: &Model, fitted: usize) -> String {
    let names = ["a transfer", "a particle", "a node", "a step"];
    let parts = model.seconds.iter().zip(names).filter(|(seconds, _)| **seconds > 0.0);
    let parts: Vec<String> =
        parts.map(|(seconds, name)| format!("{:.2} ns {name}", 1e9 * seconds)).collect();
    format!("{}, fitted to {fitted} shorter runs", parts.join(", "))
}

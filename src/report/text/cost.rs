//! Cost tables: the work of each method for a target error, and the exponent k in work ~ error^k.
//! Reports of timed suites depend on the machine and are therefore not in snapshots.
//!
//! Snapshots give work as the number of particle-node transfers, which is equal on all machines.

use super::prose::wrapped_row;
use super::table::Table;
use crate::report::columns::{cost as columns, short, timed_level};
use crate::verify::{Machine, Ranking, Reach, TimedSuite, by_transfers};

const TRANSFERS: &str = "particle-node transfers";

/// Returns the tables of a ranking. `work` is the name of the unit of work.
pub fn cost(ranking: &Ranking, work: &str) -> String {
    let mut lines = vec![format!("== cost, {} ==", ranking.problem)];
    lines.push(format!("  {:18}{}", "error", relative(ranking)));
    let how = "interpolated between neighbouring levels, never extrapolated";
    lines.push(format!("  {:18}{work}, {how}", "work"));
    let reaches = || ranking.rows.iter().flat_map(|row| &row.reaches);
    if reaches().any(|reach| matches!(reach, Reach::Already { .. })) {
        let bound = "upper bound: the coarsest level that counts already reaches the error";
        lines.push(format!("  {:18}{bound}", "<="));
    }
    lines.push(String::new());
    // Targets that no method reaches get no column.
    let work = Table::new(&columns::methods(ranking), &ranking.rows).without_empty_columns();
    lines.extend(work.lines());
    let exponents = ranking.rows.iter().filter(|row| row.exponent.is_some());
    let exponents = Table::new(&columns::exponents(), exponents);
    if !exponents.is_empty() {
        lines.push(String::new());
        lines.extend(exponents.lines());
    }
    lines.join("\n") + "\n"
}

fn relative(ranking: &Ranking) -> String {
    if ranking.size == 1.0 {
        return "divided by the `scale` of the suite".to_owned();
    }
    let size = short(ranking.size);
    format!("divided by {size}, the largest exact value of the judged quantity")
}

/// Returns the report of a timed suite: the ranking by seconds, and the cheapest method.
/// `is_verbose` adds all levels, and the ranking by transfers.
pub fn timed(timed: &TimedSuite, is_verbose: bool) -> String {
    let mut text = format!("{}: {}\n\n", timed.outcome.suite, timed.outcome.title);
    text += &machine(&timed.machine);
    text += &row("seconds", SECONDS);
    if is_verbose {
        text += &format!("\n{}", lines(&levels(timed)));
    }
    let (by_seconds, by_transfers) = (timed.by_seconds(), by_transfers(&timed.outcome.cases));
    for (seconds, transfers) in by_seconds.iter().zip(&by_transfers) {
        text += &format!("\n{}", cost(seconds, "seconds"));
        // External solvers do not count transfers.
        let has_transfers = timed.levels.iter().flatten().any(|(load, _)| load.transfers > 0.0);
        if is_verbose && has_transfers {
            text += &format!("\n{}", cost(transfers, TRANSFERS));
        }
    }
    text += "\n";
    for ranking in &by_seconds {
        if by_seconds.len() > 1 {
            text += &format!("{}:\n", ranking.problem);
        }
        text += &cheapest(ranking);
    }
    if by_seconds.is_empty() {
        text += "  no case has both enough levels and an exact size to be ranked\n";
    }
    text
}

fn cheapest(ranking: &Ranking) -> String {
    let least = |k: usize| {
        let reached = ranking.rows.iter().filter_map(|row| Some((row, row.reaches[k].work()?)));
        reached.min_by(|(_, one), (_, other)| one.total_cmp(other))
    };
    let mut targets = ranking.targets.iter().enumerate().rev();
    let found = targets.find_map(|(k, target)| Some((target, least(k)?)));
    found.map_or_else(String::new, |(target, (row, work))| {
        let (name, work) = (&row.method.name, short(work));
        format!("cheapest for an error of {target:e}: {name}, {work} s\n")
    })
}

const SECONDS: &str = "steps only, on one thread, median of interleaved repeats";

fn row(key: &str, value: &str) -> String {
    wrapped_row(17, key, value)
}

fn lines(lines: &[String]) -> String {
    lines.join("\n") + "\n"
}

pub(crate) fn machine(machine: &Machine) -> String {
    let cores = if machine.cores == 1 { "core" } else { "cores" };
    let load = machine.load.map_or("load unknown".to_owned(), |[before, after]| {
        format!("load {before:.2} before, {after:.2} after")
    });
    let noise = machine.fixed_loop.map_or(String::new(), |timing| {
        let (spread, looks) = (100.0 * timing.spread(), timing.repeats);
        format!("; times of a fixed loop differ by {spread:.1} % between quartiles ({looks} runs)")
    });
    let waited = machine.waited.map_or("times include waiting for a core".to_owned(), |share| {
        format!("{:.0} % of the time was spent waiting for a core, and is excluded", 100.0 * share)
    });
    row("machine", &format!("{} {cores}, {load}", machine.cores))
        + &row("noise", &format!("{waited}{noise}"))
}

fn levels(timed: &TimedSuite) -> Vec<String> {
    let cases = 0..timed.outcome.cases.len();
    let rows = cases.flat_map(|case| timed_level::rows(timed, case));
    Table::new(&timed_level::columns(), rows).without_empty_columns().lines()
}

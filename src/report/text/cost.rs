//! Cost tables: the work of each method for a target error, and the exponent k in work ~ error^k,
//! compared with theory. The module also writes the reports of timed suites. Their times depend on
//! the machine and are therefore not in snapshots.
//!
//! Snapshots give work as the number of particle-node transfers, which is equal on all machines.

use super::table::Table;
use crate::report::columns::{cost as columns, short, timed_level};
use crate::verify::{Convergence, Machine, Quantity, Ranked, Ranking, Reach, TimedSuite};

const TRANSFERS: &str = "particle-node transfers";

/// Returns the tables of a ranking. `work` is the name of the unit of work.
pub fn cost(ranking: &Ranking, work: &str) -> String {
    let mut lines = vec![format!("== cost, {} ==", ranking.problem)];
    lines.push(format!("  {:18}{}", "error", relative(ranking, None)));
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

/// Names the cheapest method for each target that a method reaches, in one line. `study` is one of
/// the ranked studies.
pub(crate) fn cheapest(ranking: &Ranking, study: Option<&Convergence>) -> Option<String> {
    let best = |(k, target): (usize, &f64)| {
        let reached = |row: &&Ranked| row.times[k].is_some_and(|times| times <= 1.0);
        let row = ranking.rows.iter().find(reached)?;
        let (work, level) = match row.reaches[k] {
            Reach::At { work, .. } => (work, ""),
            Reach::Already { work, .. } => (work, " on its coarsest level"),
            Reach::Never => return None,
        };
        Some(format!("{target:e}: {}{level}, {} {TRANSFERS}", row.method.name, short(work)))
    };
    let best: Vec<String> = ranking.targets.iter().enumerate().filter_map(best).collect();
    let errors = relative(ranking, study);
    (!best.is_empty())
        .then(|| format!("for a relative error of {}; errors are {errors}", best.join("; of ")))
}

/// Describes the value by which the errors of a ranking are divided. `study` is one of the ranked
/// studies, if known.
fn relative(ranking: &Ranking, study: Option<&Convergence>) -> String {
    let with_unit = |value: String, of: Quantity| {
        let text = format!("divided by {value} {}", of.unit());
        text.trim_end().to_owned()
    };
    let is_scaled = ranking.size == 1.0;
    let size = short(ranking.size);
    match study {
        Some(Convergence { of, scale: Some(scale), .. }) if is_scaled => {
            with_unit(of.shown_scale(*scale), *of)
        }
        None if is_scaled => "divided by the `scale` of the suite".to_owned(),
        Some(Convergence { of, .. }) => format!("{}, {}", with_unit(size, *of), of.size_words()),
        None => format!("divided by {size}, the largest exact value of the judged quantity"),
    }
}

/// Returns the report of a timed suite.
pub fn timed(timed: &TimedSuite) -> String {
    let mut text = format!("{}: {}\n\n", timed.outcome.suite, timed.outcome.title);
    text += &machine(&timed.machine);
    text += &row("seconds", SECONDS);
    text += &format!("\n{}", lines(&levels(timed)));
    let (by_seconds, by_transfers) = (timed.by_seconds(), timed.by_transfers());
    for (seconds, transfers) in by_seconds.iter().zip(&by_transfers) {
        text += &format!("\n{}", cost(seconds, "seconds"));
        // External solvers do not count transfers.
        if timed.levels.iter().flatten().any(|(load, _)| load.transfers > 0.0) {
            text += &format!("\n{}", cost(transfers, TRANSFERS));
        }
    }
    if by_seconds.is_empty() {
        text += "\n  no case has both enough levels and an exact size to be ranked\n";
    }
    text
}

const SECONDS: &str = "steps only, on one thread, median of interleaved repeats";

fn row(key: &str, value: &str) -> String {
    format!("  {key:17} {value}\n")
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

//! Tables of cost: the work of each method for an error, and of one more digit, beside theory.
//!
//! In snapshots work is counted in particle-node transfers, which are the same on every machine.

use super::table::Table;
use crate::report::columns::{cost as columns, short};
use crate::verify::{Ranked, Ranking};

/// The unit of work that is counted.
pub(crate) const TRANSFERS: &str = "particle-node transfers";

/// The tables of a ranking, `work` being its unit.
pub fn cost(ranking: &Ranking, work: &str) -> String {
    let mut lines = vec![format!("== cost, {} ==", ranking.problem)];
    lines.push(format!("  {:18}{}", "error", relative(ranking)));
    let how = "interpolated between neighbouring levels, never extrapolated";
    lines.push(format!("  {:18}{work}, {how}", "work"));
    lines.push(String::new());
    // Targets that no method reaches have no column.
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

/// The cheapest method for each target that is reached, in one line.
pub(crate) fn cheapest(ranking: &Ranking) -> Option<String> {
    let best = |(k, target): (usize, &f64)| {
        let reached = |row: &&Ranked| row.times[k].is_some_and(|times| times <= 1.0);
        let row = ranking.rows.iter().find(reached)?;
        let work = columns::reach_text(row.reaches[k]);
        Some(format!("{target:e} by {} with {work}", row.method.name))
    };
    let best: Vec<String> = ranking.targets.iter().enumerate().filter_map(best).collect();
    (!best.is_empty())
        .then(|| format!("{} {TRANSFERS}; errors {}", best.join("; "), relative(ranking)))
}

/// The size that errors are divided by.
fn relative(ranking: &Ranking) -> String {
    if ranking.size == 1.0 {
        return "as judged, relative to the scale of the suite".to_owned();
    }
    format!("relative to {}, the largest exact value", short(ranking.size))
}

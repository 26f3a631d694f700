//! What accuracy costs, as tables: which method reaches an error for the least work, and what one more
//! digit takes, beside theory.
//!
//! In snapshots work is counted in particle-node transfers, which are the same on every machine.

use super::table::{Table, optional};
use crate::verify::{
    Agreement, CaseOutcome, End, Exponent, LevelOutcome, Ranked, Ranking, Reach, SuiteOutcome,
    rankings,
};

/// The unit of work that is counted.
pub(crate) const TRANSFERS: &str = "particle-node transfers";

/// The rankings of a suite by transfers.
pub(crate) fn by_transfers(outcome: &SuiteOutcome) -> Vec<Ranking> {
    let transfers =
        |_: &CaseOutcome, _: usize, level: &LevelOutcome| level.run.counters.transfers as f64;
    rankings(&outcome.cases, transfers)
}

/// The tables of a ranking, `work` being its unit.
pub fn cost(ranking: &Ranking, work: &str) -> String {
    let mut lines = vec![format!("== cost, {} ==", ranking.problem)];
    lines.push(format!("  {:18}{}", "error", relative(ranking)));
    lines.push(format!("  {:18}{work}, between neighbouring levels, never beyond them", "work"));
    lines.push(String::new());
    lines.extend(cheapest(ranking));
    if let Some(table) = digits(ranking) {
        lines.push(String::new());
        lines.extend(table.lines());
    }
    lines.join("\n") + "\n"
}

/// What errors are a share of.
fn relative(ranking: &Ranking) -> String {
    if ranking.size == 1.0 {
        return "as judged, over the scale of the suite".to_owned();
    }
    format!("over {}, the largest exact value", short(ranking.size))
}

/// For each method the work at each target, and how many times the cheapest that is; the cheapest at
/// the finest target first.
fn cheapest(ranking: &Ranking) -> Vec<String> {
    let targets = ranking.targets.iter().flat_map(|target| [format!("<= {target:e}"), "x".into()]);
    let heads: Vec<String> = ["cheapest for".to_owned()]
        .into_iter()
        .chain(targets)
        .chain(["best error", "not reached", "front"].map(str::to_owned))
        .collect();
    let mut table = Table::new(&heads.iter().map(String::as_str).collect::<Vec<_>>());
    for row in &ranking.rows {
        let pairs = row.reaches.iter().zip(&row.times);
        let cells = pairs.flat_map(|(reach, times)| [work(*reach), optional(times.map(ratio))]);
        let front = (!row.front.is_empty())
            .then(|| format!("{} of {}", row.front.len(), row.contender.tried.len()));
        let rest = [optional(row.best.map(short)), ends(row), optional(front)];
        table.row([row.contender.name.clone()].into_iter().chain(cells).chain(rest).collect());
    }
    // Targets that no method reaches have no column.
    table.flush_left(&[0]).without_empty_columns().lines()
}

/// What one more digit costs, where that can be told.
fn digits(ranking: &Ranking) -> Option<Table> {
    let heads = ["work ~ error^k", "k", "low", "high (95 %)", "theory", ""];
    let mut table = Table::new(&heads);
    let mut any = false;
    for row in &ranking.rows {
        let Some(found) = row.exponent else { continue };
        any = true;
        let two = |x: f64| format!("{x:.2}");
        table.row(vec![
            row.contender.name.clone(),
            two(found.observed.value),
            two(found.observed.low),
            two(found.observed.high),
            two(found.theory),
            agreement(&found),
        ]);
    }
    any.then(|| table.flush_left(&[0, 5]))
}

/// Whether theory is met, and if not, what differs.
pub(crate) fn agreement(found: &Exponent) -> String {
    match found.agreement() {
        Agreement::Agrees => "agrees".to_owned(),
        Agreement::Order => {
            let (observed, formal) = found.order;
            differing("order", observed, formal)
        }
        Agreement::Growth => {
            let (observed, expected) = found.growth;
            differing("growth of work", observed, expected)
        }
    }
}

/// With as many decimals as tell the numbers apart.
fn differing(what: &str, observed: f64, expected: f64) -> String {
    let decimals = if (observed - expected).abs() < 0.015 { 4 } else { 2 };
    format!("{what} {observed:.decimals$}, not {expected:.decimals$}")
}

/// A cell of work: at most so much where the coarsest level is good enough.
pub(crate) fn work(reach: Reach) -> String {
    match reach {
        Reach::At { work, .. } => short(work),
        Reach::Already { work, .. } => format!("<={}", short(work)),
        Reach::Never => "-".to_owned(),
    }
}

/// Why the finest target is not reached.
pub(crate) fn ends(row: &Ranked) -> String {
    optional(row.obstacle().map(End::words))
}

/// How many times: two decimals, more digits being noise.
fn ratio(times: f64) -> String {
    if times < 1000.0 { format!("{times:.2}") } else { short(times) }
}

/// Three significant digits, exponent of two.
pub(crate) fn short(value: f64) -> String {
    let text = format!("{value:.2e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let (sign, digits) = exponent.strip_prefix('-').map_or(("+", exponent), |digits| ("-", digits));
    format!("{mantissa}e{sign}{digits:0>2}")
}

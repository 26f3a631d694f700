//! A comparison as JSON.

use super::changes::{CheapestMove, ErrorMove, Moved, ProblemMove, ReportComparison};
use crate::report::columns::number::number;
use serde_json::{Value, json};

/// One document: suites whose problem is another one; cases that moved, the most important first;
/// and targets whose least work moved.
pub fn json(comparison: &ReportComparison) -> String {
    let document = json!({
        "worse": comparison.is_worse(),
        "problems": comparison.problems.iter().map(problem).collect::<Vec<_>>(),
        "moved": comparison.moved.iter().map(moved).collect::<Vec<_>>(),
        "cheapest": comparison.cheapest.iter().map(cheapest).collect::<Vec<_>>(),
        "unchanged": comparison.unchanged,
        "tolerance": number(comparison.tolerance),
    });
    format!("{document:#}\n")
}

fn problem(problem: &ProblemMove) -> Value {
    json!({"suite": problem.suite, "rows": problem.rows})
}

fn moved(moved: &Moved) -> Value {
    json!({
        "case": moved.name,
        "rank": moved.rank.words(),
        "worse": moved.rank.is_worse(),
        "verdict": moved.verdict,
        "order": moved.order.map(|order| order.map(number)),
        "error": moved.error.as_ref().map(error),
        "transfers": moved.work.map(number),
        "same_error": moved.equal.map(|equal| {
            json!({"ratio": number(equal.ratio), "error": number(equal.target)})
        }),
        "notes": moved.notes,
    })
}

fn error(error: &ErrorMove) -> Value {
    let ErrorMove { old, new, worse, level } = error;
    json!({"old": old.map(number), "new": new.map(number), "worse": worse, "level": level})
}

fn cheapest(target: &CheapestMove) -> Value {
    let one = |least: &Option<(f64, String)>| {
        least.as_ref().map(|(work, case)| json!({"work": number(*work), "case": case}))
    };
    json!({
        "problem": target.place,
        "error": number(target.target),
        "old": one(&target.old),
        "new": one(&target.new),
    })
}

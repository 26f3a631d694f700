//! Rankings by cost as JSON, see [`crate::report::json()`].

use super::number::number;
use crate::verify::{Agreement, End, Exponent, Ranked, Ranking, Reach};
use serde_json::{Value, json};

/// One entry for each problem; `work` is its unit.
pub(crate) fn rankings(rankings: &[Ranking], work: &str) -> Value {
    let ranking = |ranking: &Ranking| {
        json!({
            "problem": ranking.problem,
            "size": number(ranking.size),
            "work": work,
            "targets": ranking.targets,
            "methods": ranking.rows.iter().map(method).collect::<Vec<_>>(),
        })
    };
    rankings.iter().map(ranking).collect()
}

fn method(row: &Ranked) -> Value {
    let reached = |(reach, times): (&Reach, &Option<f64>)| {
        reach.work().map(|work| {
            json!({
                "work": number(work),
                "at_most": matches!(reach, Reach::Already { .. }),
                "times": times.map(number),
            })
        })
    };
    json!({
        "case": row.contender.name,
        "reached": row.reaches.iter().zip(&row.times).map(reached).collect::<Vec<_>>(),
        "best": row.best.map(number),
        "not_reached": row.obstacle().map(End::words),
        "front": row.front,
        "exponent": row.exponent.as_ref().map(exponent),
    })
}

fn exponent(found: &Exponent) -> Value {
    json!({
        "value": number(found.observed.value),
        "low": number(found.observed.low),
        "high": number(found.observed.high),
        "theory": number(found.theory),
        "agrees": found.agreement() == Agreement::Agrees,
    })
}

//! Rankings by cost as JSON, see [`crate::report::json()`].

use crate::report::columns::cost::json_columns;
use crate::report::columns::json_object;
use crate::report::columns::number;
use crate::verify::Ranking;
use serde_json::{Value, json};

/// One entry for each problem; `work` is its unit.
pub(crate) fn rankings(rankings: &[Ranking], work: &str) -> Value {
    let ranking = |ranking: &Ranking| {
        let columns = json_columns(ranking);
        json!({
            "problem": ranking.problem,
            "size": number(ranking.size),
            "work": work,
            "targets": ranking.targets,
            "methods": ranking.rows.iter().map(|row| json_object(&columns, row)).collect::<Vec<_>>(),
        })
    };
    rankings.iter().map(ranking).collect()
}

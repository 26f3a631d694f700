//! Stability studies in the JSON document.

use crate::report::columns::json_object;
use crate::report::columns::stability::json_columns;
use crate::verify::StabilityStudy;
use serde_json::{Value, json};

/// The rows of a study.
pub(crate) fn study(study: &StabilityStudy) -> Value {
    let columns = json_columns(study);
    json!({
        "swept": study.swept,
        "sought": study.sought,
        "rows": study.rows.iter().map(|row| json_object(&columns, row)).collect::<Vec<_>>(),
    })
}

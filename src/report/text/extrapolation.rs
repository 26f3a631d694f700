//! Richardson's extrapolation in reports, with what it is worth: the true error beside its index.

use super::table::Table;
use crate::report::columns::level::{self, NamedStudy};
use crate::report::columns::{TableColumn, decimals, scientific, short};
use crate::verify::Richardson;

/// Richardson's extrapolation at the observed place, triple by triple.
pub(crate) fn richardson(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    let place = studies.iter().find_map(|(_, study)| study.place());
    let triples = |(name, study): &NamedStudy<'_>| {
        let names = level::names(study);
        let triple = |triple: &([usize; 3], Richardson)| Triple {
            case: (*name).to_owned(),
            levels: triple.0.map(|k| names[k].clone()).join(", "),
            found: triple.1,
            covered: study.covered(triple),
        };
        study.richardson.iter().map(triple).collect::<Vec<_>>()
    };
    let mut rows: Vec<Triple> = studies.iter().flat_map(triples).collect();
    let (Some(place), all @ 1..) = (place, rows.len()) else { return };
    // Of levels that do not converge monotonically there is no estimate.
    rows.retain(|row| row.found.extrapolated.is_some());
    let converging = rows.len();
    lines.push(String::new());
    lines.push(format!(
        "  Richardson's extrapolation of u at X = {place} m: {converging} of {all} triples of levels \
         converge monotonically"
    ));
    if rows.is_empty() {
        return;
    }
    lines.extend(Table::new(&extrapolations(), &rows).without_empty_columns().lines());
}

/// Three levels of a case.
struct Triple {
    case: String,
    levels: String,
    found: Richardson,
    covered: Option<(f64, bool)>,
}

fn extrapolations() -> [TableColumn<'static, Triple>; 8] {
    [
        TableColumn::<Triple>::text("case", "case", |row| row.case.clone()).flush_left(),
        TableColumn::<Triple>::text("levels", "levels", |row| row.levels.clone()),
        TableColumn::<Triple>::text("ratio", "ratio of changes", |row| {
            decimals(2)(row.found.ratio)
        }),
        TableColumn::<Triple>::text("order", "order of the triple", |row| {
            row.found.order.map(decimals(2))
        }),
        TableColumn::<Triple>::text("extrapolated u", "limit (m)", |row| {
            row.found.extrapolated.map(scientific)
        }),
        TableColumn::<Triple>::text("gci", "grid convergence index", |row| {
            row.found.gci.map(short)
        }),
        TableColumn::<Triple>::text("true error", "relative error at the place", |row| {
            row.covered.map(|(error, _)| short(error))
        }),
        TableColumn::<Triple>::text("covered", "whether the index covers it", |row| {
            row.covered.map(|(_, covered)| if covered { "yes" } else { "no" })
        }),
    ]
}

//! Tables of levels: errors and their cost.

use super::table::Table;
use crate::report::columns::{TableColumn, decimals, level, scientific};
use crate::verify::{Convergence, Richardson};

/// Errors, work, drifts and Richardson's extrapolation, level by level.
pub(crate) fn tables(lines: &mut Vec<String>, study: &Convergence) {
    let errors = Table::new(&level::errors(study.axis), level::rows(study));
    let work = Table::new(&level::work(study.axis), level::rows(study));
    lines.extend(errors.without_empty_columns().lines());
    lines.push(String::new());
    lines.extend(work.without_empty_columns().lines());
    drifts(lines, study);
    rates(lines, study);
    richardson(lines, study);
}

/// How far totals drifted, of those that the suite asks for.
fn drifts(lines: &mut Vec<String>, study: &Convergence) {
    if study.drifts.is_empty() {
        return;
    }
    lines.extend([String::new(), "  relative drift".to_owned()]);
    let mut columns = vec![level::cells()];
    columns.extend(study.drifts.iter().map(|sum| level::drift(*sum)));
    lines.extend(Table::new(&columns, level::rows(study)).lines());
}

/// How fast the energy grows or decays, where the suite asks.
fn rates(lines: &mut Vec<String>, study: &Convergence) {
    if !study.rated {
        return;
    }
    lines.extend([String::new(), "  rate of the energy, d ln E/dt (1/s)".to_owned()]);
    let mut columns = vec![level::cells()];
    columns.extend(level::energy_rate());
    lines.extend(Table::new(&columns, level::rows(study)).lines());
}

/// Richardson's extrapolation at the observed place, triple by triple.
fn richardson(lines: &mut Vec<String>, study: &Convergence) {
    let (Some(place), false) = (study.place(), study.richardson.is_empty()) else { return };
    lines.push(String::new());
    lines.push(format!("  Richardson's extrapolation of u at X = {place} m"));
    lines.extend(Table::new(&triples(study), &study.richardson).lines());
}

type Triple = ([usize; 3], Richardson);

fn triples(study: &Convergence) -> [TableColumn<'_, Triple>; 6] {
    let name = level::name(study.axis);
    let names: Vec<String> = level::rows(study).map(|row| name.cell(&row).text).collect();
    [
        TableColumn::<Triple>::text(name.heading, "levels", move |(triple, _)| {
            triple.map(|k| names[k].clone()).join(", ")
        }),
        TableColumn::<Triple>::text("ratio", "ratio of changes", |(_, found)| {
            decimals(2)(found.ratio)
        }),
        TableColumn::<Triple>::text("class", "kind of convergence", |(_, found)| {
            found.class.to_string()
        }),
        TableColumn::<Triple>::text("order", "order of the triple", |(_, found)| {
            found.order.map(decimals(2))
        }),
        TableColumn::<Triple>::text("extrapolated u", "limit (m)", |(_, found)| {
            found.extrapolated.map(scientific)
        }),
        TableColumn::<Triple>::text("gci", "grid convergence index", |(_, found)| {
            found.gci.map(scientific)
        }),
    ]
}

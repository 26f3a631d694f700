//! Tables of convergence studies: a row for each case, a column for each level.

use super::extrapolation::richardson;
use super::merged::{merged, shared};
use super::prose::row;
use super::table::Table;
use crate::report::columns::level::{self, LevelColumn, LevelRow, NamedStudy};
use crate::verify::{Axis, Conserved, Convergence, LevelOutcome, format_number};

/// Errors with their orders, figures of the finest levels, drifts, rates and extrapolations.
pub(crate) fn tables(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    settings(lines, studies);
    for alike in by_levels(studies) {
        errors(lines, &alike);
        observed_velocities(lines, &alike);
    }
    finest(lines, studies);
    drifts(lines, studies);
    rates(lines, studies);
    richardson(lines, studies);
}

/// The levels themselves, once for all cases that have the same.
fn settings(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    for (levels, names) in shared(studies.iter().map(|(name, study)| (*name, setting(study)))) {
        row(lines, "levels", &format!("{levels}{names}"));
    }
}

/// `8, 16, 32 cells; h = 0.125 ... 0.03125 m; dt = ... s; 4 ppc; 32 ... 128 particles; ... steps`.
fn setting(study: &Convergence) -> String {
    // A level that broke has taken fewer steps than it should.
    let levels = || study.levels.iter().filter(|level| level.run.failure.is_none());
    let span = |value: &dyn Fn(&LevelOutcome) -> Option<String>| {
        let mut values: Vec<String> = levels().filter_map(value).collect();
        values.dedup();
        match &values[..] {
            [] => None,
            [only] => Some(only.clone()),
            [first, .., last] => Some(format!("{first} ... {last}")),
        }
    };
    let all = level::names(study).join(", ");
    let count = |what: &str, value: &dyn Fn(&LevelOutcome) -> Option<String>| {
        span(value).map(|values| format!("{values} {what}"))
    };
    let of_axis = |axis: Axis, value: Option<String>| value.filter(|_| study.axis != axis);
    let refined = match study.axis {
        Axis::Space => format!("{all} cells"),
        Axis::Time => format!("dt = {all} s"),
        Axis::Particles => format!("{all} particles per cell"),
    };
    let parts = [
        Some(refined),
        of_axis(Axis::Space, count("cells", &|level| Some(level.cells.to_string()))),
        span(&|level| Some(format_number(level.h))).map(|h| format!("h = {h} m")),
        of_axis(Axis::Time, span(&|level| Some(format_number(level.dt))))
            .map(|dt| format!("dt = {dt} s")),
        of_axis(Axis::Particles, count("per cell", &|level| level.ppc.map(|ppc| ppc.to_string()))),
        count("particles", &|level| level.run.counters.particles.map(|count| count.to_string())),
        count("steps", &|level| Some(level.run.steps.to_string())),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join("; ")
}

/// Studies in groups with levels of the same names, judged by the same figure.
fn by_levels<'a>(studies: &[NamedStudy<'a>]) -> Vec<Vec<NamedStudy<'a>>> {
    let mut groups: Vec<(String, Vec<NamedStudy<'a>>)> = Vec::new();
    for (name, study) in studies.iter().filter(|(_, study)| study.compared) {
        let key = format!("{} {}", study.judged(), level::names(study).join(" "));
        match groups.iter_mut().find(|(known, _)| *known == key) {
            Some((_, group)) => group.push((name, study)),
            None => groups.push((key, vec![(name, study)])),
        }
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

/// Judged errors and their orders.
fn errors(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    let Some((_, first)) = studies.first() else { return };
    let judged = first.judged();
    if first.levels.len() == 1 {
        // Its error stands beside the verdict.
        return row(lines, "judged", &judged);
    }
    by_level(lines, &judged, studies, &[level::judged(), level::order()]);
}

fn observed_velocities(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    let is_observed = |(_, study): &&NamedStudy<'_>| study.history().is_some();
    let observed: Vec<NamedStudy<'_>> = studies.iter().filter(is_observed).copied().collect();
    let velocity = level::velocity();
    by_level(lines, velocity.about, &observed, &[level::velocity()]);
}

/// Columns level by level, under a heading.
fn by_level<'a>(
    lines: &mut Vec<String>,
    heading: &str,
    studies: &[NamedStudy<'a>],
    columns: &[LevelColumn<'a>],
) {
    let Some((_, first)) = studies.first() else { return };
    let mut headings = vec![level::name(first.axis).heading.into_owned()];
    for (k, column) in columns.iter().enumerate() {
        let names = level::names(first).into_iter();
        headings.extend(names.map(|name| if k == 0 { name } else { column.heading.to_string() }));
    }
    let cells = |(name, study): &NamedStudy<'a>| {
        let of_column = |column: &LevelColumn<'a>| {
            level::rows(study).map(|row| column.cell(&row).text).collect::<Vec<_>>()
        };
        let cells = columns.iter().flat_map(of_column);
        std::iter::once((*name).to_owned()).chain(cells).collect()
    };
    let rows = merged(studies.iter().map(cells).collect());
    lines.extend([String::new(), format!("  {heading}")]);
    lines.extend(Table::of_cells(headings, rows).without_empty_columns().lines());
}

/// A table with a row for each case, `row` being the level that stands for its study.
fn by_case<'a>(
    studies: &[NamedStudy<'a>],
    columns: &[LevelColumn<'a>],
    row: impl Fn(&'a Convergence, &LevelColumn<'a>) -> Option<LevelRow<'a>>,
) -> Option<Vec<String>> {
    let headings = columns.iter().map(|column| column.heading.to_string());
    let headings = std::iter::once("case".to_owned()).chain(headings).collect();
    let cells = |(name, study): &NamedStudy<'a>| {
        let cell = |column: &LevelColumn<'a>| {
            row(study, column).map_or("-".to_owned(), |row| column.cell(&row).text)
        };
        std::iter::once((*name).to_owned()).chain(columns.iter().map(cell)).collect()
    };
    let rows: Vec<Vec<String>> = studies.iter().map(cells).collect();
    let rows = without_zeros(rows);
    let is_empty = rows.iter().all(|row: &Vec<String>| row[1..].iter().all(|cell| cell == "-"));
    (!is_empty).then(|| Table::of_cells(headings, merged(rows)).without_empty_columns().lines())
}

/// Counts of which all are zero as dashes.
fn without_zeros(mut rows: Vec<Vec<String>>) -> Vec<Vec<String>> {
    for column in 0..rows.first().map_or(0, Vec::len) {
        if rows.iter().all(|row| row[column] == "0") {
            for row in &mut rows {
                "-".clone_into(&mut row[column]);
            }
        }
    }
    rows
}

/// Figures of the finest levels.
fn finest(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    let of_levels = ["particles", "steps"];
    let counters = level::counters().into_iter();
    let counters = counters.filter(|column| !of_levels.contains(&column.heading.as_ref()));
    let columns: Vec<LevelColumn<'_>> =
        level::largest_error().into_iter().chain(counters).collect();
    if let Some(table) = by_case(studies, &columns, |study, _| level::rows(study).last()) {
        lines.extend([String::new(), "  on the finest level".to_owned()]);
        lines.extend(table);
    }
}

/// How far totals drifted, of those that the suite asks for: the most over all levels.
fn drifts(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    let mut sums: Vec<Conserved> = Vec::new();
    for sum in studies.iter().flat_map(|(_, study)| &study.drifts) {
        if !sums.contains(sum) {
            sums.push(*sum);
        }
    }
    let asked: Vec<NamedStudy<'_>> =
        studies.iter().filter(|(_, study)| !study.drifts.is_empty()).copied().collect();
    let columns: Vec<LevelColumn<'_>> = sums.iter().map(|sum| level::drift(*sum)).collect();
    let most = |study, column: &LevelColumn<'_>| {
        let sum = sums.iter().find(|sum| sum.words() == column.heading)?;
        level::rows(study)
            .max_by(|a, b| level::drift_of(a, *sum).total_cmp(&level::drift_of(b, *sum)))
    };
    if let Some(table) = by_case(&asked, &columns, most) {
        lines.extend([String::new(), "  relative drift, the largest of all levels".to_owned()]);
        lines.extend(table);
    }
}

/// How fast the energy grows or decays on the finest level, where the suite asks.
fn rates(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    let rated: Vec<NamedStudy<'_>> =
        studies.iter().filter(|(_, study)| study.rated).copied().collect();
    if let Some(table) =
        by_case(&rated, &level::energy_rate(), |study, _| level::rows(study).last())
    {
        let heading = "  rate of the energy on the finest level, d ln E/dt (1/s)".to_owned();
        lines.extend([String::new(), heading]);
        lines.extend(table);
    }
}

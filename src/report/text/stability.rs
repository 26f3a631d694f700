//! Tables of a stability study.

use super::table::Table;
use crate::report::columns::stability::{self, limit_of, limit_text};
use crate::report::figure::{Map, MapField};
use crate::verify::{StabilityLimit, StabilityRow, StabilityStudy, SuiteOutcome, Trial};

/// The studies of a suite that seek a limit, with the names of their cases.
fn seeking(outcome: &SuiteOutcome) -> Vec<(&str, &StabilityStudy)> {
    outcome.results().filter(|(_, study): &(_, &StabilityStudy)| study.sought.is_some()).collect()
}

/// The limits of all cases in one table: a row for each case, a column for each value. Nothing
/// where no limit is sought, or a single case says it all.
pub(crate) fn overview(lines: &mut Vec<String>, outcome: &SuiteOutcome) {
    let studies = seeking(outcome);
    let [(_, first), _, ..] = studies[..] else { return };
    let sought = first.sought.as_deref().unwrap_or_default();
    lines.push(String::new());
    lines.extend(Table::new(&stability::overview(first, sought), studies.iter().copied()).lines());
}

/// The same as a figure.
pub(crate) fn map(outcome: &SuiteOutcome) -> Option<String> {
    let studies = seeking(outcome);
    let (_, first) = studies.first()?;
    let sought = first.sought.as_deref().unwrap_or_default();
    let field = |row: &StabilityRow| MapField {
        value: limit_of(row).and_then(StabilityLimit::value),
        text: limit_of(row).map_or("-".to_owned(), |found| match found {
            StabilityLimit::At(value) => format!("{value:.3}"),
            beyond => limit_text(beyond),
        }),
    };
    let row = |(name, study): &(&str, &StabilityStudy)| {
        ((*name).to_owned(), study.rows.iter().map(field).collect())
    };
    let map = Map {
        title: outcome.title.clone(),
        x_label: first.swept.clone(),
        z_label: format!("limit of {sought}"),
        columns: first.rows.iter().map(|row| row.value.to_string()).collect(),
        rows: merged(studies.iter().map(row).collect()),
    };
    Some(map.to_svg())
}

/// Rows with names without what all begin with, of which neighbours that show the same and are
/// called the same but for the last word are one: `flip-usf/musl`.
pub(crate) fn merged(rows: Vec<(String, Vec<MapField>)>) -> Vec<(String, Vec<MapField>)> {
    let first =
        |name: &str| name.split_once('-').map_or(String::new(), |(word, _)| word.to_owned());
    let common = rows.first().map(|(name, _)| first(name)).unwrap_or_default();
    let is_common = rows.iter().all(|(name, _)| first(name) == common);
    let mut kept: Vec<(String, Vec<MapField>)> = Vec::new();
    for (name, fields) in rows {
        let name = if is_common { name[common.len()..].trim_start_matches('-') } else { &name };
        let (stem, last) = name.rsplit_once('-').unwrap_or(("", name));
        match kept.last_mut() {
            Some((known, shown)) if shown_alike(shown, &fields) && stem_of(known) == stem => {
                *known += &format!("/{last}");
            }
            _ => kept.push((name.to_owned(), fields)),
        }
    }
    kept
}

fn stem_of(name: &str) -> &str {
    name.rsplit_once('-').map_or("", |(stem, _)| stem)
}

fn shown_alike(a: &[MapField], b: &[MapField]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.text == b.text)
}

/// One row for each value of the parameter that is swept.
pub(crate) fn tables(lines: &mut Vec<String>, study: &StabilityStudy) {
    match &study.sought {
        Some(sought) => limits(lines, study, sought),
        None => trials(lines, study),
    }
    for row in &study.rows {
        if let Some(reason) = &row.refused {
            lines.push(format!("  {} = {}: {reason}", study.swept, row.value));
        }
    }
}

fn trials(lines: &mut Vec<String>, study: &StabilityStudy) {
    let rows = study.rows.iter().filter(|row| row.trial.is_some());
    lines.extend(Table::new(&stability::trials(study), rows).lines());
    let trials = study.rows.iter().filter_map(|row| Some((row.value, row.trial.as_ref()?)));
    let why = |(value, trial): (f64, &Trial)| Some((value, trial.why.clone()?));
    for (value, why) in trials.filter_map(why) {
        lines.push(format!("  {} = {value}: {why}", study.swept));
    }
}

fn limits(lines: &mut Vec<String>, study: &StabilityStudy, sought: &str) {
    let rows = study.rows.iter().filter(|row| row.critical.is_some());
    let table = Table::new(&stability::limits(study, sought), rows);
    lines.extend(table.without_empty_columns().lines());
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(name: &str, text: &str) -> (String, Vec<MapField>) {
        (name.to_owned(), vec![MapField { value: None, text: text.to_owned() }])
    }

    #[test]
    fn neighbours_that_show_the_same_are_one_row() {
        let rows = vec![
            row("mpm-linear-flip-usl", "1"),
            row("mpm-linear-flip-usf", "2"),
            row("mpm-linear-flip-musl", "2"),
            row("mpm-linear-pic-usf", "2"),
            row("mpm-linear-pic-usl", "1"),
        ];
        let names: Vec<String> = merged(rows).into_iter().map(|(name, _)| name).collect();
        let expected =
            ["linear-flip-usl", "linear-flip-usf/musl", "linear-pic-usf", "linear-pic-usl"];
        assert_eq!(names, expected);
        assert_eq!(merged(vec![row("bar", "1"), row("rod", "1")]).len(), 1);
        assert!(merged(Vec::new()).is_empty());
    }
}

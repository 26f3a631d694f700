//! Tables of a stability study.

use super::table::Table;
use crate::report::columns::stability::{self, limit_of, limit_text};
use crate::report::columns::with_case;
use crate::report::figure::sweep::swept_map;
use crate::report::figure::{Map, MapField};
use crate::verify::{CaseOutcome, StabilityLimit, StabilityRow, StabilityStudy, SuiteOutcome};

/// Returns the map of all stability limits of a suite; `None` if no study searches for one.
pub(crate) fn map(outcome: &SuiteOutcome) -> Option<Map> {
    let studies = outcome.results(CaseOutcome::stability);
    let studies: Vec<_> = studies.filter(|(_, study)| study.sought.is_some()).collect();
    let (_, first) = studies.first()?;
    let sought = first.sought.as_deref().unwrap_or_default();
    let field = |row: &StabilityRow| MapField {
        value: limit_of(row).and_then(StabilityLimit::value),
        text: limit_of(row).map_or("-".to_owned(), |found| match found {
            StabilityLimit::At(value) => format!("{value:.3}"),
            beyond => limit_text(beyond),
        }),
    };
    Some(swept_map(outcome.title.clone(), format!("limit of {sought}"), &studies, field))
}

type NamedSweep<'a> = (&'a str, &'a StabilityStudy);

/// Adds tables of limits (by case and swept value) and of runs (a row for each case and value).
pub(crate) fn tables(lines: &mut Vec<String>, studies: &[NamedSweep<'_>]) {
    let (seeking, others): (Vec<NamedSweep<'_>>, Vec<NamedSweep<'_>>) =
        studies.iter().partition(|(_, study)| study.sought.is_some());
    limits(lines, &seeking);
    trials(lines, &others);
}

/// Returns remarks about values without a run, and about runs that stopped early.
pub(crate) fn remarks(study: &StabilityStudy) -> Vec<String> {
    let remark = |row: &StabilityRow| {
        let stopped = || row.trial.as_ref().and_then(|trial| trial.why.clone());
        let why = row.refused.as_ref().map(ToString::to_string).or_else(stopped)?;
        Some(format!("{} = {}: {why}", study.swept, row.value))
    };
    study.rows.iter().filter_map(remark).collect()
}

type NamedRow<'a> = (&'a str, &'a StabilityRow);

fn trials(lines: &mut Vec<String>, studies: &[NamedSweep<'_>]) {
    let Some((_, first)) = studies.first() else { return };
    let rows =
        studies.iter().flat_map(|(name, study)| study.rows.iter().map(move |row| (*name, row)));
    let tried: Vec<NamedRow<'_>> = rows.filter(|(_, row)| row.trial.is_some()).collect();
    lines.push(String::new());
    lines.extend(Table::new(&with_case(stability::trials(first)), tried).merged().lines());
}

fn limits(lines: &mut Vec<String>, studies: &[NamedSweep<'_>]) {
    let Some((_, first)) = studies.first() else { return };
    let sought = first.sought.as_deref().unwrap_or_default();
    let details = stability::limits(first, sought).into_iter().skip(1);
    for column in details {
        let values = first.rows.iter().map(|row| format!("{}={}", first.swept, row.value));
        let headings = std::iter::once(column.heading.to_string()).chain(values).collect();
        let cells = |(name, study): &NamedSweep<'_>| {
            let cells = study.rows.iter().map(|row| column.cell(row).text);
            std::iter::once((*name).to_owned()).chain(cells).collect()
        };
        let rows: Vec<Vec<String>> = studies.iter().map(cells).collect();
        if rows.iter().any(|row: &Vec<String>| row[1..].iter().any(|cell| cell != "-")) {
            lines.push(String::new());
            lines.extend(Table::of_cells(headings, rows).merged().lines());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::figure::map::merged_fields;

    fn row(name: &str, text: &str) -> (String, Vec<MapField>) {
        (name.to_owned(), vec![MapField { value: None, text: text.to_owned() }])
    }

    #[test]
    fn equal_neighbouring_rows_are_merged() {
        let rows = vec![
            row("mpm-linear-flip-usl", "1"),
            row("mpm-linear-flip-usf", "2"),
            row("mpm-linear-flip-musl", "2"),
            row("mpm-linear-pic-usf", "2"),
            row("mpm-linear-pic-usl", "1"),
        ];
        let names: Vec<String> = merged_fields(rows).into_iter().map(|(name, _)| name).collect();
        let expected =
            ["linear-flip-usl", "linear-flip-usf/musl", "linear-pic-usf", "linear-pic-usl"];
        assert_eq!(names, expected);
        assert_eq!(merged_fields(vec![row("bar", "1"), row("rod", "1")]).len(), 1);
        assert!(merged_fields(Vec::new()).is_empty());
    }
}

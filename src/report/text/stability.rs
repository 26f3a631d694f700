//! Tables of a stability study.

use super::table::{Table, optional, scientific};
use crate::{
    report::figure::{Field, Map},
    verify::{
        Critical, Prediction, StabilityLimit, StabilityRow, StabilityStudy, SuiteOutcome, Trial,
    },
};

/// The studies of a suite that seek a limit, with the names of their cases.
fn seeking(outcome: &SuiteOutcome) -> Vec<(&str, &StabilityStudy)> {
    outcome.stability_studies().filter(|(_, study)| study.sought.is_some()).collect()
}

/// The limits of all cases in one table: a row for each case, a column for each value. Nothing
/// where no limit is sought, or a single case says it all.
pub(crate) fn overview(lines: &mut Vec<String>, outcome: &SuiteOutcome) {
    let studies = seeking(outcome);
    let [(_, first), _, ..] = studies[..] else { return };
    let sought = first.sought.as_deref().unwrap_or_default();
    let heads: Vec<String> =
        first.rows.iter().map(|row| format!("{} = {}", first.swept, row.value)).collect();
    let title = format!("limit of {sought}");
    let heads: Vec<&str> =
        std::iter::once(title.as_str()).chain(heads.iter().map(String::as_str)).collect();
    let mut table = Table::new(&heads);
    for (name, study) in studies {
        let value = |row: &StabilityRow| optional(of_row(row).map(limit));
        let cells = std::iter::once(name.to_owned()).chain(study.rows.iter().map(value));
        table.row(cells.collect());
    }
    lines.push(String::new());
    lines.extend(table.flush_left(&[0]).lines());
}

fn of_row(row: &StabilityRow) -> Option<StabilityLimit> {
    row.critical.as_ref().and_then(Critical::limit)
}

/// The same as a figure.
pub(crate) fn map(outcome: &SuiteOutcome) -> Option<String> {
    let studies = seeking(outcome);
    let (_, first) = studies.first()?;
    let sought = first.sought.as_deref().unwrap_or_default();
    let field = |row: &StabilityRow| Field {
        value: of_row(row).and_then(StabilityLimit::value),
        text: of_row(row).map_or("-".to_owned(), |found| match found {
            StabilityLimit::At(value) => format!("{value:.3}"),
            beyond => limit(beyond),
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

/// Rows with names without what all begin with, of which neighbours that show the same and are called the
/// same but for the last word are one: `flip-usf/musl`.
pub(crate) fn merged(rows: Vec<(String, Vec<Field>)>) -> Vec<(String, Vec<Field>)> {
    let first =
        |name: &str| name.split_once('-').map_or(String::new(), |(word, _)| word.to_owned());
    let common = rows.first().map(|(name, _)| first(name)).unwrap_or_default();
    let is_common = rows.iter().all(|(name, _)| first(name) == common);
    let mut kept: Vec<(String, Vec<Field>)> = Vec::new();
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

fn shown_alike(a: &[Field], b: &[Field]) -> bool {
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
    let mut heads = vec![study.swept.as_str(), "verdict", "steps"];
    heads.extend(study.figures.iter().map(|figure| figure.head()));
    let mut table = Table::new(&heads);
    let trials = || study.rows.iter().filter_map(|row| Some((row.value, row.trial.as_ref()?)));
    for (value, trial) in trials() {
        let mut cells =
            vec![value.to_string(), trial.verdict.words().to_owned(), trial.steps.to_string()];
        cells.extend(study.figures.iter().map(|figure| short(figure.of(trial))));
        table.row(cells);
    }
    lines.extend(table.flush_left(&[1]).lines());
    let why = |(value, trial): (f64, &Trial)| Some((value, trial.why.clone()?));
    for (value, why) in trials().filter_map(why) {
        lines.push(format!("  {} = {value}: {why}", study.swept));
    }
}

fn limits(lines: &mut Vec<String>, study: &StabilityStudy, sought: &str) {
    let confirmed: Vec<f64> = study
        .rows
        .iter()
        .filter_map(|row| row.critical.as_ref())
        .max_by_key(|critical| critical.confirmed.len())
        .map_or(Vec::new(), |critical| {
            critical.confirmed.iter().map(|(share, _)| *share).collect()
        });
    let mut heads = vec![study.swept.clone(), format!("predicted {sought}")];
    heads.extend(["leaves at".to_owned(), format!("observed {sought}")]);
    heads.extend(confirmed.iter().map(|share| format!("at {share}")));
    let heads: Vec<&str> = heads.iter().map(String::as_str).collect();
    let mut table = Table::new(&heads);
    for (row, critical) in study.rows.iter().filter_map(|row| Some((row, row.critical.as_ref()?))) {
        table.row(cells(row, critical, confirmed.len()));
    }
    lines.extend(table.without_empty_columns().lines());
}

fn cells(row: &StabilityRow, critical: &Critical, runs: usize) -> Vec<String> {
    let mut cells = vec![
        row.value.to_string(),
        optional(critical.predicted.map(|prediction| limit(prediction.limit))),
        optional(critical.predicted.as_ref().and_then(leaves)),
        optional(critical.observed.map(limit)),
    ];
    let words = |(_, trial): &(f64, Trial)| trial.verdict.words().to_owned();
    cells.extend(critical.confirmed.iter().map(words));
    cells.resize(4 + runs, "-".to_owned());
    cells
}

fn limit(limit: StabilityLimit) -> String {
    match limit {
        StabilityLimit::At(value) => format!("{value:.4}"),
        StabilityLimit::Above(high) => format!("> {high}"),
        StabilityLimit::Below(low) => format!("< {low}"),
    }
}

/// Where in the complex plane the eigenvalue leaves the unit circle.
fn leaves(prediction: &Prediction) -> Option<String> {
    let (re, im) = prediction.leaves?;
    Some(if im == 0.0 { format!("{re:.2}") } else { format!("{re:.2} +- {im:.2} i") })
}

fn short(value: f64) -> String {
    if value.is_nan() { "-".to_owned() } else { scientific(value) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(name: &str, text: &str) -> (String, Vec<Field>) {
        (name.to_owned(), vec![Field { value: None, text: text.to_owned() }])
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

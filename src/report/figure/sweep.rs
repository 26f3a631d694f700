//! Figures of runs over a swept parameter: a map for each reported quantity.

use super::map::{column_head, merged_fields};
use super::{Figure, Map, MapField};
use crate::verify::{
    CaseOutcome, RunFigure, Stability, StabilityRow, StabilityStudy, SuiteOutcome,
};

pub(crate) fn figures(outcome: &SuiteOutcome) -> Vec<Figure> {
    let studies = outcome.results(CaseOutcome::stability);
    let studies: Vec<_> = studies.filter(|(_, study)| study.sought.is_none()).collect();
    let Some((_, first)) = studies.first() else { return Vec::new() };
    if first.rows.len() < 2 && studies.len() < 2 {
        return Vec::new();
    }
    first.figures.iter().map(|figure| map(outcome, &studies, *figure)).collect()
}

/// Formats a value with three digits, which fit into a map field.
fn short(value: f64) -> String {
    match value.abs() {
        size if size.is_nan() => "failed".to_owned(),
        size if size >= 1e4 || (size < 1e-3 && size > 0.0) => format!("{value:.1e}"),
        size if size >= 100.0 => format!("{value:.0}"),
        size if size >= 1.0 => format!("{value:.2}"),
        size if size >= 0.1 => format!("{value:.3}"),
        _ => format!("{value:.4}"),
    }
}

fn map(outcome: &SuiteOutcome, studies: &[(&str, &StabilityStudy)], figure: RunFigure) -> Figure {
    let field = |row: &StabilityRow| {
        let ended = row.trial.as_ref().filter(|trial| trial.verdict != Stability::Failed);
        let value = ended.map_or(f64::NAN, |trial| figure.of(trial));
        MapField { value: Some(value), text: short(value) }
    };
    let title = format!("{}: {}", outcome.title, figure.head());
    let map = swept_map(title, figure.head().to_owned(), studies, field);
    let file = format!("{}-{}.svg", outcome.suite, figure.name());
    Figure { file, svg: map.to_svg(), pgfplots: map.to_pgfplots() }
}

/// Creates a map with a row for each case and a column for each value of the swept parameter.
pub(crate) fn swept_map(
    title: String,
    z_label: String,
    studies: &[(&str, &StabilityStudy)],
    field: impl Fn(&StabilityRow) -> MapField,
) -> Map {
    let fields = |study: &StabilityStudy| study.rows.iter().map(&field).collect();
    let rows = studies.iter().map(|(name, study)| ((*name).to_owned(), fields(study))).collect();
    let first = studies.first().map(|(_, study)| study);
    let values = first.into_iter().flat_map(|study| &study.rows);
    Map {
        title,
        x_label: first.map_or(String::new(), |study| format!("parameter {}", study.swept)),
        z_label,
        columns: values.map(|row| column_head(row.value)).collect(),
        rows: merged_fields(rows),
    }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn three_digits_fit_into_a_field() {
        let values = [f64::NAN, 0.0, -12.345, 0.10351, 0.0104, 1e-9, 6543.2, 2.5e7];
        let expected = ["failed", "0.0000", "-12.35", "0.104", "0.0104", "1.0e-9", "6543", "2.5e7"];
        assert_eq!(values.map(short), expected);
    }
}

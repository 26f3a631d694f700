//! Tables of a stability study.

use super::table::{Table, merged_blocks};
use crate::report::columns::stability::{self, ledger_text, limit_of, limit_text};
use crate::report::columns::with_case;
use crate::report::figure::sweep::swept_map;
use crate::report::figure::{Map, MapField};
use crate::subject::{EnergyBalance, LedgerStage};
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
    ledgers(lines, &others);
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

/// Adds the energy ledgers: a block of rows for each case, a row for each stage, and a column for
/// each value of the swept parameter. Stages whose entries are all rounding errors have no row.
fn ledgers(lines: &mut Vec<String>, studies: &[NamedSweep<'_>]) {
    let Some((_, first)) = studies.first() else { return };
    let values = first.rows.iter().map(|row| format!("{}={}", first.swept, row.value));
    let headings = ["case", "energy (J)"].map(str::to_owned).into_iter().chain(values).collect();
    let blocks = studies.iter().filter_map(|(name, study)| {
        let balance = |row: &StabilityRow| row.trial.as_ref().and_then(|trial| trial.ledger);
        let balances: Option<Vec<EnergyBalance>> = study.rows.iter().map(balance).collect();
        Some(((*name).to_owned(), ledger(&balances?)))
    });
    let rows = merged_blocks(blocks);
    if !rows.is_empty() {
        lines.push(String::new());
        lines.extend(Table::of_cells(headings, rows).flush_left(&["energy (J)"]).lines());
    }
}

fn ledger(balances: &[EnergyBalance]) -> Vec<Vec<String>> {
    let row = |head: String, value: &dyn Fn(&EnergyBalance) -> f64| {
        let cells = balances.iter().map(|balance| ledger_text(value(balance), balance.size()));
        std::iter::once(head).chain(cells).collect::<Vec<String>>()
    };
    let stages = LedgerStage::ALL.iter().map(|stage| {
        row(stage.name().replace('_', " "), &|balance: &EnergyBalance| balance.entry(*stage))
    });
    let stages = stages.filter(|row| row[1..].iter().any(|cell| cell != "0"));
    let sums = [
        row("transfer gain".to_owned(), &EnergyBalance::transfer_gain),
        row("stress work error".to_owned(), &EnergyBalance::stress_work_error),
        row("change".to_owned(), &EnergyBalance::change),
    ];
    stages.chain(sums).collect()
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

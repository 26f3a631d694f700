//! Overview of all suites: the findings for each basis.

use super::verdicts;
use crate::report::matrix::{COLUMNS, LEGEND, by_group, failures, finding, findings};
use crate::report::text::prose::{paragraph_lines, row, row_of_width};
use crate::report::text::table::Table;
use crate::verify::{CaseOutcome, CaseResult, Convergence, SuiteOutcome};

/// Width of the column with the names of suites, fixed for the snapshot.
const SUITE: usize = 33;

/// Maximum number of suites that [`glance`] lists one by one.
const MOST_LISTED: usize = 25;

/// Returns one line for each suite, or one for each group if there are many suites.
pub fn glance(outcomes: &[SuiteOutcome]) -> String {
    let table = if outcomes.len() > MOST_LISTED {
        let row = |(group, suites): (&str, Vec<&SuiteOutcome>)| {
            let cases = || suites.iter().flat_map(|suite| &suite.cases);
            let (suites, count) = (suites.len().to_string(), cases().count().to_string());
            vec![group.to_owned(), suites, count, verdicts::counts(cases())]
        };
        let headings = ["group", "suites", "cases", "results"].map(str::to_owned);
        Table::of_cells(headings.into(), groups(outcomes).into_iter().map(row).collect())
    } else {
        let row = |suite: &&SuiteOutcome| {
            let orders = finding(&suite.cases.iter().collect::<Vec<_>>());
            vec![suite.suite.clone(), orders, verdicts::counts(suite.cases.iter())]
        };
        let headings = ["suite", "orders", "results"].map(str::to_owned);
        let suites = groups(outcomes).into_iter().flat_map(|(_, suites)| suites);
        Table::of_cells(headings.into(), suites.map(|suite| row(&suite)).collect())
    };
    table.flush_left(&["orders", "results"]).lines().join("\n") + "\n"
}

/// Returns an overview of suites: a summary, and the findings of each suite by basis, in groups. A
/// change of a suite changes only its own lines.
pub fn overview(outcomes: &[SuiteOutcome]) -> String {
    let mut lines = vec!["Overview of all suites".to_owned(), String::new()];
    let cases: Vec<&CaseOutcome> = outcomes.iter().flat_map(|suite| &suite.cases).collect();
    row(&mut lines, "result", &verdicts::counts(cases.iter().copied()));
    for suite in outcomes.iter().filter(|suite| !suite.passed()) {
        row(&mut lines, CaseResult::Fail.name(), &suite.suite);
    }
    if let Some(estimates) = estimates(&cases) {
        row(&mut lines, "estimates", &estimates);
    }
    lines.extend([
        String::new(),
        "  Suites where a method fails, as expected or not (low order: below the expected order):"
            .to_owned(),
    ]);
    for (column, basis) in COLUMNS.iter().enumerate() {
        let failing = failures(outcomes, column).into_iter();
        let failing = failing.map(|(suite, words)| format!("{suite} ({})", words.join(", ")));
        let failing = failing.collect::<Vec<_>>().join(", ");
        if !failing.is_empty() {
            row_of_width(&mut lines, 20, basis, &failing);
        }
    }
    lines.push(String::new());
    paragraph_lines(&mut lines, LEGEND);
    lines.push(String::new());
    row_of_width(&mut lines, SUITE, "suite", "findings by basis");
    for (group, suites) in groups(outcomes) {
        lines.push(group.to_owned());
        for suite in suites {
            let named = COLUMNS.iter().zip(findings(suite)).filter(|(_, finding)| finding != "-");
            let named = named.map(|(basis, finding)| format!("{basis} {finding}"));
            row_of_width(&mut lines, SUITE, &suite.suite, &named.collect::<Vec<_>>().join(", "));
        }
    }
    lines.join("\n") + "\n"
}

/// Counts the 95 % intervals of extrapolated values that contain the exact value.
fn estimates(cases: &[&CaseOutcome]) -> Option<String> {
    let studies: Vec<&Convergence> = cases.iter().filter_map(|case| case.convergence()).collect();
    let results = studies.iter().filter_map(|study| study.observed_limit);
    let refused = results.clone().filter(Result::is_err).count();
    let all = results.count();
    let covered: Vec<bool> = studies.iter().filter_map(|study| study.limit_is_covered()).collect();
    let hits = covered.iter().filter(|covered| **covered).count();
    (all > 0).then(|| {
        format!(
            "extrapolated displacement at the observed point: the 95 % interval contains the exact \
             value in {hits} of {} cases; {refused} of {all} cases have no estimate",
            covered.len()
        )
    })
}

fn groups(outcomes: &[SuiteOutcome]) -> Vec<(&str, Vec<&SuiteOutcome>)> {
    by_group(outcomes, |suite| suite)
}

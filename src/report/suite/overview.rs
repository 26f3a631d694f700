//! Overview of all suites: the matrix of problems and methods, and one line for each case.

use super::verdicts;
use crate::report::matrix::{COLUMNS, LEGEND, by_group, failures, findings};
use crate::report::text::prose::{paragraph_lines, row, row_of_width};
use crate::report::text::table::Table;
use crate::verify::{CaseOutcome, Convergence, SuiteOutcome};

/// Column widths in the overview of all suites. The widths are fixed, because the overview is
/// stored as a snapshot.
const WIDTHS: [(&str, usize); 16] = [
    ("suite", 31),
    ("linear", BASIS),
    ("uGIMP", BASIS),
    ("cpGIMP", BASIS),
    ("CPDI", BASIS),
    ("quadratic B-spline", 18),
    ("cubic B-spline", BASIS),
    ("FEM", BASIS),
    ("other", BASIS),
    ("case", 38),
    ("verdict", 14),
    ("95 % interval", 14),
    ("error, finest level", 19),
    ("floor", 9),
    ("for 1e-3", 8),
    ("observed", 66),
];

/// Width of a column with the orders and verdicts of one basis.
const BASIS: usize = 15;

/// Returns a short overview of suites: the result, and the matrix of problems and methods.
pub fn glance(outcomes: &[SuiteOutcome]) -> String {
    at_a_glance(outcomes, Table::lines)
}

fn at_a_glance(outcomes: &[SuiteOutcome], lines_of: fn(&Table) -> Vec<String>) -> String {
    let mut lines = Vec::new();
    let cases: Vec<&CaseOutcome> = outcomes.iter().flat_map(|suite| &suite.cases).collect();
    row(&mut lines, "result", &verdicts::result(&cases));
    for suite in outcomes.iter().filter(|suite| !suite.passed()) {
        row(&mut lines, "NOT AS EXPECTED", &suite.suite);
    }
    if let Some(estimates) = estimates(&cases) {
        row(&mut lines, "estimates", &estimates);
    }
    lines.extend([
        String::new(),
        "  Suites in which some method with the given basis fails, whether expected or not:"
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
    grouped(&mut lines, outcomes, lines_of(&matrix(outcomes)));
    lines.join("\n") + "\n"
}

/// Returns an overview of suites: a summary, and one line for each case, in groups. Columns have
/// fixed widths, so that a change of a case changes only one line.
pub fn overview(outcomes: &[SuiteOutcome]) -> String {
    let fixed = |table: &Table| table.lines_of_widths(&WIDTHS);
    let mut lines = vec!["Overview of all suites".to_owned(), String::new()];
    lines.push(at_a_glance(outcomes, fixed).trim_end().to_owned());
    for (group, suites) in groups(outcomes) {
        lines.extend([String::new(), format!("== {group} ==")]);
        for suite in suites {
            lines.extend([String::new(), format!("  {}: {}", suite.suite, suite.title)]);
            let rankings = crate::verify::by_transfers(&suite.cases);
            lines.extend(fixed(&verdicts::table(&suite.cases, &rankings)));
        }
    }
    lines.join("\n") + "\n"
}

/// Reports how many 95 % intervals of extrapolated values contain the exact value, and how many
/// cases have no estimate.
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

fn matrix(outcomes: &[SuiteOutcome]) -> Table {
    let headings = ["suite"].iter().chain(&COLUMNS).map(|heading| (*heading).to_owned());
    let row = |suite: &&SuiteOutcome| {
        std::iter::once(suite.suite.clone()).chain(findings(suite)).collect()
    };
    let suites = groups(outcomes).into_iter().flat_map(|(_, suites)| suites);
    let rows = suites.map(|suite| row(&suite)).collect();
    Table::of_cells(headings.collect(), rows).without_empty_columns()
}

/// Adds the lines of a table, with the name of each group above its suites.
fn grouped(lines: &mut Vec<String>, outcomes: &[SuiteOutcome], table: Vec<String>) {
    let mut table = table.into_iter();
    lines.push(String::new());
    lines.extend(table.next());
    for (group, suites) in groups(outcomes) {
        lines.push(group.to_owned());
        lines.extend(table.by_ref().take(suites.len()));
    }
}

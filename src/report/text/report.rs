//! The report as text: aligned tables that read well in a diff.
//!
//! Errors have four significant digits, orders two decimals; counters are exact. Nothing in it
//! depends on the machine.

use super::cost;
use super::profile::profile;
use super::prose::{paragraph_lines, row};
use super::table::Table;
use crate::report::columns::TableColumn;
use crate::report::study::KINDS;
use crate::verify::{CaseOutcome, SuiteOutcome};

/// The whole report of a suite.
pub fn text(outcome: &SuiteOutcome) -> String {
    let mut lines = vec![format!("{}: {}", outcome.suite, outcome.title), String::new()];
    for paragraph in outcome.about.split("\n\n") {
        paragraph_lines(&mut lines, paragraph);
    }
    lines.push(String::new());
    row(&mut lines, "source", &outcome.source);
    for (key, value) in &outcome.statement {
        row(&mut lines, key, value);
    }
    for kind in KINDS {
        kind.overview(&mut lines, outcome);
    }
    for case in &outcome.cases {
        lines.push(String::new());
        case_lines(&mut lines, case);
    }
    for ranking in cost::by_transfers(outcome) {
        lines.push(String::new());
        lines.extend(cost::cost(&ranking, cost::TRANSFERS).lines().map(str::to_owned));
    }
    lines.join("\n") + "\n"
}

/// The report of one case, for failing tests.
pub fn case(outcome: &CaseOutcome) -> String {
    let mut lines = Vec::new();
    case_lines(&mut lines, outcome);
    lines.join("\n") + "\n"
}

/// One line for each case: the table that `run` prints.
pub fn summary(outcomes: &[SuiteOutcome]) -> String {
    let rows = outcomes.iter().flat_map(|suite| suite.cases.iter().map(move |case| (suite, case)));
    Table::new(&verdicts(), rows).lines().join("\n") + "\n"
}

type SuiteCase<'a> = (&'a SuiteOutcome, &'a CaseOutcome);

fn verdicts<'a>() -> [TableColumn<'a, SuiteCase<'a>>; 5] {
    [
        TableColumn::<SuiteCase<'a>>::text("", "whether all is as expected", |(_, case)| {
            case.result()
        }),
        TableColumn::<SuiteCase<'a>>::text("case", "suite and case", |(suite, case)| {
            format!("{}::{}", suite.suite, case.case)
        })
        .flush_left(),
        TableColumn::<SuiteCase<'a>>::text("verdict", "verdict", |(_, case)| case.verdict.clone())
            .flush_left(),
        TableColumn::<SuiteCase<'a>>::text("order", "observed order", move |(_, case)| {
            case.convergence().and_then(|study| study.judgement.order).map(|order| order.shown())
        }),
        TableColumn::<SuiteCase<'a>>::text("expected", "expected", |(_, case)| {
            case.expected.clone().unwrap_or("nothing".to_owned())
        })
        .flush_left(),
    ]
}

fn case_lines(lines: &mut Vec<String>, case: &CaseOutcome) {
    lines.push(format!("== {} ==", case.case));
    let settings: Vec<String> =
        case.settings.iter().map(|(key, value)| format!("{key}: {value}")).collect();
    row(lines, "method", &settings.join("; "));
    for (key, value) in case.profile.iter().flat_map(profile) {
        row(lines, key, &value);
    }
    lines.push(String::new());
    for kind in KINDS {
        kind.tables(lines, case);
    }
    lines.push(String::new());
    row(lines, "verdict", &format!("{}: {}", case.verdict, case.reason));
    row(lines, "expected", &case.expectation());
    if case.passed() {
        row(lines, "result", if case.expected.is_some() { "as expected" } else { "explored" });
    }
    for unmet in &case.unmet {
        row(lines, "result", &format!("NOT AS EXPECTED: {unmet}"));
    }
}

//! Reports as text: aligned tables that are readable in a diff.
//!
//! Errors have four significant digits, orders two decimals. Counters are exact. Reports do not
//! depend on the machine.

use super::verdicts;
use crate::report::columns::TableColumn;
use crate::report::study::KINDS;
use crate::report::text::profile::effects;
use crate::report::text::prose::{paragraph_lines, row, row_of_width, section};
use crate::report::text::table::{Table, shared};
use crate::verify::{CaseOutcome, SuiteOutcome, Verdict};

/// Returns the complete report of a suite.
pub fn text(outcome: &SuiteOutcome) -> String {
    let mut lines = Vec::new();
    paragraph_lines(&mut lines, &format!("{}: {}", outcome.suite, outcome.title));
    lines.push(String::new());
    verdicts::head(&mut lines, &outcome.cases);
    lines.push(String::new());
    if !outcome.about.is_empty() {
        paragraph_lines(&mut lines, first_sentence(&outcome.about));
        lines.push(String::new());
    }
    row(&mut lines, "source", &outcome.source);
    problem(&mut lines, &outcome.statement);
    in_common(&mut lines, &outcome.cases);
    for kind in KINDS {
        (kind.tables)(&mut lines, &outcome.cases);
    }
    lines.join("\n") + "\n"
}

fn problem(lines: &mut Vec<String>, statement: &[(String, String)]) {
    // The error table has the judged quantity; the equation follows from the material.
    let is_known = |(key, value): &&(String, String)| match key.as_str() {
        "judged" | "equation" => true,
        "crossing levels" => value == "counted",
        _ => false,
    };
    let facts = statement.iter().filter(|row| !is_known(row));
    section(lines, "problem", facts.map(|(key, value)| (key.as_str(), value.as_str())));
}

/// Returns the report of one case, for failing tests.
pub fn case(outcome: &CaseOutcome) -> String {
    let mut lines = Vec::new();
    let cases = std::slice::from_ref(outcome);
    verdicts::head(&mut lines, cases);
    lines.push(String::new());
    in_common(&mut lines, cases);
    for kind in KINDS {
        (kind.tables)(&mut lines, cases);
    }
    lines.join("\n") + "\n"
}

/// Adds the settings that all cases have in common. The other settings are part of the case names.
fn in_common(lines: &mut Vec<String>, cases: &[CaseOutcome]) {
    let Some((first, others)) = cases.split_first() else { return };
    let is_common =
        |setting: &&(String, String)| others.iter().all(|case| case.settings.contains(setting));
    let mut settings = first.settings.iter().filter(is_common).peekable();
    if settings.peek().is_some() {
        let facts = settings.map(|(key, value)| (key.as_str(), value.as_str()));
        section(lines, "methods", facts);
    }
    let of_case = |case: &'_ CaseOutcome| Some(effects(case.profile.as_ref()?, "none"));
    let cases = cases.iter().filter_map(|case| Some((case.case.as_str(), of_case(case)?)));
    for (effects, names) in shared(cases) {
        row(lines, "effects", &format!("{effects}{names}"));
    }
}

/// Returns the first sentence of a text. The suite file contains the complete text.
fn first_sentence(text: &str) -> &str {
    let ends = |(at, _): &(usize, &str)| {
        text[at + 2..].starts_with(char::is_uppercase) && !text[..*at].ends_with(char::is_uppercase)
    };
    text.match_indices(". ").find(ends).map_or(text, |(at, _)| &text[..=at])
}

/// Returns a table with one line for each case, as printed by `run`, followed by the expectation or
/// the reason why the case was not tested.
pub fn summary(outcomes: &[SuiteOutcome]) -> String {
    let rows = outcomes.iter().flat_map(|suite| suite.cases.iter().map(move |case| (suite, case)));
    let cases: Vec<SuiteCase<'_>> = rows.collect();
    let mut table = Table::new(&verdicts(), &cases).lines().into_iter();
    let mut lines: Vec<String> = table.next().into_iter().collect();
    for (line, (_, case)) in table.zip(cases) {
        lines.push(line);
        if let Some(expected) = expected(case) {
            row_of_width(&mut lines, 4, "", &expected);
        }
    }
    lines.join("\n") + "\n"
}

fn expected(case: &CaseOutcome) -> Option<String> {
    match &case.expected {
        _ if !case.is_tested() => Some(case.reason.clone()),
        // The cause of a failure is in no column.
        expected if case.verdict == Verdict::Failed.name() => {
            Some(format!("expected: {}; {}", expected.as_deref().unwrap_or("nothing"), case.reason))
        }
        expected => expected.as_ref().map(|expected| format!("expected: {expected}")),
    }
}

type SuiteCase<'a> = (&'a SuiteOutcome, &'a CaseOutcome);

fn verdicts<'a>() -> [TableColumn<'a, SuiteCase<'a>>; 4] {
    type VerdictColumn<'a> = TableColumn<'a, SuiteCase<'a>>;
    [
        VerdictColumn::text("", "result of the case", |(_, case)| case.result().name()),
        VerdictColumn::text("case", "suite and case", |(suite, case)| {
            format!("{}::{}", suite.suite, case.case)
        })
        .flush_left(),
        VerdictColumn::text("verdict", "verdict", |(_, case)| case.verdict.clone()).flush_left(),
        VerdictColumn::text("order", "observed order", move |(_, case)| {
            case.convergence().and_then(|study| study.judgement.order).map(|order| order.shown())
        }),
    ]
}

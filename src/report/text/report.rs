//! The report as text: aligned tables that read well in a diff.
//!
//! Errors have four significant digits, orders two decimals; counters are exact. Nothing in it
//! depends on the machine.

use super::{cost, levels, profile::profile, stability, table::Table};
use crate::{
    report::columns::{Column, force},
    verify::{CaseOutcome, Convergence, Interval, LevelOutcome, Study, SuiteOutcome},
};

/// Width to which prose is wrapped.
const WIDTH: usize = 100;

/// The whole report of a suite.
pub fn text(outcome: &SuiteOutcome) -> String {
    let mut lines = vec![format!("{}: {}", outcome.suite, outcome.title), String::new()];
    for paragraph in outcome.about.split("\n\n") {
        wrap(&mut lines, WIDTH, paragraph);
    }
    lines.push(String::new());
    row(&mut lines, "source", &outcome.source);
    for (key, value) in &outcome.statement {
        row(&mut lines, key, value);
    }
    stability::overview(&mut lines, outcome);
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

fn verdicts<'a>() -> [Column<'a, SuiteCase<'a>>; 5] {
    let interval = |o: Interval| format!("{:.2} [{:.2}, {:.2}]", o.value, o.low, o.high);
    [
        Column::<SuiteCase<'a>>::text("", "whether all is as expected", |(_, case)| {
            if case.passed() { "pass" } else { "FAIL" }
        }),
        Column::<SuiteCase<'a>>::text("case", "suite and case", |(suite, case)| {
            format!("{}::{}", suite.suite, case.case)
        })
        .flush_left(),
        Column::<SuiteCase<'a>>::text("verdict", "verdict", |(_, case)| case.verdict.clone())
            .flush_left(),
        Column::<SuiteCase<'a>>::text("order", "observed order", move |(_, case)| {
            case.convergence().and_then(|study| study.judgement.order).map(interval)
        }),
        Column::<SuiteCase<'a>>::text("expected", "expected", |(_, case)| case.expected.clone())
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
    match &case.study {
        Study::Convergence(study) => convergence(lines, study),
        Study::InternalForce(rows) => lines.extend(Table::new(&force::columns(), rows).lines()),
        Study::Stability(study) => stability::tables(lines, study),
        Study::Refused => {}
    }
    lines.push(String::new());
    row(lines, "verdict", &format!("{}: {}", case.verdict, case.reason));
    row(lines, "expected", &format!("{}, because {}", case.expected, case.because));
    if case.passed() {
        row(lines, "result", "as expected");
    }
    for unmet in &case.unmet {
        row(lines, "result", &format!("NOT AS EXPECTED: {unmet}"));
    }
}

fn convergence(lines: &mut Vec<String>, study: &Convergence) {
    levels::tables(lines, study);
    let too_long: Vec<String> = study
        .levels
        .iter()
        .filter(|level| level.is_too_long())
        .map(|level| level.name(study.axis))
        .collect();
    if !too_long.is_empty() {
        lines.push(String::new());
        let text = "steps are longer than any that is known to be safe";
        row(lines, "warning", &format!("{}: {text}", too_long.join(", ")));
    }
    let failure = |level: &LevelOutcome| Some((level.name(study.axis), level.run.failure.clone()?));
    for (level, failure) in study.levels.iter().filter_map(failure) {
        lines.push(String::new());
        row(lines, "failure", &format!("{level}: {failure}"));
    }
    if let Some(lost) = order_lost(study) {
        lines.push(String::new());
        row(lines, "crossing", &lost);
    }
}

/// Where particles begin to change their cell, and what that does to the order.
fn order_lost(study: &Convergence) -> Option<String> {
    let first = study.levels.iter().find(|level| level.run.counters.crossings.unwrap_or(0) > 0)?;
    let crossings = first.run.counters.crossings?;
    let finest = study.levels.last()?;
    if study.levels.len() == 1 {
        return Some(format!("particles change their cell {crossings} times"));
    }
    let pair = |level: &LevelOutcome| {
        level.order.map_or("no order".to_owned(), |order| format!("order {order:.2}"))
    };
    Some(format!(
        "particles change their cell from {} on ({crossings} crossings, {} against the next \
         coarser level); on the finest level, {}, {} crossings and {}",
        first.name(study.axis),
        pair(first),
        finest.name(study.axis),
        finest.run.counters.crossings.unwrap_or(0),
        pair(finest),
    ))
}

/// `key` in a column of its own, `value` wrapped beside it.
fn row(lines: &mut Vec<String>, key: &str, value: &str) {
    const KEY: usize = 18;
    let mut wrapped = Vec::new();
    wrap(&mut wrapped, WIDTH - KEY - 2, value);
    for (i, line) in wrapped.iter().enumerate() {
        let key = if i == 0 { key } else { "" };
        lines.push(format!("  {key:KEY$}{line}").trim_end().to_owned());
    }
}

/// Wraps prose at word boundaries.
fn wrap(lines: &mut Vec<String>, width: usize, prose: &str) {
    let mut line = String::new();
    for word in prose.split_whitespace() {
        if !line.is_empty() && line.chars().count() + 1 + word.chars().count() > width {
            lines.push(std::mem::take(&mut line));
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    lines.push(line);
}

//! Reads the results of a run from its snapshots: the overview and the reports of its suites.

use super::document::JsonNumber;
use super::document::{CaseDocument, LevelDocument, OrderDocument, ReportDocument, SuiteDocument};
use crate::report::text::prose::KEYS;

/// Name used as refinement axis if the snapshot contains only the finest level.
pub(super) const FINEST: &str = "finest";

impl ReportDocument {
    /// Reads the names of the suites from the overview, and their results from their reports.
    /// `report` returns the report of a suite, given its group and name, if there is one.
    pub fn of_snapshots(overview: &str, report: impl Fn(&str, &str) -> Option<String>) -> Self {
        let (mut suites, mut group) = (Vec::new(), "");
        let rows = overview.lines().skip_while(|line| !line.starts_with("  suite ")).skip(1);
        for line in rows.take_while(|line| !line.is_empty()) {
            if !line.starts_with(' ') {
                group = line;
                continue;
            }
            // Lines that continue a wrapped line have a wider indent.
            if line.starts_with("   ") {
                continue;
            }
            let name = line.split_whitespace().next().unwrap_or_default();
            let report = report(group, name).unwrap_or_default();
            suites.push(SuiteDocument {
                name: name.to_owned(),
                statement: statement(&report),
                cases: cases(&report),
                cost: Vec::new(),
            });
        }
        Self { suites }
    }
}

/// Reads the table of verdicts. A row that several cases share is a case for each of them.
fn cases(report: &str) -> Vec<CaseDocument> {
    let mut rows = report.lines().skip_while(|line| !line.starts_with("  case ")).map(cells);
    let headings = rows.next().unwrap_or_default();
    // A second block of columns begins with the same heading.
    let rows = rows.take_while(|cells| cells.first().is_some_and(|first| *first != "case"));
    let read = |cells: Vec<&str>| {
        let value = |heading: &str| {
            let at = headings.iter().position(|known| *known == heading)?;
            cells.get(at).copied().filter(|cell| *cell != "-")
        };
        names(cells[0]).into_iter().map(|name| case(&name, value)).collect::<Vec<_>>()
    };
    rows.flat_map(read).collect()
}

/// Expands a name with choices in braces: `mpm-{linear,ugimp}-flip`.
fn names(text: &str) -> Vec<String> {
    let choices = text.split_once('{').and_then(|(before, rest)| {
        let (choices, after) = rest.split_once('}')?;
        Some((before, choices, after))
    });
    let Some((before, choices, after)) = choices else { return vec![text.to_owned()] };
    let after = names(after);
    let with = |choice: &str| {
        after.iter().map(|after| format!("{before}{choice}{after}")).collect::<Vec<_>>()
    };
    choices.split(',').flat_map(with).collect()
}

/// Splits a table line into its cells, which are separated by at least two spaces.
fn cells(line: &str) -> Vec<&str> {
    line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect()
}

fn case<'a>(name: &str, value: impl Fn(&str) -> Option<&'a str>) -> CaseDocument {
    let number = |heading| value(heading).and_then(|text| text.parse().ok()).map(JsonNumber);
    // Snapshots of former versions have another heading.
    let error = value("error").or_else(|| value("error, finest level"));
    let one = JsonNumber(1.0);
    let level = |error: &str| LevelDocument {
        cells: 1,
        h: one,
        spacing: one,
        ppc: None,
        transfers: 0,
        judged: error.parse().ok().map(JsonNumber),
        counts: None,
        failure: (error == "failed").then(String::new),
    };
    CaseDocument {
        name: name.to_owned(),
        verdict: value("verdict").unwrap_or_default().to_owned(),
        // Snapshots of former versions have another word.
        passed: !matches!(value("result"), Some("FAIL" | "NOT AS EXPECTED")),
        unmet: Vec::new(),
        judge: None,
        axis: Some(FINEST.to_owned()),
        observed_order: number("order").map(|value| OrderDocument { value }),
        levels: error.map(level).into_iter().collect(),
        stability: None,
    }
}

/// Returns the facts in the section `problem`, which reports of former versions do not have.
fn statement(report: &str) -> Vec<(String, String)> {
    let mut facts: Vec<(String, String)> = Vec::new();
    let rows = report.lines().skip_while(|line| *line != "  problem").skip(1);
    for line in rows.take_while(|line| line.starts_with("    ")) {
        let (key, rest) = line.split_at_checked(KEYS + 2).unwrap_or((line, ""));
        match (key.trim(), facts.last_mut()) {
            ("", Some((_, value))) => *value = format!("{value} {}", rest.trim()),
            (key, _) => facts.push((key.to_owned(), rest.trim().to_owned())),
        }
    }
    facts
}

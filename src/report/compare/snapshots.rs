//! Reads the results of a run from its snapshots: the overview of all cases, and the problems in
//! the reports of the suites.

use super::document::JsonNumber;
use super::document::{CaseDocument, LevelDocument, OrderDocument, ReportDocument, SuiteDocument};

/// Name used as refinement axis if the snapshot contains only the finest level.
pub(super) const FINEST: &str = "finest";

impl ReportDocument {
    /// Reads the overview of all suites. `report` returns the report of a suite, given its group
    /// and name, or `None` if there is no report.
    pub fn of_snapshots(overview: &str, report: impl Fn(&str, &str) -> Option<String>) -> Self {
        let mut suites: Vec<SuiteDocument> = Vec::new();
        let (mut group, mut headings) = ("", Vec::new());
        for line in overview.lines() {
            if let Some(name) = line.strip_prefix("== ") {
                group = name.trim_end_matches(" ==");
                continue;
            }
            let cells: Vec<&str> = cells(line);
            match (group, cells.first()) {
                ("", _) | (_, None) => headings.clear(),
                (_, Some(&"case")) => headings = cells,
                _ if headings.is_empty() => {
                    let name = line.trim().split(": ").next().unwrap_or_default();
                    let statement = report(group, name).map(|text| statement(&text));
                    suites.push(SuiteDocument {
                        name: name.to_owned(),
                        statement: statement.unwrap_or_default(),
                        cases: Vec::new(),
                        cost: Vec::new(),
                    });
                }
                _ => {
                    let value = |heading: &str| {
                        let at = headings.iter().position(|known| *known == heading)?;
                        cells.get(at).copied().filter(|cell| *cell != "-")
                    };
                    if let Some(suite) = suites.last_mut() {
                        suite.cases.push(case(cells[0], value));
                    }
                }
            }
        }
        Self { suites }
    }
}

/// Splits a table line into its cells, which are separated by at least two spaces.
fn cells(line: &str) -> Vec<&str> {
    line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect()
}

fn case<'a>(name: &str, value: impl Fn(&str) -> Option<&'a str>) -> CaseDocument {
    let number = |heading| value(heading).and_then(|text| text.parse().ok()).map(JsonNumber);
    // Snapshots of former versions have another heading.
    let error = value("error, finest level").or_else(|| value("finest error"));
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
        passed: value("result") != Some("NOT AS EXPECTED"),
        unmet: Vec::new(),
        judge: None,
        axis: Some(FINEST.to_owned()),
        observed_order: number("order").map(|value| OrderDocument { value }),
        levels: error.map(level).into_iter().collect(),
        stability: None,
    }
}

/// Returns the rows of a report that describe the problem. The row `problem` is split at
/// semicolons.
fn statement(report: &str) -> Vec<(String, String)> {
    let mut rows: Vec<(String, String)> = Vec::new();
    for line in report.lines().skip_while(|line| !line.starts_with("  source ")) {
        let (key, rest) = line.split_at_checked(16).unwrap_or((line, ""));
        match (key.trim(), rows.last_mut()) {
            ("", Some((_, value))) => *value = format!("{value} {}", rest.trim()),
            ("", None) => {}
            (key, _) => rows.push((key.to_owned(), rest.trim().to_owned())),
        }
    }
    let is_stated = |key: &str| ["parameters", "function", "problem"].contains(&key);
    let part = |part: &str| {
        // Reports of former versions have no colon after the key.
        let part = part.replacen(": ", " ", 1);
        let (key, value) = part.split_once(' ').unwrap_or((part.as_str(), ""));
        (key.to_owned(), value.to_owned())
    };
    let parts = |(key, value): (String, String)| match key.as_str() {
        "problem" => value.split("; ").map(part).collect(),
        _ => vec![(key, value)],
    };
    rows.into_iter().filter(|(key, _)| is_stated(key)).flat_map(parts).collect()
}

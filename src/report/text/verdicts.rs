//! The head of a report: what came of each case, and what was expected of it.

use super::cost::cheapest;
use super::merged::{merged, together};
use super::prose::{hanging, row};
use super::table::Table;
use crate::report::columns::{decimals, scientific};
use crate::report::study::KINDS;
use crate::verify::{CaseOutcome, Floor, FloorCause, Interval, LevelOutcome, Ranking};

/// The target error whose cost stands beside each verdict.
const TARGET: f64 = 1e-3;

/// Verdicts, what is not as expected, expectations with their reasons, and remarks.
pub(crate) fn head(lines: &mut Vec<String>, cases: &[CaseOutcome], rankings: &[Ranking]) {
    row(lines, "result", &result(cases));
    for case in cases {
        for unmet in &case.unmet {
            row(lines, "NOT AS EXPECTED", &format!("{}: {unmet}", case.case));
        }
    }
    for methods in rankings.iter().filter_map(cheapest) {
        row(lines, "cheapest for", &methods);
    }
    lines.push(String::new());
    let expectations = expectations(cases);
    lines.extend(of_rows(merged(rows(cases, rankings, &expectations))));
    lines.push(String::new());
    for (k, expectation) in expectations.iter().enumerate() {
        hanging(lines, &letter(k), expectation);
    }
    remarks(lines, cases);
}

/// How many cases came as expected, in words.
pub(crate) fn result(cases: &[CaseOutcome]) -> String {
    let count = |word: &str| cases.iter().filter(|case| case.result() == word).count();
    let (expected, failing) =
        (count("pass"), cases.iter().filter(|case| case.passed() && case.fails()).count());
    let cases =
        |count: usize| if count == 1 { "1 case".to_owned() } else { format!("{count} cases") };
    let mut parts = Vec::new();
    match (expected, failing) {
        (0, _) => {}
        (_, 0) => parts.push(format!("{} as expected", cases(expected))),
        (_, _) if failing == expected => {
            parts.push(format!("{} as expected, which is to fail", cases(expected)));
        }
        _ => parts.push(format!("{} as expected, of which {failing} to fail", cases(expected))),
    }
    let others = [
        ("FAIL", "NOT AS EXPECTED"),
        ("explored", "of which nothing is expected"),
        ("n/a", "not applicable"),
    ];
    for (word, words) in others {
        let count = count(word);
        if count > 0 {
            parts.push(format!("{} {words}", cases(count)));
        }
    }
    parts.join("; ")
}

/// The table of verdicts, a line for each case.
pub(crate) fn table(cases: &[CaseOutcome], rankings: &[Ranking]) -> Vec<String> {
    of_rows(rows(cases, rankings, &[]))
}

fn of_rows(rows: Vec<Vec<String>>) -> Vec<String> {
    let headings = [
        "case",
        "verdict",
        "order",
        "95 %",
        "finest error",
        "floor",
        "for 1e-3",
        "found",
        "",
        "result",
    ];
    let table = Table::of_cells(headings.map(str::to_owned).to_vec(), rows);
    let left = ["verdict", "95 %", "floor", "found", "", "result"];
    table.without_empty_columns().flush_left(&left).lines()
}

fn rows(cases: &[CaseOutcome], rankings: &[Ranking], expectations: &[String]) -> Vec<Vec<String>> {
    let dash = || "-".to_owned();
    let cells = |case: &CaseOutcome| {
        let study = case.convergence();
        let order = study.and_then(|study| study.judgement.order);
        let finest = study.filter(|study| study.compared).and_then(|study| study.levels.last());
        let error = |level: &LevelOutcome| match &level.run.failure {
            Some(_) => "failed".to_owned(),
            None => scientific(level.error),
        };
        let floor = study.and_then(|study| study.floor.as_ref()).and_then(Floor::cause);
        let interval = |order: Interval| format!("[{:.2}, {:.2}]", order.low, order.high);
        let expected = expectations.iter().position(|known| *known == case.expectation());
        vec![
            case.case.clone(),
            case.verdict.clone(),
            order.map_or_else(dash, |order| decimals(2)(order.value)),
            order.map_or_else(dash, interval),
            finest.map_or_else(dash, error),
            floor.map_or_else(dash, |floor| FloorCause::name(floor).to_owned()),
            cost(case, rankings).map_or_else(dash, |times| format!("{times:.2} x")),
            if study.is_some() { dash() } else { case.reason.clone() },
            expected.map_or_else(dash, letter),
            outcome(case).to_owned(),
        ]
    };
    cases.iter().map(cells).collect()
}

/// The work of a case for the target error, over that of the cheapest one.
fn cost(case: &CaseOutcome, rankings: &[Ranking]) -> Option<f64> {
    let of_case = |ranking: &Ranking| {
        let k = ranking.targets.iter().position(|target| *target == TARGET)?;
        ranking.rows.iter().find(|row| row.method.name == case.case)?.times[k]
    };
    rankings.iter().find_map(of_case)
}

fn outcome(case: &CaseOutcome) -> &'static str {
    match case.result() {
        "FAIL" => "NOT AS EXPECTED",
        "pass" if case.fails() => "fails as expected",
        other => other,
    }
}

/// The different expectations of a suite, in the order of its cases.
fn expectations(cases: &[CaseOutcome]) -> Vec<String> {
    let mut found = Vec::new();
    for expectation in cases.iter().map(CaseOutcome::expectation) {
        if !found.contains(&expectation) {
            found.push(expectation);
        }
    }
    found
}

/// `a` to `z`, then `aa`.
fn letter(k: usize) -> String {
    let last = char::from(b'a' + (k % 26) as u8);
    if k < 26 { last.to_string() } else { format!("{}{last}", letter(k / 26 - 1)) }
}

/// Remarks on single cases beside their figures.
fn remarks(lines: &mut Vec<String>, cases: &[CaseOutcome]) {
    let of_case = |case: &CaseOutcome| {
        let of_kinds = KINDS.iter().flat_map(|kind| kind.remarks(case));
        let name = case.case.clone();
        of_kinds.map(move |remark| vec![name.clone(), remark]).collect::<Vec<_>>()
    };
    let mut remarks: Vec<(Vec<&str>, String)> = Vec::new();
    let rows: Vec<Vec<String>> = cases.iter().flat_map(of_case).collect();
    for row in &rows {
        match remarks.iter_mut().find(|(_, remark)| *remark == row[1]) {
            Some((names, _)) => names.push(&row[0]),
            None => remarks.push((vec![&row[0]], row[1].clone())),
        }
    }
    for (names, remark) in &remarks {
        hanging(lines, "-", &format!("{}: {remark}", together(names)));
    }
}

#[cfg(test)]
mod tests {
    use super::letter;

    #[test]
    fn letters_go_on_after_z() {
        assert_eq!([0, 25, 26, 27, 52].map(letter), ["a", "z", "aa", "ab", "ba"]);
    }
}

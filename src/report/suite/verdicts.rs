//! First part of a report: results and expectations of each case.

use crate::report::columns::{TableColumn, decimals, scientific};
use crate::report::study::KINDS;
use crate::report::text::cost::cheapest;
use crate::report::text::prose::{hanging, row};
use crate::report::text::table::{Table, together};
use crate::verify::{CaseOutcome, Ranking, distinct, grouped};

/// Relative error for which the cost of each case is compared.
const TARGET: f64 = 1e-3;

/// Adds verdicts, unmet expectations, expectations with their reasons, and remarks.
pub(crate) fn head(lines: &mut Vec<String>, cases: &[CaseOutcome], rankings: &[Ranking]) {
    row(lines, "result", &result(&cases.iter().collect::<Vec<_>>()));
    for case in cases {
        for unmet in &case.unmet {
            row(lines, "NOT AS EXPECTED", &format!("{}: {unmet}", case.case));
        }
    }
    let study = cases.iter().find_map(CaseOutcome::convergence);
    let all: Vec<(&str, String)> = rankings
        .iter()
        .filter_map(|ranking| Some((ranking.problem.as_str(), cheapest(ranking, study)?)))
        .collect();
    for (problem, methods) in &all {
        let of_problem =
            if all.len() > 1 { format!("of the runs {problem}, ") } else { String::new() };
        row(lines, "cheapest", &format!("{of_problem}{methods}"));
    }
    if !all.is_empty() && cases.iter().any(|case| case.subject == "fem") {
        row(lines, "", "in FEM, quadrature points count as particles");
    }
    lines.push(String::new());
    let expectations = expectations(cases);
    let verdicts = Table::new(&columns(rankings, &expectations), cases);
    lines.extend(verdicts.without_empty_columns().merged().lines());
    lines.push(String::new());
    for (k, expectation) in expectations.iter().enumerate() {
        hanging(lines, &letter(k), expectation);
    }
    remarks(lines, cases);
}

/// Summarises how many cases have the expected result.
pub(crate) fn result(cases: &[&CaseOutcome]) -> String {
    let count = |word: &str| cases.iter().filter(|case| case.result() == word).count();
    let (expected, failing) =
        (count("pass"), cases.iter().filter(|case| case.passed() && case.fails()).count());
    let cases =
        |count: usize| if count == 1 { "1 case".to_owned() } else { format!("{count} cases") };
    let failures = |count: usize| match count {
        1 => "1 expected failure".to_owned(),
        count => format!("{count} expected failures"),
    };
    let first = match (expected, failing) {
        (0, _) => None,
        (_, 0) => Some(format!("{} as expected", cases(expected))),
        (_, _) if failing == expected => Some(failures(expected)),
        _ => Some(format!("{} as expected ({})", cases(expected), failures(failing))),
    };
    let others = [
        ("FAIL", "NOT AS EXPECTED"),
        ("explored", "without an expectation"),
        ("n/a", "not applicable"),
        ("not gated", "not gated"),
        ("excepted", "excepted"),
    ];
    let others = others.map(|(word, words)| (count(word), words)).into_iter();
    let others = others.filter(|(count, _)| *count > 0);
    let others = others.map(|(count, words)| format!("{} {words}", cases(count)));
    first.into_iter().chain(others).collect::<Vec<_>>().join("; ")
}

pub(crate) fn table(cases: &[CaseOutcome], rankings: &[Ranking]) -> Table {
    Table::new(&columns(rankings, &[]), cases).without_empty_columns()
}

type CaseColumn<'a> = TableColumn<'a, CaseOutcome>;

fn columns<'a>(rankings: &'a [Ranking], expectations: &'a [String]) -> [CaseColumn<'a>; 10] {
    let order = |case: &CaseOutcome| case.convergence()?.judgement.order;
    [
        CaseColumn::text("case", "case", |case| case.case.clone()).flush_left(),
        CaseColumn::text("verdict", "verdict", |case| case.verdict.clone()).flush_left(),
        CaseColumn::text("order", "observed order", move |case| {
            order(case).map(|order| decimals(2)(order.value))
        }),
        CaseColumn::text("95 % interval", "interval of the order", move |case| {
            order(case).map(|order| format!("[{:.2}, {:.2}]", order.low, order.high))
        })
        .flush_left(),
        CaseColumn::text("error, finest level", "judged error on the finest level", |case| {
            let level = case.convergence().filter(|study| study.compared)?.levels.last()?;
            let failed = level.run.failure.is_some();
            Some(if failed { "failed".to_owned() } else { scientific(level.error) })
        }),
        CaseColumn::text("floor", "axis that causes a floor", |case| {
            Some(case.convergence()?.floor.as_ref()?.cause()?.name())
        })
        .flush_left(),
        CaseColumn::text("for 1e-3", "work divided by that of the cheapest method", |case| {
            cost(case, rankings).map(|times| format!("{times:.2} x"))
        }),
        CaseColumn::text("observed", "measured values of other studies", |case| {
            case.convergence().is_none().then(|| case.reason.clone())
        })
        .flush_left(),
        CaseColumn::text("note", "letter of the expectation in the list below", |case| {
            expectations.iter().position(|known| *known == case.expectation()).map(letter)
        })
        .flush_left(),
        CaseColumn::text("result", "whether all is as expected", outcome).flush_left(),
    ]
}

/// Returns the ratio of a case's work for the target error to that of the cheapest case.
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

fn expectations(cases: &[CaseOutcome]) -> Vec<String> {
    distinct(cases.iter().map(CaseOutcome::expectation))
}

/// Returns the letter of an expectation: `a` to `z`, then `aa` and so on.
fn letter(k: usize) -> String {
    let last = char::from(b'a' + (k % 26) as u8);
    if k < 26 { last.to_string() } else { format!("{}{last}", letter(k / 26 - 1)) }
}

/// Adds the remarks on single cases. Equal remarks are merged.
fn remarks(lines: &mut Vec<String>, cases: &[CaseOutcome]) {
    let of_case = |case: &'_ CaseOutcome| {
        let remarks = KINDS.iter().flat_map(|kind| kind.remarks(case));
        remarks.collect::<Vec<_>>()
    };
    let all = cases
        .iter()
        .flat_map(|case| of_case(case).into_iter().map(|remark| (remark, case.case.as_str())));
    let all = grouped(all);
    if !all.is_empty() && lines.last().is_some_and(|line| !line.is_empty()) {
        lines.push(String::new());
    }
    for (remark, names) in all {
        row(lines, "remark", &format!("{}: {remark}", together(&names)));
    }
}

#[cfg(test)]
mod tests {
    use super::letter;

    #[test]
    fn letters_continue_after_z() {
        assert_eq!([0, 25, 26, 27, 52].map(letter), ["a", "z", "aa", "ab", "ba"]);
    }
}

//! First part of a report: results and expectations of each case.

use crate::report::columns::{TableColumn, decimals, level, scientific};
use crate::report::names::together;
use crate::report::study::KINDS;
use crate::report::text::prose::{hanging, row};
use crate::report::text::table::Table;
use crate::verify::{CaseOutcome, CaseResult, Verdict, distinct, grouped};

pub(crate) fn head(lines: &mut Vec<String>, cases: &[CaseOutcome]) {
    row(lines, "result", &counts(cases.iter()));
    for case in cases {
        for unmet in &case.unmet {
            row(lines, CaseResult::Fail.name(), &format!("{}: {unmet}", case.case));
        }
    }
    lines.push(String::new());
    let expectations = expectations(cases);
    let verdicts = Table::new(&columns(&expectations), cases);
    lines.extend(verdicts.without_empty_columns().merged_by_name().lines());
    lines.push(String::new());
    for (k, expectation) in expectations.iter().enumerate() {
        hanging(lines, &letter(k), expectation);
    }
    remarks(lines, cases);
}

/// Counts the cases with each result: `52 pass, 9 known limits`.
pub fn counts<'a>(cases: impl Iterator<Item = &'a CaseOutcome>) -> String {
    let results: Vec<CaseResult> = cases.map(CaseOutcome::result).collect();
    let order = [
        CaseResult::Pass,
        CaseResult::KnownLimit,
        CaseResult::Explored,
        CaseResult::NotApplicable,
        CaseResult::Fail,
    ];
    let count = |result: CaseResult| {
        let count = results.iter().filter(|known| **known == result).count();
        let plural = if result == CaseResult::KnownLimit && count != 1 { "s" } else { "" };
        (count > 0).then(|| format!("{count} {}{plural}", result.name()))
    };
    order.into_iter().filter_map(count).collect::<Vec<_>>().join(", ")
}

type CaseColumn<'a> = TableColumn<'a, CaseOutcome>;

fn columns(expectations: &[String]) -> [CaseColumn<'_>; 7] {
    let order = |case: &CaseOutcome| case.convergence()?.judgement.order;
    [
        CaseColumn::text("case", "case", |case| case.case.clone()).flush_left(),
        CaseColumn::text("result", "result of the case", |case| case.result().name()).flush_left(),
        CaseColumn::text("note", "letter of the expectation in the list below", |case| {
            expectations.iter().position(|known| *known == case.expectation()).map(letter)
        })
        .flush_left(),
        CaseColumn::text("verdict", "verdict", |case| case.verdict.clone()).flush_left(),
        CaseColumn::text("order", "observed order", move |case| {
            order(case).map(|order| decimals(2)(order.value))
        }),
        CaseColumn::text("95 % interval", "interval of the order", move |case| {
            order(case).map(|order| format!("[{:.2}, {:.2}]", order.low, order.high))
        })
        .flush_left(),
        CaseColumn::text("error", "judged error on the finest level that counts", |case| {
            level::finest_counted(case).map(|level| match level.run.failure {
                Some(_) => "failed".to_owned(),
                None => scientific(level.error),
            })
        }),
    ]
}

fn expectations(cases: &[CaseOutcome]) -> Vec<String> {
    distinct(cases.iter().map(CaseOutcome::expectation))
}

/// Returns the letter of an expectation: `a` to `z`, then `aa` and so on.
fn letter(k: usize) -> String {
    let last = char::from(b'a' + (k % 26) as u8);
    if k < 26 { last.to_string() } else { format!("{}{last}", letter(k / 26 - 1)) }
}

fn remarks(lines: &mut Vec<String>, cases: &[CaseOutcome]) {
    let of_case = |case: &'_ CaseOutcome| {
        // Convergence studies have a remark for each failed level.
        let fails = case.convergence().is_none() && case.verdict == Verdict::Failed.name();
        let reason = Some(case.reason.clone()).filter(|_| !case.is_tested() || fails);
        let remarks = KINDS.iter().flat_map(|kind| (kind.remarks)(case));
        remarks.chain(reason).collect::<Vec<_>>()
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

//! The matrix of problems and methods: what each basis comes to in each suite.

use crate::report::grouping::{distinct, grouped};
use crate::verify::{
    Acceptance, CaseOutcome, Convergence, Exemption, StabilityStudy, SuiteOutcome, Verdict,
};

/// Headings of the columns: bases of MPM, finite elements, and all that is neither.
pub(crate) const COLUMNS: [&str; 8] =
    ["linear", "uGIMP", "cpGIMP", "CPDI", "quadratic", "cubic", "FEM", "other"];

const BASES: [&str; 6] =
    ["linear", "ugimp", "cpgimp", "cpdi", "quadratic_bspline", "cubic_bspline"];

/// Meaning of the findings.
pub(crate) const LEGEND: &str = "The matrix has, for each suite, the orders that the methods of a \
    basis come to, over all transfers and schemes. Instead of an order: `floor` the error stops \
    falling, `grows` it grows with refinement, `breaks` a run fails, `unsettled` and `oscillates` no \
    order can be told; `bounded` figures are held to bounds and not to an order; `stable`, `unstable` \
    and `limit` are those of stability studies. A suite's report says why.";

/// Suites, or what has one, by the groups of their names.
pub(crate) fn by_group<'a, T>(
    all: impl IntoIterator<Item = T>,
    suite: impl Fn(&T) -> &'a SuiteOutcome,
) -> Vec<(&'a str, Vec<T>)> {
    let mut groups = grouped(all.into_iter().map(|one| (suite(&one).group.as_str(), one)));
    groups.sort_by_key(|(group, _)| *group);
    groups
}

/// Findings of a suite, one text for each of [`COLUMNS`]; a dash where it has no such case.
pub(crate) fn findings(outcome: &SuiteOutcome) -> [String; COLUMNS.len()] {
    std::array::from_fn(|column| {
        let cases = outcome.cases.iter().filter(|case| column_of(case) == column);
        finding(&cases.collect::<Vec<_>>())
    })
}

/// Suites in which methods of a column fail, with how: their errors grow or stop falling, or their
/// runs break.
pub(crate) fn failures(outcomes: &[SuiteOutcome], column: usize) -> Vec<(&str, Vec<String>)> {
    let of_suite = |outcome: &'_ SuiteOutcome| {
        let cases = outcome.cases.iter().filter(|case| column_of(case) == column && case.fails());
        distinct(cases.map(|case| word(case).unwrap_or_else(|| "low order".to_owned())))
    };
    let named = outcomes.iter().map(|outcome| (outcome.suite.as_str(), of_suite(outcome)));
    named.filter(|(_, words)| !words.is_empty()).collect()
}

fn column_of(case: &CaseOutcome) -> usize {
    let basis = case.setting("basis");
    let known = basis.and_then(|basis| BASES.iter().position(|known| *known == basis));
    match known {
        Some(column) => column,
        None if case.subject == "fem" => 6,
        None => 7,
    }
}

/// Orders as a range, then what is no order.
fn finding(cases: &[&CaseOutcome]) -> String {
    let orders = cases.iter().filter_map(|case| order(case));
    let [least, most] = orders.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], order| {
        [least.min(order), most.max(order)]
    });
    let mut parts = Vec::new();
    let [low, high] = [least, most].map(|order| format!("{order:.2}"));
    if least <= most {
        parts.push(if low == high { low } else { format!("{low}..{high}") });
    }
    parts.extend(distinct(cases.iter().filter_map(|case| word(case))));
    if parts.is_empty() { "-".to_owned() } else { parts.join("/") }
}

/// The order of a case that has one.
fn order(case: &CaseOutcome) -> Option<f64> {
    let study = case.convergence().filter(|_| word(case).is_none())?;
    study.judgement.order.map(|order| order.value)
}

/// The word for a case whose verdict is no order.
fn word(case: &CaseOutcome) -> Option<String> {
    if !case.lacks.is_empty() {
        return Some("n/a".to_owned());
    }
    if case.exemption == Some(Exemption::Excepted) {
        return Some("excepted".to_owned());
    }
    let Some(study) = case.convergence() else { return Some(of_other_study(case)) };
    if study.bounded {
        return Some("bounded".to_owned());
    }
    of_verdict(study).map(str::to_owned)
}

fn of_verdict(study: &Convergence) -> Option<&'static str> {
    if study.accepted == Some(Acceptance::Order) {
        return None;
    }
    match study.judgement.verdict {
        Verdict::Converging | Verdict::TooLow | Verdict::TooGood => None,
        Verdict::AtFloor => Some("floor"),
        Verdict::PreAsymptotic => Some("unsettled"),
        Verdict::Oscillatory => Some("oscillates"),
        Verdict::Divergent => Some("grows"),
        Verdict::Failed => Some("breaks"),
        Verdict::TooFewLevels => Some("few levels"),
    }
}

fn of_other_study(case: &CaseOutcome) -> String {
    let study: Option<&StabilityStudy> = case.results();
    match study {
        Some(study) if study.sought.is_some() => "limit".to_owned(),
        Some(_) if case.fails() => "unstable".to_owned(),
        Some(_) => "stable".to_owned(),
        None => "see report".to_owned(),
    }
}

//! The matrix of problems and methods: the result of each basis in each suite.

use crate::verify::{
    Acceptance, CaseOutcome, CaseResult, Convergence, Exemption, SuiteOutcome, Verdict, distinct,
    grouped,
};

/// Column headings: the bases of MPM, finite elements (FEM), and all other methods.
pub(crate) const COLUMNS: [&str; 8] =
    ["linear", "uGIMP", "cpGIMP", "CPDI", "quadratic B-spline", "cubic B-spline", "FEM", "other"];

const BASES: [&str; 6] =
    ["linear", "ugimp", "cpgimp", "cpdi", "quadratic_bspline", "cubic_bspline"];

pub(crate) const LEGEND: &str = "Each entry is the range of observed orders of all methods with \
                                 this basis, over every transfer and time scheme. Instead of an \
                                 order: `floor`: the error stops falling; `grows`: the error grows \
                                 with refinement; `breaks`: a run fails; `unsettled` and `oscillates`: \
                                 the order differs from one level to the next; `bounds`: quantities \
                                 are checked against limits, and no order is measured; `stable`, \
                                 `unstable` and `limit` (a critical value): results of stability \
                                 studies. The report of a suite states the reasons.";

/// Returns the result that represents cases: a failure or a known limit if one occurs.
pub(crate) fn main_result<'a>(
    cases: impl Iterator<Item = &'a CaseOutcome> + Clone,
) -> Option<CaseResult> {
    let mut results = cases.map(CaseOutcome::result);
    let occurs = |result: &CaseResult| results.clone().any(|known| known == *result);
    [CaseResult::Fail, CaseResult::KnownLimit].into_iter().find(occurs).or_else(|| results.next())
}

/// Returns the main result in each of [`COLUMNS`]; `None` for a column without cases.
pub(crate) fn results(outcome: &SuiteOutcome) -> [Option<CaseResult>; COLUMNS.len()] {
    std::array::from_fn(|column| {
        main_result(outcome.cases.iter().filter(|case| column_of(case) == column))
    })
}

/// Counts for each of [`COLUMNS`] the cases with the expected order, and all with an order.
pub(crate) fn shares(outcomes: &[&SuiteOutcome]) -> [(usize, usize); COLUMNS.len()] {
    std::array::from_fn(|column| {
        let cases = outcomes.iter().flat_map(|outcome| &outcome.cases);
        let cases = cases.filter(|case| case.is_tested() && column_of(case) == column);
        let studies = cases.filter_map(CaseOutcome::convergence).filter(|study| !study.bounded);
        studies.fold((0, 0), |(kept, all), study| {
            let is_kept = study.accepted.is_some()
                || matches!(study.judgement.verdict, Verdict::Converging | Verdict::TooGood);
            (kept + usize::from(is_kept), all + 1)
        })
    })
}

/// Groups items by the group of their suite, with the groups in alphabetical order.
pub(crate) fn by_group<'a, T>(
    all: impl IntoIterator<Item = T>,
    suite: impl Fn(&T) -> &'a SuiteOutcome,
) -> Vec<(&'a str, Vec<T>)> {
    let mut groups = grouped(all.into_iter().map(|one| (suite(&one).group.as_str(), one)));
    groups.sort_by_key(|(group, _)| *group);
    groups
}

/// Returns the findings of a suite for each of [`COLUMNS`]: a dash without cases.
pub(crate) fn findings(outcome: &SuiteOutcome) -> [String; COLUMNS.len()] {
    std::array::from_fn(|column| {
        let cases = outcome.cases.iter().filter(|case| column_of(case) == column);
        finding(&cases.collect::<Vec<_>>())
    })
}

/// Lists the suites in which methods of a column fail, each with the kinds of failure.
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

/// Combines several cases into the range of their orders, and their other verdicts.
pub(crate) fn finding(cases: &[&CaseOutcome]) -> String {
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

fn order(case: &CaseOutcome) -> Option<f64> {
    let study = case.convergence().filter(|_| word(case).is_none())?;
    study.judgement.order.map(|order| order.value)
}

/// Returns the text shown in place of the order of a case; `None` if the order is shown.
fn word(case: &CaseOutcome) -> Option<String> {
    if !case.lacks.is_empty() || case.exemption == Some(Exemption::Excepted) {
        return Some(case.result().name().to_owned());
    }
    let Some(study) = case.convergence() else {
        let word = match case.stability() {
            Some(study) if study.sought.is_some() => "limit",
            Some(_) if case.fails() => "unstable",
            Some(_) => "stable",
            None => "see report",
        };
        return Some(word.to_owned());
    };
    if study.bounded {
        return Some("bounds".to_owned());
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

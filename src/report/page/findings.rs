//! First screen below the header: one large figure, and the known limits with their reasons.

use super::html::Html;
use super::section::inline_svg;
use super::tables::{SuiteSource, case_id, link, suite_id, titled};
use crate::report::matrix::by_group;
use crate::report::names::together;
use crate::report::suite::verdicts::counts;
use crate::report::{plotted, svg};
use crate::verify::{CaseOutcome, CaseResult, SuiteOutcome, grouped};

/// Creates the figure of a failing or else of the plotted suite, and the known limits.
pub(super) fn findings(sources: &[SuiteSource<'_>]) -> Vec<Html> {
    let outcomes = || sources.iter().map(|source| source.outcome);
    let failing = outcomes().filter(|outcome| !outcome.passed());
    let figure = failing.chain(plotted(outcomes())).find_map(figure);
    figure.into_iter().chain(limits(sources)).collect()
}

fn figure(outcome: &SuiteOutcome) -> Option<Html> {
    let drawn = svg(outcome).into_iter().next()?;
    let results = Html::text(&format!(": {}. ", counts(outcome.cases.iter())));
    let mut caption = vec![link(&suite_id(outcome), &outcome.suite), results];
    caption.extend(known_limits(outcome));
    let parts = [inline_svg(&drawn.svg), Html::tag("figcaption", &[], caption)];
    Some(Html::block("figure", &[("id", "first-figure")], &parts))
}

fn known_limits(outcome: &SuiteOutcome) -> Vec<Html> {
    let cases = outcome.cases.iter().filter(|case| case.result() == CaseResult::KnownLimit);
    let limit = |(reason, cases): (&str, Vec<&CaseOutcome>)| {
        let names: Vec<&str> = cases.iter().map(|case| case.case.as_str()).collect();
        let name = format!("{}::{}", outcome.suite, together(&names));
        vec![link(&case_id(outcome, cases[0]), &name), format!(": {reason}. ").into()].into()
    };
    grouped(cases.map(|case| (case.because.trim(), case))).into_iter().map(limit).collect()
}

fn limits(sources: &[SuiteSource<'_>]) -> Option<Html> {
    let group = |(group, sources): (&str, Vec<&SuiteSource<'_>>)| {
        let limits = sources.iter().flat_map(|source| known_limits(source.outcome));
        let items: Vec<Html> = limits.map(|limit| Html::tag("li", &[], limit)).collect();
        let results = counts(sources.iter().flat_map(|source| &source.outcome.cases));
        let summary = Html::tag("summary", &[], format!("{group}: {results}"));
        let list = Html::block("ul", &[], &items);
        (!items.is_empty()).then(|| Html::block("details", &[], &[summary, list]))
    };
    let groups = by_group(sources, |source| source.outcome).into_iter().filter_map(group);
    let groups: Vec<Html> = groups.collect();
    let about = "A known limit is a failure of a method that its suite predicts and explains. It \
                 counts as a success as long as it occurs.";
    (!groups.is_empty()).then(|| titled("findings", "Known limits", about, groups.into()))
}

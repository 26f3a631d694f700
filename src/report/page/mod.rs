//! One HTML page for a run: the complete results in one file that works offline.
//!
//! The page is readable without JavaScript. A small script only sorts and filters tables, and
//! unfolds the target of a link. Figures are inline SVG and have a common style sheet for dark
//! colours. Equal runs give equal bytes, except for the line with commit, date and machine.
//!
//! A section contains everything that a suite reports: every figure of [`svg()`](super::svg()) and
//! the complete [`text()`](super::text()). Additions to either also appear on the page.

mod html;
mod section;
mod tables;

#[cfg(test)]
mod tests;

pub use tables::SuiteSource;

use crate::report::figure::plot::style::style_sheet;
use crate::report::matrix::by_group;
use crate::report::names::together;
use crate::report::suite::json::commit;
use crate::report::suite::verdicts::counts;
use crate::report::text::prose::counted;
use crate::report::{plotted, svg};
use crate::verify::{CaseOutcome, CaseResult, SuiteOutcome, grouped};
use html::Html;
use section::inline_svg;
use tables::{case_id, link, suite_id, titled};

const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// Content security policy: the page cannot load anything, even if a suite contains HTML.
const POLICY: &str =
    "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:";

/// Facts about a run that its outcomes do not contain.
#[derive(Debug, Clone, Default)]
pub struct RunFacts {
    /// Number of suites that could not run.
    pub refused: usize,
    /// Start of the run.
    pub date: String,
    /// System, architecture and number of cores.
    pub machine: String,
}

/// Creates the page. Names of suites must be unique, because they are used as ids of sections.
pub fn page(sources: &[SuiteSource<'_>], run: &RunFacts) -> String {
    let mut body = vec![head(sources, run)];
    body.push(Html::block("div", &[("class", "first")], &findings(sources)));
    body.extend([tables::topics(sources), tables::matrix(sources), tables::verdicts(sources)]);
    let groups = by_group(sources, |source| source.outcome);
    body.extend(groups.into_iter().flat_map(|(_, of_group)| of_group).map(section::section));
    let page = Html::block(
        "html",
        &[("lang", "en")],
        &[
            Html::block("head", &[], &meta()),
            Html::block(
                "body",
                &[],
                &[Html::block("main", &[], &body), Html::tag("script", &[], Html::trusted(SCRIPT))],
            ),
        ],
    );
    format!("<!DOCTYPE html>\n{}\n", page.into_string())
}

fn meta() -> Vec<Html> {
    let meta = |name, content| Html::void("meta", &[("name", name), ("content", content)]);
    let policy = [("http-equiv", "Content-Security-Policy"), ("content", POLICY)];
    vec![
        Html::void("meta", &[("charset", "utf-8")]),
        Html::void("meta", &policy),
        meta("viewport", "width=device-width, initial-scale=1"),
        meta("color-scheme", "light dark"),
        // Without this element, browsers request an icon.
        Html::void("link", &[("rel", "icon"), ("href", "data:,")]),
        Html::tag("title", &[], "MPM verification"),
        Html::tag("style", &[], Html::trusted(style_sheet() + STYLE)),
    ]
}

fn head(sources: &[SuiteSource<'_>], run: &RunFacts) -> Html {
    let cases = || sources.iter().flat_map(|s| s.outcome.cases.iter().map(move |c| (s, c)));
    let failed: Vec<_> = cases().filter(|(_, case)| !case.passed()).collect();
    let all = cases().count();
    let mut finding = format!("{}, {}", counted(sources.len(), "suite"), counted(all, "case"));
    if all > 0 {
        finding += &format!(": {}", counts(cases().map(|(_, case)| case)));
        finding += if failed.is_empty() { ", 0 FAIL" } else { "" };
    }
    finding.push('.');
    if run.refused > 0 {
        finding += &format!(" {} could not be used.", counted(run.refused, "file"));
    }
    let is_sound = all > 0 && failed.is_empty() && run.refused == 0;
    let class = if is_sound { "ok finding" } else { "bad finding" };
    let commit = commit().map_or_else(String::new, |commit| format!(", commit {commit}"));
    let RunFacts { date, machine, .. } = run;
    let version = env!("CARGO_PKG_VERSION");
    let run = format!("mpm-verify {version}{commit}. {date}, {machine}.");
    let mut parts = vec![
        Html::tag("h1", &[], "MPM verification"),
        Html::tag("p", &[], PURPOSE),
        Html::tag("p", &[("class", class)], finding),
    ];
    if !failed.is_empty() {
        let item = |(source, case): &(&SuiteSource<'_>, &CaseOutcome)| {
            let link = tables::case_link(source.outcome, case);
            let why = Html::text(&format!(": {}", case.failure()));
            Html::tag("li", &[], vec![link, why])
        };
        let items: Vec<Html> = failed.iter().map(item).collect();
        parts.push(Html::block("ul", &[("class", "unmet")], &items));
    }
    parts.push(Html::tag("p", &[("class", "muted run")], run));
    Html::block("header", &[], &parts)
}

const PURPOSE: &str = "mpm-verify runs solvers of the Material Point Method on problems with known \
                       solutions (suites), and compares the result of each method (case) with an \
                       expectation.";

/// Creates the figure of a failing or else of the plotted suite, and the known limits.
fn findings(sources: &[SuiteSource<'_>]) -> Vec<Html> {
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

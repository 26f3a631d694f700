//! One HTML page for a run: the complete results in one file that works offline.
//!
//! The page is readable without JavaScript. A small script only sorts and filters tables, and
//! unfolds the target of a link. Figures are inline SVG and have a common style sheet for dark
//! colours. Equal runs give equal bytes, because the page does not depend on the time or the
//! machine. The only exception is the commit that a CI service sets as an environment variable.
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
use crate::report::suite::json::commit;
use crate::report::suite::verdicts::counts;
use crate::report::text::prose::counted;
use crate::verify::CaseOutcome;
use html::Html;

const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// Content security policy: the page cannot load anything, even if a suite contains HTML.
const POLICY: &str =
    "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:";

/// Creates the page. `refused` is the number of suites that could not run; the page shows this
/// number. Names of suites must be unique, because they are used as ids of sections.
pub fn page(sources: &[SuiteSource<'_>], refused: usize) -> String {
    let mut body = vec![
        head(sources, refused),
        tables::topics(sources),
        tables::matrix(sources),
        tables::verdicts(sources),
    ];
    let groups = by_group(sources, |source| source.outcome);
    body.extend(groups.into_iter().flat_map(|(_, of_group)| of_group).map(section::section));
    body.push(foot());
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

/// Creates the page header: the counts of the results, and a list of the failures.
fn head(sources: &[SuiteSource<'_>], refused: usize) -> Html {
    let cases = || sources.iter().flat_map(|s| s.outcome.cases.iter().map(move |c| (s, c)));
    let (all, failed) = (cases().count(), cases().filter(|(_, case)| !case.passed()).count());
    let mut run = format!("{}, {}", counted(sources.len(), "suite"), counted(all, "case"));
    if all > 0 {
        run += &format!(": {}", counts(cases().map(|(_, case)| case)));
    }
    run.push('.');
    if refused > 0 {
        run += &format!(" {} could not be used.", counted(refused, "file"));
    }
    let is_sound = all > 0 && failed == 0 && refused == 0;
    let class = if is_sound { "ok finding" } else { "bad finding" };
    let finding = Html::tag("p", &[("class", class)], run);
    let mut parts = vec![Html::tag("h1", &[], "MPM verification"), finding];
    if failed > 0 {
        let item = |(source, case): (&SuiteSource<'_>, &CaseOutcome)| {
            let link = tables::case_link(source.outcome, case, true);
            let why = Html::text(&format!(": {}", case.failure()));
            Html::tag("li", &[], vec![link, why])
        };
        let items: Vec<Html> = cases().filter(|(_, case)| !case.passed()).map(item).collect();
        parts.push(Html::block("ul", &[("class", "unmet")], &items));
    }
    Html::block("header", &[], &parts)
}

fn foot() -> Html {
    let commit = commit().map_or_else(String::new, |commit| format!(", commit {commit}"));
    let words = format!(
        "mpm-verify {}{commit}. A known limit is as binding as an expected order: FAIL means that the \
         result of a case differs from the expectation.",
        env!("CARGO_PKG_VERSION")
    );
    Html::block("footer", &[], &[Html::tag("p", &[("class", "muted")], words)])
}

//! The matrix of problems and methods, by which a reader finds a suite.

use super::cells::scrolled;
use super::html::Html;
use super::links::id;
use super::source::SuiteSource;
use crate::report::matrix::{COLUMNS, LEGEND, by_group, findings};

/// Every suite with what came of it, below the name of its group.
pub(super) fn matrix(sources: &[SuiteSource<'_>]) -> Html {
    let head = |name: &str| Html::tag("th", &[("scope", "col"), ("class", "word")], name);
    let heads = Html::tag(
        "tr",
        &[],
        ["Suite"].iter().chain(&COLUMNS).map(|name| head(name)).collect::<Vec<_>>(),
    );
    let columns = (COLUMNS.len() + 1).to_string();
    let group = |(group, sources): (&str, Vec<&SuiteSource<'_>>)| {
        let name = Html::tag("th", &[("scope", "rowgroup"), ("colspan", &columns)], group);
        let mut rows = vec![Html::tag("tr", &[("class", "group")], name)];
        rows.extend(sources.into_iter().map(row));
        Html::block("tbody", &[], &rows)
    };
    let mut table = vec![Html::tag("thead", &[], heads)];
    table.extend(by_group(sources, |source| source.outcome).into_iter().map(group));
    let parts = [
        Html::tag("h2", &[], "Suites"),
        Html::tag("p", &[("class", "muted")], legend()),
        scrolled("Suites and bases", Html::block("table", &[], &table)),
    ];
    Html::block("nav", &[("id", "suites"), ("aria-label", "Suites")], &parts)
}

/// The legend, its words for findings as code.
fn legend() -> Html {
    let part = |(k, part): (usize, &str)| match k % 2 {
        0 => Html::text(part),
        _ => Html::tag("code", &[], part),
    };
    LEGEND.split('`').enumerate().map(part).collect()
}

fn row(source: &SuiteSource<'_>) -> Html {
    let outcome = source.outcome;
    let link = Html::tag("a", &[("href", &format!("#{}", id(outcome)))], outcome.suite.as_str());
    let title = Html::tag("span", &[("class", "muted title")], format!(" {}", outcome.title));
    let mut name = vec![link, title];
    if !outcome.passed() {
        name.push(Html::tag("b", &[("class", "bad")], " FAIL"));
    }
    let mut cells = vec![Html::tag("th", &[("scope", "row")], name)];
    cells.extend(findings(outcome).map(|finding| Html::tag("td", &[], finding)));
    Html::tag("tr", &[], cells)
}

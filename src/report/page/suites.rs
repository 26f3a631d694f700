//! The matrix of problems and methods, by which a reader finds a suite.

use super::cells::scrolled;
use super::html::Html;
use super::links::id;
use super::source::SuiteSource;
use crate::report::figure::study::thumbnail;
use crate::report::matrix::{COLUMNS, FindingClass, LEGEND, by_group, classes, findings, shares};

/// Cases with the expected order, for each group of suites and each basis.
pub(super) fn topics(sources: &[SuiteSource<'_>]) -> Html {
    let head = |name: &str| Html::tag("th", &[("scope", "col"), ("class", "word")], name);
    let heads: Vec<Html> = ["Topic"].iter().chain(&COLUMNS).map(|name| head(name)).collect();
    let row = |(group, sources): (&str, Vec<&SuiteSource<'_>>)| {
        let link = Html::tag("a", &[("href", &format!("#group-{}", plain(group)))], group);
        let mut cells = vec![Html::tag("th", &[("scope", "row")], link)];
        cells.extend(shares(sources.iter().map(|source| source.outcome)).map(share));
        Html::tag("tr", &[], cells)
    };
    let rows: Vec<Html> = by_group(sources, |source| source.outcome).into_iter().map(row).collect();
    let about = "Cases with the expected order, of all cases of a convergence study, by basis \
                 function. Many suites show a weakness on purpose.";
    let table =
        [Html::tag("thead", &[], Html::tag("tr", &[], heads)), Html::block("tbody", &[], &rows)];
    Html::block(
        "section",
        &[("id", "methods"), ("aria-labelledby", "methods-head")],
        &[
            Html::tag("h2", &[("id", "methods-head")], "Methods by topic"),
            Html::tag("p", &[("class", "muted")], about),
            scrolled("Methods by topic", Html::block("table", &[("class", "matrix")], &table)),
        ],
    )
}

/// How many cases have the expected order; a colour for all, most, some and none.
fn share((kept, all): (usize, usize)) -> Html {
    if all == 0 {
        return Html::tag("td", &[], "-");
    }
    let class = match kept {
        _ if kept == all => FindingClass::Order,
        _ if 2 * kept >= all => FindingClass::LowOrder,
        0 => FindingClass::Fails,
        _ => FindingClass::NoOrder,
    };
    Html::tag("td", &[("class", class.name())], format!("{kept} of {all}"))
}

/// A name as part of an id.
fn plain(name: &str) -> String {
    name.chars().map(|c| if c.is_whitespace() { '_' } else { c }).collect()
}

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
        let id = format!("group-{}", plain(group));
        let mut rows = vec![Html::tag("tr", &[("class", "group"), ("id", &id)], name)];
        rows.extend(sources.into_iter().map(row));
        Html::block("tbody", &[], &rows)
    };
    let mut table = vec![Html::tag("thead", &[], heads)];
    table.extend(by_group(sources, |source| source.outcome).into_iter().map(group));
    let parts = [
        Html::tag("h2", &[], "Suites"),
        Html::tag("p", &[("class", "muted")], legend()),
        key(),
        scrolled("Suites and bases", Html::block("table", &[("class", "matrix")], &table)),
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

/// Meaning of the colours; the texts of cells say the same.
fn key() -> Html {
    let item = |class: FindingClass| Html::tag("span", &[("class", class.name())], class.meaning());
    Html::tag("p", &[("class", "key")], FindingClass::SHOWN.map(item).to_vec())
}

fn row(source: &SuiteSource<'_>) -> Html {
    let outcome = source.outcome;
    let link = Html::tag("a", &[("href", &format!("#{}", id(outcome)))], outcome.suite.as_str());
    let title = Html::tag("span", &[("class", "muted title")], format!(" {}", outcome.title));
    let mut name = vec![link, title];
    name.extend(thumbnail(outcome).map(Html::trusted));
    if !outcome.passed() {
        name.push(Html::tag("b", &[("class", "bad")], " FAIL"));
    }
    let mut cells = vec![Html::tag("th", &[("scope", "row")], name)];
    let found = findings(outcome).into_iter().zip(classes(outcome));
    cells.extend(found.map(|(finding, class)| match class {
        Some(class) => Html::tag("td", &[("class", class.name())], finding),
        None => Html::tag("td", &[], finding),
    }));
    Html::tag("tr", &[], cells)
}

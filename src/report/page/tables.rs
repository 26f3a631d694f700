//! Tables of the page: the matrix of problems and methods, and the verdicts of all cases.
//!
//! Cells that are numbers carry the plain value for the script that sorts; a cell without a value is
//! sorted last in both directions.

use super::SuiteSource;
use super::html::Html;
use crate::report::columns::scientific;
use crate::report::matrix::{COLUMNS, LEGEND, by_group, findings};
use crate::verify::{CaseOutcome, SuiteOutcome};

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
        rows.extend(sources.into_iter().map(suite_row));
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

fn suite_row(source: &SuiteSource<'_>) -> Html {
    let outcome = source.outcome;
    let link =
        Html::tag("a", &[("href", &format!("#{}", suite_id(outcome)))], outcome.suite.as_str());
    let title = Html::tag("span", &[("class", "muted title")], format!(" {}", outcome.title));
    let mut name = vec![link, title];
    if !outcome.passed() {
        name.push(Html::tag("b", &[("class", "bad")], " FAIL"));
    }
    let mut cells = vec![Html::tag("th", &[("scope", "row")], name)];
    cells.extend(findings(outcome).map(|finding| Html::tag("td", &[], finding)));
    Html::tag("tr", &[], cells)
}

/// Headings of the table of verdicts, and whether the cells of the column are numbers.
const VERDICT_COLUMNS: [(&str, bool); 8] = [
    ("Suite", false),
    ("Case", false),
    ("Result", false),
    ("Verdict", false),
    ("Order", true),
    ("Finest error", true),
    ("Transfers", true),
    ("Expected", false),
];

/// The table of all verdicts: one row for each case of each suite.
pub(super) fn verdicts(sources: &[SuiteSource<'_>]) -> Html {
    let cases = sources.iter().flat_map(|s| s.outcome.cases.iter().map(move |case| (s, case)));
    let rows: Vec<Html> = cases.map(|(source, case)| case_row(source, case)).collect();
    let head = |(name, number): (&str, bool)| {
        let class = if number { "number" } else { "word" };
        Html::tag("th", &[("scope", "col"), ("class", class)], name)
    };
    let heads = Html::tag("tr", &[], VERDICT_COLUMNS.map(head).to_vec());
    let legend = "Order: observed, with its 95 % interval. Finest error and transfers between \
                   particles and nodes: on the finest level; what an error is of, a suite says.";
    let table = [Html::tag("thead", &[], heads), Html::block("tbody", &[], &rows)];
    Html::block(
        "section",
        &[("id", "verdicts"), ("aria-labelledby", "verdicts-head")],
        &[
            Html::tag("h2", &[("id", "verdicts-head")], "Verdicts"),
            Html::tag("p", &[("class", "muted")], legend),
            scrolled("All verdicts", Html::block("table", &[], &table)),
        ],
    )
}

fn case_row(source: &SuiteSource<'_>, case: &CaseOutcome) -> Html {
    let outcome = source.outcome;
    let suite =
        Html::tag("a", &[("href", &format!("#{}", suite_id(outcome)))], outcome.suite.as_str());
    let name = |content: Html| Html::tag("td", &[("class", "name")], content);
    let [order, error, transfers] = figure_cells(case);
    Html::tag(
        "tr",
        &[],
        vec![
            name(suite),
            name(case_link(outcome, case, false)),
            Html::tag("td", &[], result(case)),
            name(case.verdict.as_str().into()),
            order,
            error,
            transfers,
            Html::tag("td", &[("class", "prose")], case.expected.as_deref().unwrap_or("nothing")),
        ],
    )
}

/// A region that scrolls by itself where it is wider than the screen; by keyboard too.
pub(super) fn scrolled(label: &str, content: Html) -> Html {
    let attributes =
        [("class", "wide"), ("role", "region"), ("tabindex", "0"), ("aria-label", label)];
    Html::tag("div", &attributes, content)
}

/// Whether the case is as expected: in words, not by colour alone.
pub(super) fn result(case: &CaseOutcome) -> Html {
    match (case.result(), case.passed()) {
        (word, true) => Html::tag("span", &[("class", "ok")], word),
        (word, false) => Html::tag("b", &[("class", "bad")], word),
    }
}

/// Cells of the order with its interval, of the judged error on the finest level and of its
/// transfers.
pub(super) fn figure_cells(case: &CaseOutcome) -> [Html; 3] {
    let study = case.convergence();
    let order = study.and_then(|study| study.judgement.order);
    let order = order.map(|o| (o.value, o.shown()));
    let finest = study.and_then(|study| study.levels.last());
    let error = finest.filter(|_| study.is_some_and(|study| study.compared)).map(|level| {
        let failed = level.run.failure.is_some() || !level.error.is_finite();
        let text = if failed { "failed".to_owned() } else { scientific(level.error) };
        (if failed { f64::INFINITY } else { level.error }, text)
    });
    let transfers = finest.map(|level| level.run.counters.transfers);
    let transfers = transfers.map(|count| (count as f64, count.to_string()));
    [order, error, transfers].map(number)
}

fn number(figure: Option<(f64, String)>) -> Html {
    let Some((value, text)) = figure else {
        return Html::tag("td", &[("class", "number")], "-");
    };
    let value = if value.is_finite() { value.to_string() } else { "Infinity".to_owned() };
    Html::tag("td", &[("class", "number"), ("data-value", &value)], text)
}

/// The id of a suite's section.
pub(super) fn suite_id(outcome: &SuiteOutcome) -> String {
    format!("suite-{}", outcome.suite)
}

/// The id of a case's row in the section of its suite. Names of suites have no dot.
pub(super) fn case_id(outcome: &SuiteOutcome, case: &CaseOutcome) -> String {
    let plain = |c: char| if c.is_whitespace() { '_' } else { c };
    let name: String = case.case.chars().map(plain).collect();
    format!("case-{}.{name}", outcome.suite)
}

/// A link to the row of a case, with the suite's name or without.
pub(super) fn case_link(outcome: &SuiteOutcome, case: &CaseOutcome, full: bool) -> Html {
    let name = if full { format!("{}::{}", outcome.suite, case.case) } else { case.case.clone() };
    Html::tag("a", &[("href", &format!("#{}", case_id(outcome, case)))], name)
}

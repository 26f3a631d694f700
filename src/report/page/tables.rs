//! Tables of the page: the matrix of problems and methods, and the verdicts of all cases.
//!
//! Number cells contain the plain value for the sorting script, which puts empty ones last.

use super::html::Html;
use crate::report::columns::level::finest_counted;
use crate::report::columns::scientific;
use crate::report::matrix::{COLUMNS, LEGEND, by_group, findings, main_result, results, shares};
use crate::report::suite::verdicts::counts;
use crate::verify::{CaseOutcome, CaseResult, SuiteOutcome};

/// The outcome of a suite, with its source file.
#[derive(Debug, Clone, Copy)]
pub struct SuiteSource<'a> {
    /// Results of the suite.
    pub outcome: &'a SuiteOutcome,
    /// Name of the suite file without its folders, because these depend on the machine.
    pub file: &'a str,
    /// Text of the suite file.
    pub yaml: &'a str,
}

/// Creates the table of groups: results, and for each basis the cases with the order of theory.
pub(super) fn topics(sources: &[SuiteSource<'_>]) -> Html {
    let row = |(group, sources): (&str, Vec<&SuiteSource<'_>>)| {
        let link = link(&format!("group-{}", plain(group)), group);
        let outcomes: Vec<_> = sources.iter().map(|source| source.outcome).collect();
        let mut cells = vec![Html::tag("th", &[("scope", "row")], link)];
        cells.push(result_counts(outcomes.iter().flat_map(|outcome| &outcome.cases)));
        cells.extend(shares(&outcomes).map(|(kept, all)| share(kept, all)));
        Html::tag("tr", &[], cells)
    };
    let rows: Vec<Html> = by_group(sources, |source| source.outcome).into_iter().map(row).collect();
    let about = "Results, and for each basis the number of convergence cases that reach the order of \
                 theory. A dash means that there is no such case. Many suites exist because a method \
                 loses its order there: such a case is a known limit.";
    let table = [bases("Topic"), Html::block("tbody", &[], &rows)];
    let table = scrolled("Topics and bases", Html::block("table", &[("class", "matrix")], &table));
    titled("methods", "Methods by topic", about, table)
}

fn result_counts<'a>(cases: impl Iterator<Item = &'a CaseOutcome> + Clone) -> Html {
    coloured(main_result(cases.clone()), counts(cases))
}

pub(super) fn titled(id: &str, title: &str, about: &str, content: Html) -> Html {
    let head = format!("{id}-head");
    let about = Html::tag("p", &[("class", "muted")], about);
    let parts = [Html::tag("h2", &[("id", &head)], title), about, content];
    Html::block("section", &[("id", id), ("aria-labelledby", &head)], &parts)
}

fn bases(first: &'static str) -> Html {
    heads([first, "Results"].into_iter().chain(COLUMNS).map(|name| (name, "word")))
}

pub(super) fn heads<'a>(columns: impl IntoIterator<Item = (&'a str, &'a str)>) -> Html {
    let head = |(name, class)| Html::tag("th", &[("scope", "col"), ("class", class)], name);
    let heads: Vec<Html> = columns.into_iter().map(head).collect();
    Html::tag("thead", &[], Html::tag("tr", &[], heads))
}

/// Creates the cell `K of N` (cases with the order of theory), with a bar of this length.
fn share(kept: usize, all: usize) -> Html {
    if all == 0 {
        return Html::tag("td", &[], "-");
    }
    let bar = format!("--share:{}%", 100 * kept / all);
    let text =
        Html::tag("span", &[("class", "share"), ("style", &bar)], format!("{kept} of {all}"));
    Html::tag("td", &[], text)
}

/// Creates a cell with the colour of a result. Only the text is coloured, because a background
/// would hide the shadow that indicates further columns.
fn coloured(result: Option<CaseResult>, text: String) -> Html {
    let class = result.map_or("", CaseResult::name);
    Html::tag("td", &[], Html::tag("span", &[("class", &plain(class))], text))
}

/// Converts a name for use in an id: whitespace becomes `_`.
fn plain(name: &str) -> String {
    name.chars().map(|c| if c.is_whitespace() { '_' } else { c }).collect()
}

pub(super) fn matrix(sources: &[SuiteSource<'_>]) -> Html {
    let columns = (COLUMNS.len() + 2).to_string();
    let group = |(group, sources): (&str, Vec<&SuiteSource<'_>>)| {
        let name = Html::tag("th", &[("scope", "rowgroup"), ("colspan", &columns)], group);
        let id = format!("group-{}", plain(group));
        let mut rows = vec![Html::tag("tr", &[("class", "group"), ("id", &id)], name)];
        rows.extend(sources.into_iter().map(suite_row));
        Html::block("tbody", &[], &rows)
    };
    let mut table = vec![bases("Suite")];
    table.extend(by_group(sources, |source| source.outcome).into_iter().map(group));
    let parts = [
        Html::tag("h2", &[], "Suites"),
        Html::tag("p", &[("class", "muted")], legend()),
        scrolled("Suites and bases", Html::block("table", &[("class", "matrix")], &table)),
    ];
    Html::block("nav", &[("id", "suites"), ("aria-label", "Suites")], &parts)
}

fn legend() -> Html {
    let part = |(k, part): (usize, &str)| match k % 2 {
        0 => Html::text(part),
        _ => Html::tag("code", &[], part),
    };
    LEGEND.split('`').enumerate().map(part).collect()
}

fn suite_row(source: &SuiteSource<'_>) -> Html {
    let outcome = source.outcome;
    let link = link(&suite_id(outcome), &outcome.suite);
    let title = Html::tag("span", &[("class", "muted title")], format!(" {}", outcome.title));
    let mut cells = vec![Html::tag("th", &[("scope", "row")], vec![link, title])];
    cells.push(result_counts(outcome.cases.iter()));
    let found = findings(outcome).into_iter().zip(results(outcome));
    cells.extend(found.map(|(finding, result)| coloured(result, finding)));
    Html::tag("tr", &[], cells)
}

/// Heading of each column of the verdict table, and the class of the column.
const VERDICT_COLUMNS: [(&str, &str); 7] = [
    ("Suite and case", "word"),
    ("Result", "word"),
    ("Verdict", "word"),
    ("Order", "number"),
    ("Error, finest level", "number"),
    ("Transfers", "number"),
    ("Expected", "word"),
];

pub(super) fn verdicts(sources: &[SuiteSource<'_>]) -> Html {
    let cases = sources.iter().flat_map(|s| s.outcome.cases.iter().map(move |case| (s, case)));
    let rows: Vec<Html> = cases.map(|(source, case)| case_row(source, case)).collect();
    let legend = "Order: observed, with its 95 % interval. Transfers: pairs of a particle and a \
                  node on the finest level. The report of a suite names the quantity of the error.";
    let table = [heads(VERDICT_COLUMNS), Html::block("tbody", &[], &rows)];
    let table = scrolled("All verdicts", Html::block("table", &[], &table));
    titled("verdicts", "Verdicts", legend, table)
}

fn case_row(source: &SuiteSource<'_>, case: &CaseOutcome) -> Html {
    let outcome = source.outcome;
    let name = |content: Html| Html::tag("td", &[("class", "name")], content);
    let [order, error, transfers] = figure_cells(case);
    let basis = case.setting("basis").unwrap_or(case.subject);
    let transfer = case.setting("transfer").unwrap_or("-");
    Html::tag(
        "tr",
        &[("data-basis", basis), ("data-transfer", transfer), ("data-verdict", &case.verdict)],
        vec![
            name(case_link(outcome, case)),
            Html::tag("td", &[], result(case)),
            name(case.verdict.as_str().into()),
            order,
            error,
            transfers,
            Html::tag("td", &[("class", "prose")], case.expected.as_deref().unwrap_or("nothing")),
        ],
    )
}

/// Wraps content in an element that scrolls, also by keyboard, if it is wider than the screen.
pub(super) fn scrolled(label: &str, content: Html) -> Html {
    let attributes =
        [("class", "wide"), ("role", "region"), ("tabindex", "0"), ("aria-label", label)];
    Html::tag("div", &attributes, content)
}

pub(super) fn result(case: &CaseOutcome) -> Html {
    let name = case.result().name();
    Html::tag("span", &[("class", &plain(name))], name)
}

/// Creates three cells: order with interval, judged error, and transfers on the finest level.
pub(super) fn figure_cells(case: &CaseOutcome) -> [Html; 3] {
    let study = case.convergence();
    let order = study.and_then(|study| study.judgement.order);
    let order = order.map(|o| (o.value, o.shown()));
    let finest = study.and_then(|study| study.levels.last());
    let error = finest_counted(case).map(|level| {
        let failed = level.run.failure.is_some() || !level.error.is_finite();
        let text = if failed { "failed".to_owned() } else { scientific(level.error) };
        (if failed { f64::INFINITY } else { level.error }, text)
    });
    let transfers = finest.map(|level| level.run.counters.transfers).filter(|count| *count > 0);
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

pub(super) fn suite_id(outcome: &SuiteOutcome) -> String {
    format!("suite-{}", outcome.suite)
}

/// Returns the id of a case's row, unique because names of suites contain no dot.
pub(super) fn case_id(outcome: &SuiteOutcome, case: &CaseOutcome) -> String {
    format!("case-{}.{}", outcome.suite, plain(&case.case))
}

pub(super) fn case_link(outcome: &SuiteOutcome, case: &CaseOutcome) -> Html {
    link(&case_id(outcome, case), &format!("{}::{}", outcome.suite, case.case))
}

pub(super) fn link(id: &str, words: &str) -> Html {
    Html::tag("a", &[("href", &format!("#{id}"))], words)
}

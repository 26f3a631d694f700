//! The table of all verdicts.

use super::cells::{figures, result, scrolled};
use super::html::Html;
use super::links::{case_link, id};
use super::source::SuiteSource;
use crate::verify::CaseOutcome;

/// Heads, and whether what stands below are numbers.
const COLUMNS: [(&str, bool); 8] = [
    ("Suite", false),
    ("Case", false),
    ("Result", false),
    ("Verdict", false),
    ("Order", true),
    ("Finest error", true),
    ("Transfers", true),
    ("Expected", false),
];

/// One row for each case of each suite.
pub(super) fn table(sources: &[SuiteSource<'_>]) -> Html {
    let cases = sources.iter().flat_map(|s| s.outcome.cases.iter().map(move |case| (s, case)));
    let rows: Vec<Html> = cases.map(|(source, case)| row(source, case)).collect();
    let head = |(name, number): (&str, bool)| {
        let class = if number { "number" } else { "word" };
        Html::tag("th", &[("scope", "col"), ("class", class)], name)
    };
    let heads = Html::tag("tr", &[], COLUMNS.map(head).to_vec());
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

fn row(source: &SuiteSource<'_>, case: &CaseOutcome) -> Html {
    let outcome = source.outcome;
    let suite = Html::tag("a", &[("href", &format!("#{}", id(outcome)))], outcome.suite.as_str());
    let name = |content: Html| Html::tag("td", &[("class", "name")], content);
    let [order, error, transfers] = figures(case);
    let basis = case.setting("basis").unwrap_or(case.subject);
    let transfer = case.setting("transfer").unwrap_or("-");
    Html::tag(
        "tr",
        &[("data-basis", basis), ("data-transfer", transfer), ("data-verdict", &case.verdict)],
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

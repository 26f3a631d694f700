//! Section of a suite: text, verdicts, figures, the whole report, and the file itself.

use super::cells::scrolled;
use super::html::Html;
use super::links::{case_id, id};
use super::source::SuiteSource;
use super::{cells, figure_list};
use crate::report::text;
use crate::verify::{CaseOutcome, SuiteOutcome};

/// The section of a suite.
pub(super) fn section(source: &SuiteSource<'_>) -> Html {
    let outcome = source.outcome;
    let (id, suite) = (id(outcome), outcome.suite.as_str());
    let heading = vec![
        Html::tag("a", &[("href", &format!("#{id}"))], suite),
        Html::text(&format!(": {}", outcome.title)),
    ];
    let mut parts = vec![Html::tag("h2", &[], heading), links(source)];
    let paragraphs = outcome.about.split("\n\n").filter(|text| !text.trim().is_empty());
    parts.extend(paragraphs.map(|text| Html::tag("p", &[], text)));
    parts.push(Html::tag(
        "p",
        &[("class", "muted")],
        format!("Source: {}. Fingerprint of the problem: {:016x}", outcome.source, outcome.meaning),
    ));
    parts.extend(figure_list::figures(source));
    parts.push(cases(outcome));
    parts.push(report(outcome));
    parts.push(file(source));
    Html::block("section", &[("id", &id), ("class", "suite")], &parts)
}

fn links(source: &SuiteSource<'_>) -> Html {
    let suite = &source.outcome.suite;
    let link =
        |kind: &str, words: &str| Html::tag("a", &[("href", &format!("#{kind}-{suite}"))], words);
    let top = Html::tag("a", &[("href", "#verdicts")], "all verdicts");
    let between = || Html::text(" · ");
    let yaml = link("yaml", source.file);
    let parts = vec![link("report", "report"), between(), yaml, between(), top];
    Html::tag("p", &[("class", "links")], parts)
}

/// One row for each case; neighbours of which the same is expected share the words.
fn cases(outcome: &SuiteOutcome) -> Html {
    let judged = outcome.cases.iter().filter_map(CaseOutcome::convergence).find(|s| s.compared);
    let measured = outcome.cases.iter().any(|case| case.convergence().is_some());
    let head =
        |(name, class): (&str, &str)| Html::tag("th", &[("scope", "col"), ("class", class)], name);
    let mut heads = [("Case", "word"), ("Result", "word"), ("Verdict", "word")].map(head).to_vec();
    if measured {
        let figures = ["Order", "Finest error", "Transfers"];
        heads.extend(figures.map(|name| head((name, "number"))));
    }
    heads.extend([("Found", "word"), ("Expected", "word")].map(head));
    let groups = outcome.cases.chunk_by(|a, b| a.expectation() == b.expectation());
    let rows: Vec<Html> = groups.flat_map(|group| rows(outcome, group, measured)).collect();
    let mut table = Vec::new();
    table.extend(
        judged.map(|study| Html::tag("caption", &[], format!("Finest error: {}", study.judged()))),
    );
    let heads = Html::tag("tr", &[], heads);
    table.extend([Html::tag("thead", &[], heads), Html::block("tbody", &[], &rows)]);
    let label = format!("Verdicts of {}", outcome.suite);
    scrolled(&label, Html::block("table", &[], &table))
}

fn rows(outcome: &SuiteOutcome, group: &[CaseOutcome], measured: bool) -> Vec<Html> {
    let row = |(k, case): (usize, &CaseOutcome)| {
        let mut found = vec![Html::text(&case.reason)];
        let unmet = case.unmet.iter();
        found.extend(unmet.map(|unmet| Html::tag("p", &[("class", "bad")], unmet.as_str())));
        let mut cells = vec![
            Html::tag("td", &[("class", "name")], case.case.as_str()),
            Html::tag("td", &[], cells::result(case)),
            Html::tag("td", &[("class", "name")], case.verdict.as_str()),
        ];
        if measured {
            cells.extend(cells::figures(case));
        }
        cells.push(Html::tag("td", &[("class", "prose")], found));
        if k == 0 {
            let rows = group.len().to_string();
            cells.push(Html::tag(
                "td",
                &[("class", "prose"), ("rowspan", &rows)],
                case.expectation(),
            ));
        }
        Html::tag("tr", &[("id", &case_id(outcome, case))], cells)
    };
    group.iter().enumerate().map(row).collect()
}

/// The text report, whole.
fn report(outcome: &SuiteOutcome) -> Html {
    let text = Html::text(&text(outcome));
    folded(
        &format!("report-{}", outcome.suite),
        "Report",
        &format!("Report of {}", outcome.suite),
        text,
    )
}

fn file(source: &SuiteSource<'_>) -> Html {
    let id = format!("yaml-{}", source.outcome.suite);
    folded(&id, source.file, &format!("File {}", source.file), source.yaml.into())
}

/// Preformatted text that is shown when asked for.
fn folded(id: &str, words: &str, label: &str, text: Html) -> Html {
    let summary = Html::tag("summary", &[], words);
    let text = scrolled(label, Html::tag("pre", &[], text));
    Html::tag("details", &[("id", id)], vec![summary, text])
}

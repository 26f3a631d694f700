//! Section of a suite: text, verdicts, figures, the complete report, and the suite file.

use super::html::Html;
use super::tables::{SuiteSource, case_id, figure_cells, heads, link, result, scrolled, suite_id};
use crate::report::figure::plot::style::{SUPERSCRIPT, WIDTH};
use crate::report::{svg, text};
use crate::verify::{CaseOutcome, SuiteOutcome};

pub(super) fn section(source: &SuiteSource<'_>) -> Html {
    let outcome = source.outcome;
    let (id, suite) = (suite_id(outcome), outcome.suite.as_str());
    let heading = vec![link(&id, suite), Html::text(&format!(": {}", outcome.title))];
    let mut parts = vec![Html::tag("h2", &[], heading), links(source)];
    let paragraphs = outcome.about.split("\n\n").filter(|text| !text.trim().is_empty());
    parts.extend(paragraphs.map(|text| Html::tag("p", &[], text)));
    parts.push(Html::tag(
        "p",
        &[("class", "muted")],
        format!("Source: {}. Fingerprint of the problem: {:016x}", outcome.source, outcome.meaning),
    ));
    parts.extend(figures(source));
    parts.push(cases(outcome));
    let report = Html::text(&text(outcome));
    parts.push(folded(&format!("report-{suite}"), "Report", &format!("Report of {suite}"), report));
    let label = format!("File {}", source.file);
    parts.push(folded(&format!("yaml-{suite}"), source.file, &label, source.yaml.into()));
    Html::block("section", &[("id", &id), ("class", "suite")], &parts)
}

fn links(source: &SuiteSource<'_>) -> Html {
    let suite = &source.outcome.suite;
    let between = || Html::text(" · ");
    let yaml = link(&format!("yaml-{suite}"), source.file);
    let top = link("verdicts", "all verdicts");
    let parts = vec![link(&format!("report-{suite}"), "report"), between(), yaml, between(), top];
    Html::tag("p", &[("class", "links")], parts)
}

/// Creates a table of the cases; neighbours with equal expectations share one cell.
fn cases(outcome: &SuiteOutcome) -> Html {
    let judged = outcome.cases.iter().filter_map(CaseOutcome::convergence).find(|s| s.compared);
    let measured = outcome.cases.iter().any(|case| case.convergence().is_some());
    let mut columns = vec![("Case", "word"), ("Result", "word"), ("Verdict", "word")];
    if measured {
        columns.extend(["Order", "Error, finest level", "Transfers"].map(|name| (name, "number")));
    }
    columns.extend([("Found", "word"), ("Expected", "word")]);
    let groups = outcome.cases.chunk_by(|a, b| a.expectation() == b.expectation());
    let rows: Vec<Html> = groups.flat_map(|group| rows(outcome, group, measured)).collect();
    let mut table = Vec::new();
    table.extend(judged.map(|study| {
        Html::tag("caption", &[], format!("Error on the finest level: {}", study.judged()))
    }));
    table.extend([heads(columns), Html::block("tbody", &[], &rows)]);
    let label = format!("Verdicts of {}", outcome.suite);
    scrolled(&label, Html::block("table", &[], &table))
}

fn rows(outcome: &SuiteOutcome, group: &[CaseOutcome], measured: bool) -> Vec<Html> {
    let row = |(k, case): (usize, &CaseOutcome)| {
        let mut found = vec![Html::text(&case.reason)];
        let unmet = case.unmet.iter();
        found.extend(unmet.map(|unmet| Html::tag("p", &[("class", "bad")], unmet.text.as_str())));
        let mut cells = vec![
            Html::tag("td", &[("class", "name")], case.case.as_str()),
            Html::tag("td", &[], result(case)),
            Html::tag("td", &[("class", "name")], case.verdict.as_str()),
        ];
        if measured {
            cells.extend(figure_cells(case));
        }
        cells.push(Html::tag("td", &[("class", "prose")], found));
        if k == 0 {
            let rows = group.len().to_string();
            let attributes = [("class", "prose"), ("rowspan", rows.as_str())];
            cells.push(Html::tag("td", &attributes, case.expectation()));
        }
        Html::tag("tr", &[("id", &case_id(outcome, case))], cells)
    };
    group.iter().enumerate().map(row).collect()
}

/// Creates a folded block of preformatted text with the summary `words`.
fn folded(id: &str, words: &str, label: &str, text: Html) -> Html {
    let summary = Html::tag("summary", &[], words);
    let text = scrolled(label, Html::tag("pre", &[], text));
    Html::tag("details", &[("id", id)], vec![summary, text])
}

/// Minimum size of text in a figure on the screen (px).
const LEGIBLE: f64 = 9.0;

fn figures(source: &SuiteSource<'_>) -> Option<Html> {
    let outcome = source.outcome;
    let drawn = svg(outcome).into_iter().enumerate();
    let drawn = drawn.map(|(number, drawn)| {
        let id = format!("figure-{}.{}", outcome.suite, number + 1);
        figure(&id, &drawn.svg, &drawn.file)
    });
    let figures: Vec<Html> = drawn.collect();
    (!figures.is_empty()).then(|| Html::block("div", &[("class", "figures")], &figures))
}

/// Shows one figure. A wide figure scrolls if its texts would otherwise be too small.
fn figure(id: &str, svg: &str, name: &str) -> Html {
    let caption = Html::tag("figcaption", &[("class", "muted")], name);
    let width = svg_width(svg).unwrap_or(WIDTH);
    if width <= WIDTH {
        return Html::block("figure", &[("id", id)], &[inline_svg(svg), caption]);
    }
    let least = width * LEGIBLE / SUPERSCRIPT;
    let style = format!("<svg style=\"min-width:{least:.0}px;max-width:{width:.0}px\"");
    let figure = inline_svg(svg).into_string().replacen("<svg", &style, 1);
    let figure = scrolled(&format!("Figure {name}"), Html::trusted(figure));
    Html::block("figure", &[("id", id), ("class", "broad")], &[figure, caption])
}

/// Converts a standalone SVG document to an element of the page, which already contains the style
/// sheet of figures and sets their size; the `viewBox` preserves the shape.
pub(super) fn inline_svg(document: &str) -> Html {
    let mut inline = document.trim().to_owned();
    while let Some(start) = inline.find("<style") {
        let end = inline[start..].find("</style>").map_or(inline.len(), |at| start + at + 8);
        inline.drain(start..end);
    }
    Html::trusted(inline)
}

/// Reads the width of an SVG document (px) from its `viewBox`.
fn svg_width(document: &str) -> Option<f64> {
    let (_, view) = document.split_once(" viewBox=\"")?;
    view.split([' ', '"']).nth(2)?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn style_sheets_are_removed() {
        let figure = "<svg><style>a{}</style><g/><style>b{}</style></svg>";
        assert_eq!(inline_svg(figure).into_string(), "<svg><g/></svg>");
    }
}

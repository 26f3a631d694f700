//! Cells of the tables of verdicts.
//!
//! Cells that are numbers carry the plain value for the script that sorts; a cell without one has
//! no figure and goes last, whichever way.

use super::html::Html;
use crate::report::columns::scientific;
use crate::verify::CaseOutcome;

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
pub(super) fn figures(case: &CaseOutcome) -> [Html; 3] {
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

//! The figures of a suite: whatever [`svg`](crate::report::svg()) draws.

use super::html::Html;
use super::inline;
use crate::report::svg;
use crate::verify::SuiteOutcome;

/// All figures; nothing where there are none.
pub(super) fn figures(outcome: &SuiteOutcome) -> Option<Html> {
    let figure = |(number, figure): (usize, crate::report::Figure)| {
        let id = format!("figure-{}.{}", outcome.suite, number + 1);
        let caption = Html::tag("figcaption", &[("class", "muted")], figure.file.as_str());
        let svg = inline::svg(&figure.svg, &id);
        Html::block("figure", &[("id", &id)], &[svg, caption])
    };
    let figures: Vec<Html> = svg(outcome).into_iter().enumerate().map(figure).collect();
    (!figures.is_empty()).then(|| Html::block("div", &[("class", "figures")], &figures))
}

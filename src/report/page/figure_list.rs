//! The figures of a suite: the sketch of its scene, and whatever [`svg`](crate::report::svg())
//! draws.

use super::cells::scrolled;
use super::html::Html;
use super::inline;
use super::source::SuiteSource;
use crate::report::figure::plot::style::{SUPERSCRIPT, WIDTH};
use crate::report::svg;

/// Smallest size of a text on the screen (px).
const LEGIBLE: f64 = 9.0;

/// All figures, the scene first; nothing where there are none.
pub(super) fn figures(source: &SuiteSource<'_>) -> Option<Html> {
    let outcome = source.outcome;
    let scene = source.sketch.map(|svg| {
        let id = format!("scene-{}", outcome.suite);
        figure(&id, svg, "Scene and grid of the coarsest level")
    });
    let drawn = svg(outcome).into_iter().enumerate();
    let drawn = drawn.map(|(number, drawn)| {
        let id = format!("figure-{}.{}", outcome.suite, number + 1);
        figure(&id, &drawn.svg, &drawn.file)
    });
    let figures: Vec<Html> = scene.into_iter().chain(drawn).collect();
    (!figures.is_empty()).then(|| Html::block("div", &[("class", "figures")], &figures))
}

/// A figure; one that is wider than others scrolls where its texts would become too small.
fn figure(id: &str, svg: &str, name: &str) -> Html {
    let caption = Html::tag("figcaption", &[("class", "muted")], name);
    let width = inline::width(svg).unwrap_or(WIDTH);
    if width <= WIDTH {
        return Html::block("figure", &[("id", id)], &[inline::svg(svg, id), caption]);
    }
    let least = width * LEGIBLE / SUPERSCRIPT;
    let style = format!("<svg style=\"min-width:{least:.0}px;max-width:{width:.0}px\"");
    let figure = inline::svg(svg, id).into_string().replacen("<svg", &style, 1);
    let figure = scrolled(&format!("Figure {name}"), Html::trusted(figure));
    Html::block("figure", &[("id", id), ("class", "broad")], &[figure, caption])
}

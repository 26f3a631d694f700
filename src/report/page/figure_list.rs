//! The figures of a suite: the sketch of its scene, and whatever [`svg`](crate::report::svg())
//! draws.

use super::html::Html;
use super::inline;
use super::source::SuiteSource;
use crate::report::svg;

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

fn figure(id: &str, svg: &str, caption: &str) -> Html {
    let caption = Html::tag("figcaption", &[("class", "muted")], caption);
    Html::block("figure", &[("id", id)], &[inline::svg(svg, id), caption])
}

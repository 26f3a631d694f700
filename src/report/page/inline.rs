//! A standalone SVG document inside the page.
//!
//! An `id` is unique in a figure and must be so on a page of hundreds: all ids get the figure's
//! prefix, and what refers to them follows. The page has the style sheet of figures once, so that
//! it is left out here. The size is left to the style sheet of the page; the `viewBox` keeps the
//! shape.

use super::html::Html;

/// The figure, with `prefix` before each of its ids.
pub(super) fn svg(document: &str, prefix: &str) -> Html {
    let ids = ids(document);
    let mut inline = document.trim().to_owned();
    if let Some(start) = inline.find("<svg") {
        inline.drain(..start);
    }
    while let Some(start) = inline.find("<style") {
        let end = inline[start..].find("</style>").map_or(inline.len(), |at| start + at + 8);
        inline.drain(start..end);
    }
    for id in &ids {
        let new = format!("{prefix}-{id}");
        for (before, after) in [("id=\"", "\""), ("url(#", ")"), ("href=\"#", "\"")] {
            let old = format!("{before}{id}{after}");
            inline = inline.replace(&old, &format!("{before}{new}{after}"));
        }
    }
    Html::trusted(inline)
}

/// Width of a document in its own pixels.
pub(super) fn width(document: &str) -> Option<f64> {
    let (_, view) = document.split_once(" viewBox=\"")?;
    view.split([' ', '"']).nth(2)?.parse().ok()
}

/// The ids of a document, each once.
fn ids(document: &str) -> Vec<&str> {
    let mut ids: Vec<&str> = document
        .match_indices(" id=\"")
        .filter_map(|(at, key)| document[at + key.len()..].split('"').next())
        .collect();
    ids.sort_unstable();
    ids.dedup();
    ids
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_and_what_refers_to_them_get_the_prefix() {
        let figure = "<?xml version=\"1.0\"?>\n<svg viewBox=\"0 0 1 1\"><defs><clipPath id=\"a\"/>\
            <path id=\"ab\"/></defs><g clip-path=\"url(#a)\"/><use href=\"#ab\"/></svg>\n";
        let inline = svg(figure, "bar-1").into_string();
        assert_eq!(
            inline,
            "<svg viewBox=\"0 0 1 1\"><defs><clipPath id=\"bar-1-a\"/><path id=\"bar-1-ab\"/></defs>\
             <g clip-path=\"url(#bar-1-a)\"/><use href=\"#bar-1-ab\"/></svg>"
        );
    }

    #[test]
    fn style_sheets_stay_behind() {
        let figure = "<svg><style>a{}</style><g/><style>b{}</style></svg>";
        assert_eq!(svg(figure, "x").into_string(), "<svg><g/></svg>");
    }

    #[test]
    fn a_figure_without_ids_stays_as_it_is() {
        let figure = "<svg viewBox=\"0 0 1 1\"><text>id=\"no\"</text></svg>";
        assert_eq!(svg(figure, "x").into_string(), figure);
    }
}

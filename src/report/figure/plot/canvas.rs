//! The canvas of a figure: the SVG document with its paper, and a title of several lines.

use super::style::{FONT, INK, PAPER, TEXT, TITLE, style_sheet};
use super::svg::{SvgElement, number};
use super::text;

/// Room at both ends of a title, and above it.
const LEFT: f64 = 14.0;
const TOP: f64 = 18.0;
/// Height of a line of a title.
const LEADING: f64 = 17.0;
/// Most lines of a title.
const LINES: usize = 3;

/// A document of this size (px) with nothing but paper on it. Screen readers read `title`.
pub(crate) fn canvas((width, height): (f64, f64), title: &str) -> SvgElement {
    let mut svg = SvgElement::new("svg")
        .set("xmlns", "http://www.w3.org/2000/svg")
        .set("viewBox", &format!("0 0 {} {}", number(width), number(height)))
        .at("width", width)
        .at("height", height)
        .set("role", "img")
        .set("font-family", FONT)
        .at("font-size", TEXT)
        .set("fill", INK);
    svg.add(&SvgElement::new("title").content(title));
    svg.add(&SvgElement::style(&style_sheet()));
    svg.add(&SvgElement::new("rect").at("width", width).at("height", height).set("fill", PAPER));
    svg
}

/// A title in the middle above a figure of some width (px).
#[derive(Debug)]
pub(crate) struct Heading {
    lines: Vec<String>,
    width: f64,
}

impl Heading {
    /// `title` in as many lines as it takes.
    pub(crate) fn new(title: &str, width: f64) -> Self {
        Self { lines: text::wrap(title, 1.12 * TITLE, width - 2.0 * LEFT, LINES), width }
    }

    /// Where the figure below may begin (px).
    pub(crate) fn bottom(&self) -> f64 {
        TOP + LEADING * self.lines.len() as f64
    }

    /// Adds the lines to `svg`.
    pub(crate) fn draw(&self, svg: &mut SvgElement) {
        for (i, line) in self.lines.iter().enumerate() {
            let at = (self.width / 2.0, TOP + 4.0 + LEADING * i as f64);
            let line = SvgElement::text(at, "middle", line).at("font-size", TITLE);
            svg.add(&line.set("font-weight", "bold"));
        }
    }
}

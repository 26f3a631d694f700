//! The canvas of a figure: the SVG document, a title of several lines, estimated text widths.

use super::style::{FONT, INK, PAPER, TEXT, TITLE, style_sheet};
use super::svg::{SvgElement, number};

/// Margin on the left and right of a title (px).
const LEFT: f64 = 14.0;
const TOP: f64 = 18.0;
/// Height of a title line (px).
const LEADING: f64 = 17.0;
const LINES: usize = 3;

/// Creates an empty document of this size (px). Screen readers read `title`.
pub(crate) fn canvas(width: f64, height: f64, title: &str) -> SvgElement {
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

/// A centred title above a figure of a given width (px).
#[derive(Debug)]
pub(crate) struct Heading {
    lines: Vec<String>,
    width: f64,
}

impl Heading {
    pub(crate) fn new(title: &str, width: f64) -> Self {
        Self { lines: wrap(title, 1.12 * TITLE, width - 2.0 * LEFT, LINES), width }
    }

    /// Returns the vertical position (px) at which the figure below may begin.
    pub(crate) fn bottom(&self) -> f64 {
        TOP + LEADING * self.lines.len() as f64
    }

    pub(crate) fn draw(&self, svg: &mut SvgElement) {
        for (i, line) in self.lines.iter().enumerate() {
            let at = (self.width / 2.0, TOP + 4.0 + LEADING * i as f64);
            let line = SvgElement::text(at, "middle", line).at("font-size", TITLE);
            svg.add(&line.set("font-weight", "bold"));
        }
    }
}

/// Estimates the width of `text` (px) at the font size `size`. The actual width of SVG text depends
/// on the viewer.
///
/// A text that fits in `DejaVu Sans`, the widest face, also fits in Helvetica.
pub(crate) fn text_width(text: &str, size: f64) -> f64 {
    text.chars().map(advance).sum::<f64>() * size
}

/// Returns the advance width of one character in units of the font size.
fn advance(c: char) -> f64 {
    match c {
        'i' | 'j' | 'l' | '\'' | ' ' | '.' | ',' | '|' => 0.32,
        'I' | ':' | ';' | '/' | '-' | '(' | ')' | '[' | ']' | 'f' | 't' | 'r' => 0.4,
        'm' | 'w' | 'M' | 'W' | '@' | '%' => 0.99,
        'A'..='Z' | '=' | '+' | '<' | '>' | '~' | '\u{2212}' | '×' | '&' | '#' => 0.8,
        // Glyphs outside Latin and Greek may be as wide as they are high.
        '\u{0}'..='\u{3ff}' => 0.63,
        _ => 1.0,
    }
}

/// Shortens `text` to `limit` pixels, with an ellipsis in place of the removed text.
pub(crate) fn shorten(text: &str, size: f64, limit: f64) -> String {
    if text_width(text, size) <= limit {
        return text.to_owned();
    }
    let mut used = size;
    let mut short: String = text
        .chars()
        .take_while(|&c| {
            used += advance(c) * size;
            used <= limit
        })
        .collect();
    short.truncate(short.trim_end().len());
    short.push('…');
    short
}

/// Wraps `text` into at most `lines` lines of `limit` pixels; the last one may be shortened.
pub(crate) fn wrap(text: &str, size: f64, limit: f64, lines: usize) -> Vec<String> {
    let mut wrapped: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let full = wrapped.len() >= lines;
        match wrapped.last_mut() {
            Some(line) if full || text_width(&format!("{line} {word}"), size) <= limit => {
                line.push(' ');
                line.push_str(word);
            }
            _ => wrapped.push(word.to_owned()),
        }
    }
    wrapped.iter().map(|line| shorten(line, size, limit)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case("short", 100.0, "short")]
    #[case("cut at a blank and marked", 65.0, "cut at a…")]
    #[case("", 0.0, "")]
    #[case("nothing fits", 1.0, "…")]
    fn shortening(#[case] text: &str, #[case] limit: f64, #[case] short: &str) {
        assert_eq!(shorten(text, 12.0, limit), short);
    }

    #[rstest]
    #[case("one two three four", 2, &["one two", "three f…"])]
    #[case("one two three four", 3, &["one two", "three", "four"])]
    #[case("  ", 2, &[])]
    fn wrapping(#[case] text: &str, #[case] lines: usize, #[case] expected: &[&str]) {
        assert_eq!(wrap(text, 10.0, 46.0, lines), expected);
    }
}

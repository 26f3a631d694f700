//! Writes SVG. An element stores its attributes and its content in escaped form.
//!
//! The document is built as a tree, so tags are always balanced.

use std::fmt::Write as _;

/// A position on the canvas (px), with y pointing downwards.
pub(crate) type Pt = (f64, f64);

/// An axis-aligned rectangle (px).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rect {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) w: f64,
    pub(crate) h: f64,
}

impl Rect {
    pub(crate) fn right(&self) -> f64 {
        self.x + self.w
    }

    pub(crate) fn bottom(&self) -> f64 {
        self.y + self.h
    }
}

#[derive(Clone, Debug)]
pub(crate) struct SvgElement {
    name: &'static str,
    attributes: String,
    content: String,
}

impl SvgElement {
    pub(crate) fn new(name: &'static str) -> Self {
        Self { name, attributes: String::new(), content: String::new() }
    }

    pub(crate) fn group_at(at: Pt) -> Self {
        let shift = format!("translate({} {})", number(at.0), number(at.1));
        Self::new("g").set("transform", &shift)
    }

    /// Creates a group of these elements.
    pub(crate) fn group(children: &[Self]) -> Self {
        let mut group = Self::new("g");
        for child in children {
            group.add(child);
        }
        group
    }

    pub(crate) fn rect(Rect { x, y, w, h }: Rect) -> Self {
        Self::new("rect").at("x", x).at("y", y).at("width", w).at("height", h)
    }

    pub(crate) fn line(from: Pt, to: Pt) -> Self {
        Self::new("line").at("x1", from.0).at("y1", from.1).at("x2", to.0).at("y2", to.1)
    }

    /// Creates a `polyline` or `polygon` through `points`.
    pub(crate) fn through(name: &'static str, points: &[Pt]) -> Self {
        let mut list = String::new();
        for &(x, y) in points {
            let gap = if list.is_empty() { "" } else { " " };
            let _ = write!(list, "{gap}{},{}", number(x), number(y));
        }
        Self::new(name).set("points", &list)
    }

    /// Creates a text anchored at the position `at`; `anchor` is `start`, `middle` or `end`.
    pub(crate) fn text(at: Pt, anchor: &str, text: &str) -> Self {
        Self::new("text").at("x", at.0).at("y", at.1).set("text-anchor", anchor).content(text)
    }

    /// Creates a style sheet. Its text is not escaped.
    pub(crate) fn style(sheet: &str) -> Self {
        Self { content: sheet.to_owned(), ..Self::new("style") }
    }

    pub(crate) fn set(mut self, name: &str, value: &str) -> Self {
        let _ = write!(self.attributes, " {name}=\"{}\"", escape(value));
        self
    }

    pub(crate) fn at(self, name: &str, value: f64) -> Self {
        let value = number(value);
        self.set(name, &value)
    }

    /// Sets the colour and the width (px) of lines.
    pub(crate) fn stroke(self, colour: &str, width: f64) -> Self {
        self.set("stroke", colour).at("stroke-width", width)
    }

    pub(crate) fn content(mut self, text: &str) -> Self {
        self.content.push_str(&escape(text));
        self
    }

    pub(crate) fn add(&mut self, child: &Self) {
        self.content.push('\n');
        self.content.push_str(&child.render());
    }

    pub(crate) fn render(&self) -> String {
        let Self { name, attributes, content } = self;
        if content.is_empty() {
            format!("<{name}{attributes}/>")
        } else {
            format!("<{name}{attributes}>{content}</{name}>")
        }
    }
}

/// Formats a coordinate with two decimals. Zero has no sign: equal figures have equal bytes.
pub(crate) fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    if text == "-0.00" { "0.00".to_owned() } else { text }
}

/// Escapes special characters. Characters that XML 1.0 forbids become the replacement character.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&apos;"),
            '\t' | '\n' | '\r' => escaped.push(' '),
            '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            _ => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[test]
    fn coordinates() {
        let texts = [-0.001, -0.0, 1.005, -12.346].map(number);
        assert_eq!(texts, ["0.00", "0.00", "1.00", "-12.35"]);
    }

    #[rstest]
    #[case("a < b & \"c\"", "a &lt; b &amp; &quot;c&quot;")]
    #[case("it's > 1", "it&apos;s &gt; 1")]
    #[case("bell\u{7}\nline", "bell\u{fffd} line")]
    fn escaping(#[case] text: &str, #[case] escaped: &str) {
        assert_eq!(escape(text), escaped);
    }
}

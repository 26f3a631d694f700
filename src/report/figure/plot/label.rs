//! A number as an axis shows it, possibly with a true superscript.

use super::style::{SUPERSCRIPT, TEXT};
use super::svg::{Pt, SvgElement};
use super::text;

/// A number, or a power of ten with its factor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Label {
    base: String,
    exponent: Option<i32>,
}

impl Label {
    /// A decimal number with a typographic minus.
    pub(crate) fn decimal(value: f64, decimals: usize) -> Self {
        Self { base: format!("{value:.decimals$}").replace('-', "\u{2212}"), exponent: None }
    }

    /// `base` with a superscript: "10", a multiple of it, or "×10" for a factor shared by an axis.
    pub(crate) fn power(base: &str, exponent: i32) -> Self {
        Self { base: base.to_owned(), exponent: Some(exponent) }
    }

    /// Estimated width in pixels.
    pub(crate) fn width(&self) -> f64 {
        text::width(&self.base, TEXT) + text::width(&self.superscript(), SUPERSCRIPT)
    }

    /// The label with its baseline anchored at `at`.
    pub(crate) fn draw(&self, at: Pt, anchor: &str) -> SvgElement {
        if self.exponent.is_none() {
            return SvgElement::text(at, anchor, &self.base);
        }
        // Two texts that meet at `joint`, and not one with a raised part: some converters anchor
        // each part of a text anew.
        let left_of_joint = text::width(&self.base, TEXT);
        let joint = match anchor {
            "start" => at.0 + left_of_joint,
            "middle" => at.0 - self.width() / 2.0 + left_of_joint,
            _ => at.0 - self.width() + left_of_joint,
        };
        let mut label = SvgElement::new("g");
        label.add(&SvgElement::text((joint, at.1), "end", &self.base));
        let exponent = SvgElement::text((joint, at.1 - 5.0), "start", &self.superscript());
        label.add(&exponent.at("font-size", SUPERSCRIPT));
        label
    }

    fn superscript(&self) -> String {
        self.exponent.map(|k| k.to_string().replace('-', "\u{2212}")).unwrap_or_default()
    }
}

#[cfg(test)]
impl std::fmt::Display for Label {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let base = self.base.replace('\u{2212}', "-");
        match self.exponent {
            Some(k) => write!(f, "{base}^{k}"),
            None => f.write_str(&base),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_are_texts_of_their_own() {
        let svg = Label::power("10", -3).draw((0.0, 0.0), "end").render();
        let (base, exponent) = svg.split_once("</text>").unwrap();
        assert!(base.contains("text-anchor=\"end\">10"), "{svg}");
        assert!(
            exponent.contains("y=\"-5.00\" text-anchor=\"start\" font-size=\"11.00\">\u{2212}3<"),
            "{svg}"
        );
    }

    #[test]
    fn the_superscript_counts_for_the_width() {
        assert!(Label::power("10", -10).width() > Label::power("10", 1).width());
    }
}

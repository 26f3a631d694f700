//! Converts values to positions along an axis.

use super::canvas::text_width;
use super::style::{SUPERSCRIPT, TEXT};
use super::svg::{Pt, SvgElement};

/// A logarithmic axis. Its working coordinate, which is linear in pixels, is the decimal logarithm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    pub(crate) lo: f64,
    pub(crate) hi: f64,
}

/// Empty space at the ends of an axis, as fractions of its length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pad {
    pub(crate) lo: f64,
    pub(crate) hi: f64,
}

/// Minimum length of a logarithmic axis (decades), so that rounding noise does not fill it.
const MIN_DECADES: f64 = 0.5;

impl Scale {
    /// Creates a logarithmic axis for the positive finite `values`.
    pub(crate) fn log(values: impl Iterator<Item = f64>, pad: Pad) -> Self {
        let logs = values.filter(|v| v.is_finite() && *v > 0.0).map(libm::log10);
        let (lo, hi) = range(logs).unwrap_or((-1.0, 0.0));
        let widen = ((MIN_DECADES - (hi - lo)) / 2.0).max(0.0);
        let (lo, hi) = (lo - widen, hi + widen);
        let span = (hi - lo) / (1.0 - pad.lo - pad.hi);
        Self { lo: lo - pad.lo * span, hi: hi + pad.hi * span }
    }

    pub(crate) fn span(&self) -> f64 {
        self.hi - self.lo
    }

    /// Returns the position of a value: 0 at the low end, 1 at the high end.
    pub(crate) fn fraction(&self, value: f64) -> f64 {
        self.fraction_of_working(libm::log10(value))
    }

    /// Returns the position of a working coordinate: 0 at the low end, 1 at the high end.
    pub(crate) fn fraction_of_working(&self, working: f64) -> f64 {
        (working - self.lo) / self.span()
    }
}

fn range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.fold(None, |range, v| match range {
        None => Some((v, v)),
        Some((lo, hi)) => Some((f64::min(lo, v), f64::max(hi, v))),
    })
}

/// Label of a tick: a decimal number, or a power of ten with its factor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Label {
    base: String,
    exponent: Option<i32>,
}

impl Label {
    pub(crate) fn decimal(value: f64, decimals: usize) -> Self {
        Self { base: format!("{value:.decimals$}").replace('-', "\u{2212}"), exponent: None }
    }

    /// Creates `base` with a superscript. `base` is "10" or a multiple of 10.
    pub(crate) fn power(base: &str, exponent: i32) -> Self {
        Self { base: base.to_owned(), exponent: Some(exponent) }
    }

    pub(crate) fn width(&self) -> f64 {
        text_width(&self.base, TEXT) + text_width(&self.superscript(), SUPERSCRIPT)
    }

    pub(crate) fn draw(&self, at: Pt, anchor: &str) -> SvgElement {
        if self.exponent.is_none() {
            return SvgElement::text(at, anchor, &self.base);
        }
        // Some converters anchor a superscript separately, so two texts meet at `joint`.
        let left_of_joint = text_width(&self.base, TEXT);
        let joint = match anchor {
            "start" => at.0 + left_of_joint,
            "middle" => at.0 - self.width() / 2.0 + left_of_joint,
            _ => at.0 - self.width() + left_of_joint,
        };
        let base = SvgElement::text((joint, at.1), "end", &self.base);
        let exponent = SvgElement::text((joint, at.1 - 5.0), "start", &self.superscript());
        SvgElement::group(&[base, exponent.at("font-size", SUPERSCRIPT)])
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
    use approx::assert_abs_diff_eq;
    use rstest::rstest;

    const NONE: Pad = Pad { lo: 0.0, hi: 0.0 };

    #[rstest]
    #[case(&[0.01, 1.0], -2.0, 0.0)]
    #[case(&[0.1, 0.1], -1.25, -0.75)]
    #[case(&[0.0, -1.0, f64::NAN], -1.0, 0.0)]
    fn log_ranges(#[case] values: &[f64], #[case] lo: f64, #[case] hi: f64) {
        let scale = Scale::log(values.iter().copied(), NONE);
        assert_abs_diff_eq!(scale.lo, lo, epsilon = 1e-12);
        assert_abs_diff_eq!(scale.hi, hi, epsilon = 1e-12);
    }

    #[test]
    fn exponents_are_separate_texts() {
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

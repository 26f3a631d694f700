//! Assigns colours to numbers, from dark to light in steps of equal lightness. The colours remain
//! distinguishable in grey print.

use super::plot::scale::{Pad, Scale};
use super::plot::style::INK;
use super::plot::svg::{Pt, SvgElement};
use super::plot::ticks::{self, Tick};

/// Height of the colour bar without its labels (px).
const BAR: f64 = 12.0;
/// Width of the colour bar (px).
pub(super) const BAR_WIDTH: f64 = 240.0;
/// Number of shades in the colour bar.
const SHADES: u32 = 48;
/// Minimum ratio of the largest to the smallest value for which the scale is logarithmic.
const SPAN: f64 = 1e3;

#[derive(Debug, Clone, Copy)]
pub(super) struct ColourScale(Scale);

impl ColourScale {
    /// Creates the scale from the smallest to the largest finite value.
    pub(super) fn of(values: impl Iterator<Item = f64>) -> Self {
        let finite = values.filter(|value| value.is_finite());
        let (low, high) = finite
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        let (low, high) = if low < high { (low, high) } else { (0.0, 1.0) };
        let (ends, none) = ([low, high].into_iter(), Pad { lo: 0.0, hi: 0.0 });
        let is_logarithmic = low > 0.0 && high / low > SPAN;
        Self(if is_logarithmic { Scale::log(ends, none) } else { Scale::linear(ends, none) })
    }

    /// Returns the position of a value between dark (0) and light (1).
    pub(super) fn share(self, value: f64) -> f64 {
        self.0.fraction(value)
    }

    /// Draws a colour bar with its upper left corner at `corner`, numbers below it, and `label` on
    /// its left.
    pub(super) fn bar(self, corner: Pt, label: &str) -> SvgElement {
        let (x, y) = corner;
        let mut group = SvgElement::new("g");
        let step = BAR_WIDTH / f64::from(SHADES);
        for k in 0..SHADES {
            let (fill, _) = colour((f64::from(k) + 0.5) / f64::from(SHADES));
            let at = x + step * f64::from(k);
            let shade = SvgElement::new("rect").at("x", at).at("y", y);
            // Shades overlap slightly, so that there are no gaps between them.
            let wide = if k + 1 < SHADES { step + 0.6 } else { step };
            group.add(&shade.at("width", wide).at("height", BAR).set("fill", &fill));
        }
        let mut numbers = SvgElement::new("g").set("class", "ticks");
        for Tick { at, label } in ticks::choose(&self.0, BAR_WIDTH, |label| label.width() + 12.0) {
            let Some(label) = label else { continue };
            let x = x + at * BAR_WIDTH;
            let (top, bottom) = (y + BAR, y + BAR + 4.0);
            group.add(&SvgElement::line((x, top), (x, bottom)).set("stroke", INK));
            numbers.add(&label.draw((x, y + BAR + 16.0), "middle"));
        }
        group.add(&numbers);
        if let Some(factor) = self.0.factor() {
            group.add(&factor.draw((x + BAR_WIDTH + 8.0, y + BAR - 2.0), "start"));
        }
        group.add(&SvgElement::text((x - 8.0, y + BAR - 2.0), "end", label));
        group
    }
}

/// Text colours on dark and light fields. The palette does not contain these colours because they
/// are the same in both themes.
const OVER_DARK: &str = "#fff";
const OVER_LIGHT: &str = "#222";

/// Red, green and blue of the shades, from dark to light (cividis, after Nunez, Anderton & Renslow
/// 2018).
const COLOURS: [[f64; 3]; 6] = [
    [0.0, 32.0, 81.0],
    [60.0, 77.0, 110.0],
    [107.0, 110.0, 119.0],
    [148.0, 143.0, 120.0],
    [202.0, 186.0, 106.0],
    [253.0, 234.0, 69.0],
];

/// Returns the colour at `share` (0 dark, 1 light), and the colour of text on it.
pub(super) fn colour(share: f64) -> (String, &'static str) {
    let last = COLOURS.len() - 1;
    let place = share.clamp(0.0, 1.0) * last as f64;
    let low = (place as usize).min(last - 1);
    let rest = place - low as f64;
    let mixed: [f64; 3] =
        std::array::from_fn(|k| COLOURS[low][k] * (1.0 - rest) + COLOURS[low + 1][k] * rest);
    let [r, g, b] = mixed.map(|channel| libm::round(channel) as u8);
    (format!("#{r:02x}{g:02x}{b:02x}"), if share < 0.5 { OVER_DARK } else { OVER_LIGHT })
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    #[test]
    fn a_range_of_decades_has_a_logarithmic_scale() {
        let scale = ColourScale::of([1e-2, 1.0, 1e8, f64::INFINITY].into_iter());
        assert_abs_diff_eq!(scale.share(1e3), 0.5, epsilon = 1e-12);
        let scale = ColourScale::of([0.0, 1e8].into_iter());
        assert_eq!(scale.share(5e7), 0.5);
    }

    #[test]
    fn tick_labels_are_round_numbers() {
        let numbers = |values: [f64; 2]| {
            let ColourScale(scale) = ColourScale::of(values.into_iter());
            let ticks = ticks::choose(&scale, BAR_WIDTH, |label| label.width() + 12.0);
            let labels = ticks.iter().filter_map(|tick| tick.label.as_ref());
            labels.map(ToString::to_string).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(numbers([12.7, 50_843_013.70]), "10^2 10^3 10^4 10^5 10^6 10^7");
        assert_eq!(numbers([0.013, 0.87]), "0.2 0.4 0.6 0.8");
        assert_eq!(numbers([0.0, 50_843_013.70]), "0 1 2 3 4 5");
    }
}

//! Colours of numbers, from dark to light in steps of equal lightness, so that they survive grey
//! print.

use super::plot::style::{INK, PAPER};
use super::plot::svg::SvgElement;

/// Height of the bar of colours, with its labels.
const BAR: f64 = 12.0;
/// Width of the bar of colours.
pub(super) const BAR_WIDTH: f64 = 240.0;
/// Steps of the bar.
const SHADES: u32 = 48;
/// Positive values that span more have colours by their logarithms.
const SPAN: f64 = 1e3;

/// Colours of values.
#[derive(Debug, Clone, Copy)]
pub(super) struct ColourScale {
    low: f64,
    high: f64,
    is_logarithmic: bool,
}

impl ColourScale {
    /// The scale from the smallest to the largest finite value.
    pub(super) fn of(values: impl Iterator<Item = f64>) -> Self {
        let finite = values.filter(|value| value.is_finite());
        let (low, high) = finite
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        let (low, high) = if low < high { (low, high) } else { (0.0, 1.0) };
        Self { low, high, is_logarithmic: low > 0.0 && high / low > SPAN }
    }

    /// The share of the way from dark to light.
    pub(super) fn share(self, value: f64) -> f64 {
        let [value, low, high] = if self.is_logarithmic {
            [value, self.low, self.high].map(libm::log)
        } else {
            [value, self.low, self.high]
        };
        (value - low) / (high - low)
    }

    /// The values at both ends of the bar and in its middle, as labels.
    fn labels(self) -> [String; 3] {
        let Self { low, high, is_logarithmic } = self;
        let middle = if is_logarithmic { libm::sqrt(low * high) } else { 0.5 * (low + high) };
        [low, middle, high].map(|value| match high.abs() {
            _ if is_logarithmic => format!("{value:.0e}"),
            most if most < 1e-2 => format!("{value:.1e}"),
            most if most < 0.995 => format!("{value:.4}"),
            _ => format!("{value:.2}"),
        })
    }

    /// The colours with their numbers, in a bar whose `label` stands before it.
    pub(super) fn bar(self, (x, y): (f64, f64), label: &str) -> SvgElement {
        let mut group = SvgElement::new("g");
        let step = BAR_WIDTH / f64::from(SHADES);
        for k in 0..SHADES {
            let (fill, _) = colour((f64::from(k) + 0.5) / f64::from(SHADES));
            let at = x + step * f64::from(k);
            let shade = SvgElement::new("rect").at("x", at).at("y", y);
            // Wider than its place, so that no gap shows between neighbours.
            let wide = if k + 1 < SHADES { step + 0.6 } else { step };
            group.add(&shade.at("width", wide).at("height", BAR).set("fill", &fill));
        }
        let places = [(0.0, "start"), (0.5, "middle"), (1.0, "end")];
        for ((share, anchor), value) in places.into_iter().zip(self.labels()) {
            let at = (x + share * BAR_WIDTH, y + BAR + 15.0);
            group.add(&SvgElement::text(at, anchor, &value));
        }
        group.add(&SvgElement::text((x - 8.0, y + BAR - 2.0), "end", label));
        group
    }
}

/// Red, green and blue from dark to light (after Nunez, Anderton & Renslow 2018, cividis).
const COLOURS: [[f64; 3]; 6] = [
    [0.0, 32.0, 81.0],
    [60.0, 77.0, 110.0],
    [107.0, 110.0, 119.0],
    [148.0, 143.0, 120.0],
    [202.0, 186.0, 106.0],
    [253.0, 234.0, 69.0],
];

/// The colour at `share` of the way from dark to light, and that of a text over it.
pub(super) fn colour(share: f64) -> (String, &'static str) {
    let last = COLOURS.len() - 1;
    let place = share.clamp(0.0, 1.0) * last as f64;
    let low = (place as usize).min(last - 1);
    let rest = place - low as f64;
    let mixed: [f64; 3] =
        std::array::from_fn(|k| COLOURS[low][k] * (1.0 - rest) + COLOURS[low + 1][k] * rest);
    let [r, g, b] = mixed.map(|channel| libm::round(channel) as u8);
    (format!("#{r:02x}{g:02x}{b:02x}"), if share < 0.5 { PAPER } else { INK })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_over_decades_have_colours_by_their_logarithms() {
        let scale = ColourScale::of([1e-2, 1.0, 1e8, f64::INFINITY].into_iter());
        assert!((scale.share(1e3) - 0.5).abs() <= 1e-12);
        assert_eq!(scale.labels(), ["1e-2", "1e3", "1e8"]);
        let scale = ColourScale::of([0.0, 1e8].into_iter());
        assert_eq!(scale.share(5e7), 0.5);
    }
}

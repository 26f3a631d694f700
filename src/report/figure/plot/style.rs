//! Sizes and colours of figures, and styles that distinguish series.

/// Width of a figure (px). At this width, texts have at least 9 pixels on a narrow screen.
pub(crate) const WIDTH: f64 = 440.0;
/// Height of the frame around the data (px).
pub(crate) const FRAME_HEIGHT: f64 = 256.0;

/// Font stack of sans-serif faces with similar metrics.
pub(crate) const FONT: &str = "Helvetica, Arial, 'DejaVu Sans', sans-serif";
/// Font size of labels and legend texts (px).
pub(crate) const TEXT: f64 = 12.0;
/// Font size of exponents (px).
pub(crate) const SUPERSCRIPT: f64 = 11.0;
/// Font size of the title (px).
pub(crate) const TITLE: f64 = 13.0;

/// Colour of the paper and of the inside of hollow markers.
pub(crate) const PAPER: &str = "#ffffff";
/// Colour of texts, frame and ticks.
pub(crate) const INK: &str = "#222222";
pub(crate) const GRID: &str = "#e3e3e3";
/// Colour of elements that belong to no series, such as reference lines.
pub(crate) const NEUTRAL: &str = "#4d4d4d";
/// Colour of methods that are drawn for comparison only.
pub(crate) const CONTEXT: &str = "#8e8e8e";
/// Colour of the Pareto front, a band behind all lines.
pub(crate) const FRONT: &str = "#fbe9a6";

/// Colours of the light theme with their replacements in the dark theme.
const PALETTE: [(&str, &str); 6] = [
    (PAPER, "#15181e"),
    (INK, "#e6e6e6"),
    (GRID, "#333943"),
    (NEUTRAL, "#b4b8bf"),
    (CONTEXT, "#747a83"),
    (FRONT, "#4a4a2a"),
];

/// Colours of series in the light and the dark theme, after Okabe and Ito, without yellow and with
/// darker orange and sky blue for the contrast of 3:1 that WCAG 2.2 (1.4.11) requires.
const SERIES: [(&str, &str); 7] = [
    ("#0072b2", "#4ba6e3"),
    ("#d55e00", "#f0803c"),
    ("#009e73", "#1fbf92"),
    ("#cc79a7", "#d98cba"),
    ("#b97f00", "#e69f00"),
    ("#2f94cf", "#8fd0f5"),
    ("#000000", "#ffffff"),
];

/// Returns the style sheet of the dark theme, for readers who prefer it. Elements have the colours
/// of the light theme as attributes, so figures do not change in print or in programs without
/// `light-dark()`. Colours outside the palette, such as those of map fields, do not change.
pub(crate) fn style_sheet() -> String {
    let rule = |(light, dark): &(&str, &str)| {
        let colour = format!("light-dark({light},{dark})");
        format!("[fill=\"{light}\"]{{fill:{colour}}}[stroke=\"{light}\"]{{stroke:{colour}}}\n")
    };
    let rules: String = PALETTE.iter().chain(&SERIES).map(rule).collect();
    format!(
        "@supports (color:light-dark(#000,#fff)){{\nsvg{{color-scheme:light dark}}\n{rules}}}\n\
         @media print{{svg{{color-scheme:light}}}}\n"
    )
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MarkerShape {
    Circle,
    Square,
    Up,
    Diamond,
    Down,
    Pentagon,
    Right,
    Star,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Look {
    pub(crate) colour: &'static str,
    pub(crate) shape: MarkerShape,
    /// Dash pattern (`stroke-dasharray`).
    pub(crate) dash: &'static str,
}

const SHAPES: [MarkerShape; 8] = [
    MarkerShape::Circle,
    MarkerShape::Square,
    MarkerShape::Up,
    MarkerShape::Diamond,
    MarkerShape::Down,
    MarkerShape::Pentagon,
    MarkerShape::Right,
    MarkerShape::Star,
];

const DASHES: [&str; 8] =
    ["6 2.5", "1.5 2", "9 2.5 1.5 2.5", "3 2", "12 3", "6 2 1.5 2 1.5 2", "4 4", "1.5 4"];

/// Returns the style of the series at `index`. Colours and shapes have coprime periods, so their
/// combinations repeat only after 56 series.
pub(crate) fn look(index: usize) -> Look {
    Look {
        colour: SERIES[index % SERIES.len()].0,
        shape: SHAPES[index % SHAPES.len()],
        dash: DASHES[index % DASHES.len()],
    }
}

/// Returns the contrast ratio of two colours `#rrggbb` (WCAG 2.2), from 1 to 21.
#[cfg(test)]
pub(crate) fn contrast(a: &str, b: &str) -> f64 {
    let luminance = |colour: &str| {
        let channel = |at: usize| {
            let value = u8::from_str_radix(&colour[at..at + 2], 16).expect("two digits");
            let value = f64::from(value) / 255.0;
            if value <= 0.040_45 { value / 12.92 } else { libm::pow((value + 0.055) / 1.055, 2.4) }
        };
        0.2126 * channel(1) + 0.7152 * channel(3) + 0.0722 * channel(5)
    };
    let (a, b) = (luminance(a), luminance(b));
    (f64::max(a, b) + 0.05) / (f64::min(a, b) + 0.05)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_eight_series_differ_in_grey_print() {
        for a in 0..8 {
            for b in 0..a {
                assert_ne!(look(a).shape, look(b).shape);
                assert_ne!(look(a).dash, look(b).dash);
            }
        }
    }

    #[test]
    fn the_first_56_series_have_different_styles() {
        for a in 0..56 {
            assert!((0..a).all(|b| look(a) != look(b)));
        }
    }

    /// Returns the light and the dark variant of a palette colour.
    fn schemes(light: &str) -> [&'static str; 2] {
        let mut all = PALETTE.iter().chain(&SERIES);
        all.find(|colour| colour.0 == light).map(|colour| [colour.0, colour.1]).expect(light)
    }

    #[test]
    fn texts_and_lines_have_contrast_in_both_schemes() {
        assert!((contrast("#777777", "#ffffff") - 4.48).abs() < 0.005, "that of the standard");
        let lines = SERIES.iter().map(|colour| colour.0).chain([CONTEXT]);
        for (colour, least) in lines.map(|colour| (colour, 3.0)).chain([(INK, 7.0), (NEUTRAL, 7.0)])
        {
            for (ink, paper) in schemes(colour).iter().zip(schemes(PAPER)) {
                assert!(contrast(ink, paper) >= least, "{ink}: {}", contrast(ink, paper));
            }
        }
        for (colour, _) in SERIES {
            for (ink, band) in schemes(colour).iter().zip(schemes(FRONT)) {
                assert!(contrast(ink, band) >= 2.3, "{ink}: {}", contrast(ink, band));
            }
        }
    }

    #[test]
    fn colours_differ_in_both_schemes() {
        for scheme in [0, 1] {
            let all = PALETTE.iter().chain(&SERIES).map(|colour| schemes(colour.0)[scheme]);
            let mut all: Vec<&str> = all.collect();
            all.sort_unstable();
            all.dedup();
            assert_eq!(all.len(), PALETTE.len() + SERIES.len());
        }
    }
}

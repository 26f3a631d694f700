//! Sizes, colours, and what tells one series from another.

/// Width of a figure in pixels: on a narrow screen its texts still have 9 pixels.
pub(crate) const WIDTH: f64 = 440.0;
/// Height of a figure in pixels, before a legend or notes below the axes lengthen it.
pub(crate) const HEIGHT: f64 = 340.0;

/// The font stack: sans-serif faces with the same metrics as far as possible.
pub(crate) const FONT: &str = "Helvetica, Arial, 'DejaVu Sans', sans-serif";
/// Size of labels and legend texts.
pub(crate) const TEXT: f64 = 12.0;
/// Size of exponents.
pub(crate) const SUPERSCRIPT: f64 = 11.0;
/// Size of the title.
pub(crate) const TITLE: f64 = 13.0;

/// The page.
pub(crate) const PAPER: &str = "#ffffff";
/// Texts, frame and ticks.
pub(crate) const INK: &str = "#222222";
/// Grid lines.
pub(crate) const GRID: &str = "#e3e3e3";
/// The exact solution: light, since the subject curves are drawn over it.
pub(crate) const EXACT: &str = "#bdbdbd";
/// Colour of all that belongs to no series: keys of the marks, slope triangles.
pub(crate) const NEUTRAL: &str = "#4d4d4d";

/// Colour of the Pareto front, a band below all lines.
pub(crate) const FRONT: &str = "#fbe9a6";
/// Methods that are there for comparison only.
pub(crate) const CONTEXT: &str = "#b8b8b8";

/// Outline of a marker.
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

/// The appearance of one series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Look {
    /// Colour of line and marker.
    pub(crate) colour: &'static str,
    /// Outline of the marker.
    pub(crate) shape: MarkerShape,
    /// Dash pattern (`stroke-dasharray`).
    pub(crate) dash: &'static str,
}

/// The colours of Okabe and Ito, without the yellow, which is too pale on white paper.
const COLOURS: [&str; 7] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"];

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

/// The appearance of the series at `index`. Colours and shapes have coprime periods, so that
/// their combination repeats only after 56 series.
pub(crate) fn look(index: usize) -> Look {
    Look {
        colour: COLOURS[index % COLOURS.len()],
        shape: SHAPES[index % SHAPES.len()],
        dash: DASHES[index % DASHES.len()],
    }
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
    fn no_look_is_repeated_within_56_series() {
        for a in 0..56 {
            assert!((0..a).all(|b| look(a) != look(b)));
        }
    }
}

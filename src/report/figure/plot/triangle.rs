//! Slope triangles: reference orders in the lower right corner of a frame.

use super::canvas::text_width;
use super::frame::Plot;
use super::scale::Pad;
use super::style::{FRAME_HEIGHT, NEUTRAL, SHADE, TEXT};
use super::svg::{Pt, SvgElement};

/// A slope triangle, defined by the lengths of its sides (px).
#[derive(Clone, Copy, Debug)]
struct Triangle {
    order: f64,
    run: f64,
    rise: f64,
    /// Width of the captions and gaps next to the triangle (px).
    captions: f64,
}

impl Triangle {
    /// Whether the triangle is neither too flat nor too narrow; false if a side is not finite.
    fn is_drawn(&self) -> bool {
        self.run >= SHORTEST && self.rise >= SHORTEST
    }
}

/// The slope triangles of a figure, next to each other in the lower right corner.
#[derive(Clone, Debug)]
pub(crate) struct TriangleRow {
    triangles: Vec<Triangle>,
    /// Maximum width of the row (px) over all scalings of the vertical axis.
    widest: f64,
}

/// Length of both sides (px) for a slope of 1 in the figure. Triangles with other slopes have the
/// same area.
const SIDE: f64 = 44.0;
/// Maximum length of a side (px).
const LONGEST: f64 = 52.0;
/// Minimum length of a side (px). A shorter side would not be recognisable as a slope.
const SHORTEST: f64 = 8.0;
/// Maximum width of the row as a fraction of the frame width.
const WIDEST: f64 = 0.85;
/// Distance to the frame, and between a triangle and the caption of the previous one (px).
const GAP: f64 = 12.0;
/// Height of the caption below a triangle (px).
const CAPTION: f64 = 14.0;
/// Distance between a triangle and the caption next to it (px).
const CAPTION_GAP: f64 = 5.0;
/// Distance to the data (px). A marker extends about six pixels from its centre.
const CLEAR: f64 = 14.0;

impl TriangleRow {
    pub(crate) fn new(orders: &[f64], plot: &Plot) -> Self {
        let (across, up) = plot.pace();
        let slot = WIDEST * plot.frame.w / orders.len().max(1) as f64;
        let mut widest = 0.0;
        let triangle = |&order: &f64| {
            let slope = order * up / across;
            let captions = CAPTION_GAP + text_width(&name(order), TEXT) + GAP;
            let longest = f64::min(LONGEST, slot - captions);
            widest += longest + captions;
            let run = (SIDE / libm::sqrt(slope)).min(LONGEST / slope).min(longest);
            Triangle { order, run, rise: run * slope, captions }
        };
        let triangles = orders.iter().map(triangle).collect();
        Self { triangles, widest }
    }

    /// Returns the orders whose triangles would be too flat, too steep or too small to be readable.
    pub(crate) fn left_out(&self) -> impl Iterator<Item = f64> {
        self.triangles.iter().filter(|triangle| !triangle.is_drawn()).map(|triangle| triangle.order)
    }

    fn drawn(&self) -> impl Iterator<Item = &Triangle> {
        self.triangles.iter().filter(|triangle| triangle.is_drawn())
    }

    /// Returns the fraction of the frame that must be empty below the data, so that triangles do
    /// not touch `paths` (px). `plot` is drawn with `pad` at the ends of its vertical axis.
    ///
    /// A taller strip compresses the data and makes the triangles flatter. A triangle that was too
    /// narrow may then be drawn, so the computation includes the heights of all triangles.
    pub(crate) fn strip(&self, plot: &Plot, paths: &[Vec<Pt>], pad: Pad) -> f64 {
        let highest = self.triangles.iter().map(|t| t.rise).fold(0.0, f64::max);
        let left = plot.frame.right() - self.widest - CLEAR;
        let lowest = paths.iter().filter_map(|path| lowest_right_of(path, left));
        let lowest = lowest.fold(f64::NEG_INFINITY, f64::max);
        if highest < SHORTEST || lowest.is_infinite() {
            return pad.lo;
        }
        let needed = (GAP + CAPTION + highest + CLEAR) / FRAME_HEIGHT;
        // `share` is the height of the lowest data, as a fraction of the range of all data.
        let height = (plot.frame.bottom() - lowest) / FRAME_HEIGHT;
        let share = (height - pad.lo) / (1.0 - pad.lo - pad.hi);
        let rest = 1.0 - share;
        if rest > 0.0 { f64::max(pad.lo, (needed - share * (1.0 - pad.hi)) / rest) } else { pad.lo }
    }

    /// Draws the triangles with captions: `1` for the run, and the order for the rise.
    pub(crate) fn draw(&self, plot: &Plot) -> SvgElement {
        let bottom = plot.frame.bottom() - GAP - CAPTION;
        let width: f64 = self.drawn().map(|triangle| triangle.run + triangle.captions).sum();
        let mut left = plot.frame.right() - width;
        let mut group = SvgElement::new("g").set("fill", NEUTRAL);
        for &Triangle { order, run, rise, captions } in self.drawn() {
            let right = left + run;
            let corners = [(left, bottom), (right, bottom - rise), (right, bottom)];
            group.add(
                &SvgElement::through("polygon", &corners)
                    .set("fill", SHADE)
                    .set("stroke", NEUTRAL)
                    .at("stroke-width", 0.9)
                    .set("stroke-linejoin", "round"),
            );
            let below = (f64::midpoint(left, right), bottom + CAPTION);
            group.add(&SvgElement::text(below, "middle", "1"));
            let beside = (right + CAPTION_GAP, bottom - rise / 2.0 + 4.0);
            group.add(&SvgElement::text(beside, "start", &name(order)));
            left = right + captions;
        }
        group
    }
}

/// Returns the lowest pixel of a path to the right of `left`.
fn lowest_right_of(path: &[Pt], left: f64) -> Option<f64> {
    let points = path.iter().filter(|point| point.0 >= left).map(|point| point.1);
    let crossing = path.windows(2).filter(|ends| ends[0].0 < left && ends[1].0 >= left);
    let crossing = crossing.map(|ends| {
        let (a, b) = (ends[0], ends[1]);
        a.1 + (left - a.0) / (b.0 - a.0) * (b.1 - a.1)
    });
    points.chain(crossing).max_by(f64::total_cmp)
}

/// Formats an order in the usual notation: thirds as fractions, other values as short decimals.
pub(crate) fn name(order: f64) -> String {
    const TOLERANCE: f64 = 0.005;
    let thirds = libm::round(3.0 * order);
    let whole = libm::round(order);
    if (order - whole).abs() >= TOLERANCE && (order - thirds / 3.0).abs() < TOLERANCE {
        return format!("{thirds}/3");
    }
    let decimals = format!("{order:.2}");
    decimals.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case(2.0, "2")]
    #[case(5.0 / 3.0, "5/3")]
    #[case(1.67, "5/3")]
    #[case(1.5, "1.5")]
    #[case(0.75, "0.75")]
    #[case(10.0, "10")]
    fn names(#[case] order: f64, #[case] expected: &str) {
        assert_eq!(name(order), expected);
    }

    #[rstest]
    #[case(&[(0.0, 0.0), (10.0, 20.0)], 5.0, Some(20.0))]
    #[case(&[(0.0, 20.0), (10.0, 0.0)], 5.0, Some(10.0))]
    #[case(&[(0.0, 20.0), (10.0, 0.0)], 10.0, Some(0.0))]
    #[case(&[(0.0, 20.0), (10.0, 0.0)], 11.0, None)]
    #[case(&[(7.0, 3.0)], 5.0, Some(3.0))]
    #[case(&[], 5.0, None)]
    fn lowest_pixels_include_lines_between_points(
        #[case] path: &[Pt],
        #[case] left: f64,
        #[case] lowest: Option<f64>,
    ) {
        assert_eq!(lowest_right_of(path, left), lowest);
    }
}

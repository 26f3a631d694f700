//! Slope triangles: the reference orders, drawn where they touch nothing.

use super::frame::Plot;
use super::space::{Rect, Space};
use super::style::{NEUTRAL, TEXT};
use super::svg::{Pt, SvgElement};
use super::text;

/// A slope triangle with its place.
#[derive(Clone, Debug)]
pub(crate) struct Triangle {
    order: f64,
    /// Ends of the hypotenuse and the right angle.
    corners: [Pt; 3],
    captions: [Caption; 2],
    /// The box around triangle and captions.
    pub(crate) area: Rect,
}

#[derive(Clone, Debug)]
struct Caption {
    at: Pt,
    anchor: &'static str,
    area: Rect,
}

/// Square roots of run times rise, tried from large to small.
const SIZES: [f64; 5] = [66.0, 54.0, 44.0, 34.0, 26.0];
/// A side shorter than this (pixels) could not be read as a slope.
const SHORTEST: f64 = 12.0;
/// No side exceeds this fraction of the frame.
const LONGEST: f64 = 0.4;
/// Distance of places which are tried.
const STEP: f64 = 7.0;
/// Distance from the data; a marker reaches about six pixels from its centre.
const CLEAR: f64 = 12.0;

/// The free place for the triangle of `order` where its hypotenuse follows the data best, so that
/// slopes can be compared by eye.
pub(crate) fn place(order: f64, plot: &Plot, space: &Space, taken: &[Rect]) -> Option<Triangle> {
    let (across, up) = plot.pace();
    let aspect = libm::sqrt(order * up / across);
    let frame = plot.frame;
    let caption_width = text::width(&name(order), TEXT);
    for size in SIZES {
        let (run, rise) = (size / aspect, size * aspect);
        let shrink = (LONGEST * frame.w / run).min(LONGEST * frame.h / rise).min(1.0);
        let (run, rise) = (run * shrink, rise * shrink);
        // Also false for an aspect which is not a number.
        if !(run >= SHORTEST && rise >= SHORTEST) {
            continue;
        }
        let mut best: Option<(f64, Triangle)> = None;
        for i in 0..(frame.w / STEP) as i32 {
            for j in 0..(frame.h / STEP) as i32 {
                let low = (frame.x + STEP * f64::from(i), frame.bottom() - STEP * f64::from(j));
                for below in [true, false] {
                    let corners = corners(low, (run, rise), below);
                    let triangle = Triangle::new(order, corners, caption_width);
                    if !triangle.is_free(&frame, space, taken) {
                        continue;
                    }
                    let mismatch = triangle.mismatch(space);
                    if best.as_ref().is_none_or(|(least, _)| mismatch < *least) {
                        best = Some((mismatch, triangle));
                    }
                }
            }
        }
        if let Some((_, triangle)) = best {
            return Some(triangle);
        }
    }
    None
}

/// Both ends of a hypotenuse which rises from `low`, then the right angle below or above it.
fn corners(low: Pt, (run, rise): Pt, below: bool) -> [Pt; 3] {
    let high = (low.0 + run, low.1 - rise);
    [low, high, if below { (high.0, low.1) } else { (low.0, high.1) }]
}

impl Triangle {
    /// The triangle with its captions outside, the slope's being `caption_width` wide.
    fn new(order: f64, corners: [Pt; 3], caption_width: f64) -> Self {
        let [low, high, right_angle] = corners;
        let (middle_x, middle_y) = (f64::midpoint(low.0, high.0), f64::midpoint(low.1, high.1));
        let (x, y) = right_angle;
        let below = y > high.1;
        let (baseline, side, anchor) =
            if below { (y + 14.0, x + 5.0, "start") } else { (y - 5.0, x - 5.0, "end") };
        let slope_left = if below { side } else { side - caption_width };
        let run = Caption {
            at: (middle_x, baseline),
            anchor: "middle",
            area: Rect { x: middle_x - 5.0, y: baseline - 10.0, w: 10.0, h: 11.0 },
        };
        let slope = Caption {
            at: (side, middle_y + 4.0),
            anchor,
            area: Rect { x: slope_left, y: middle_y - 6.0, w: caption_width, h: 11.0 },
        };
        let (left, top) = (low.0.min(slope.area.x), high.1.min(run.area.y).min(slope.area.y));
        let right = high.0.max(slope.area.right());
        let bottom = low.1.max(run.area.bottom()).max(slope.area.bottom());
        let area = Rect { x: left, y: top, w: right - left, h: bottom - top };
        Self { order, corners, captions: [run, slope], area }
    }

    fn is_free(&self, frame: &Rect, space: &Space, taken: &[Rect]) -> bool {
        frame.grown(-8.0).contains(&self.area)
            && taken.iter().all(|other| !self.area.grown(8.0).overlaps(other))
            && self.samples().all(|at| space.clearance(at) >= CLEAR)
            && self.captions.iter().all(|t| space.clearance_of(&t.area) >= CLEAR)
    }

    /// Points spread over the area, closer to one another than twice the required clearance.
    fn samples(&self) -> impl Iterator<Item = Pt> {
        const PARTS: i32 = 16;
        let [a, b, c] = self.corners;
        (0..=PARTS).flat_map(move |i| {
            (0..=PARTS - i).map(move |j| {
                let (u, v) = (f64::from(i) / f64::from(PARTS), f64::from(j) / f64::from(PARTS));
                let along = |a: f64, b: f64, c: f64| a + u * (b - a) + v * (c - a);
                (along(a.0, b.0, c.0), along(a.1, b.1, c.1))
            })
        })
    }

    /// How ill the hypotenuse compares with the data beside it: its mean distance, and what the
    /// distance varies along it, which is little beside a line of the same slope.
    fn mismatch(&self, space: &Space) -> f64 {
        const PARTS: i32 = 12;
        const VARIATION: f64 = 4.0;
        let [low, high, _] = self.corners;
        let distances = (0..=PARTS)
            .map(|i| f64::from(i) / f64::from(PARTS))
            .map(|s| (low.0 + s * (high.0 - low.0), low.1 + s * (high.1 - low.1)))
            .map(|at| space.clearance(at));
        let (mut sum, mut least, mut largest) = (0.0, f64::INFINITY, 0.0_f64);
        for distance in distances {
            sum += distance;
            least = least.min(distance);
            largest = largest.max(distance);
        }
        sum / f64::from(PARTS + 1) + VARIATION * (largest - least)
    }

    /// The triangle with its run and its slope.
    pub(crate) fn draw(&self) -> SvgElement {
        let mut group = SvgElement::new("g").set("fill", NEUTRAL);
        group.add(
            &SvgElement::through("polygon", &self.corners)
                .set("fill", "#f3f3f3")
                .set("stroke", NEUTRAL)
                .at("stroke-width", 0.9)
                .set("stroke-linejoin", "round"),
        );
        let texts = ["1".to_owned(), name(self.order)];
        for (caption, text) in self.captions.iter().zip(&texts) {
            group.add(&SvgElement::text(caption.at, caption.anchor, text));
        }
        group
    }
}

/// An order as it is customarily written: thirds as fractions, others as short decimals.
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
}

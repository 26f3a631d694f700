//! The history plot: curves with linear axes, such as a velocity over time.

use super::plot::frame::{KEY, Legend, LegendEntry};
use super::plot::frame::{Plot, Titles};
use super::plot::marker;
use super::plot::marker::{Fill, RADIUS};
use super::plot::scale::{Pad, Scale};
use super::plot::style::{EXACT, Look, look};
use super::plot::svg::{Pt, SvgElement};

/// Curves with linear axes.
#[derive(Clone, Debug, PartialEq)]
pub struct HistoryPlot {
    /// Title above the frame.
    pub title: String,
    /// Label of the horizontal axis with its unit.
    pub x_label: String,
    /// Label of the vertical axis with its unit.
    pub y_label: String,
    /// The curves. Later ones cover earlier ones.
    pub curves: Vec<Curve>,
}

/// One curve of a history plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Name in the legend. A curve without a name has no legend entry.
    pub name: String,
    /// Index of the curve's colour. The exact solution has a separate colour.
    pub look: usize,
    /// The points in drawing order. A point that is not finite interrupts the curve.
    pub points: Vec<(f64, f64)>,
    /// Whether this is the exact solution, which is drawn as a thick light line.
    pub exact: bool,
    /// Whether points have markers. Markers that would overlap are omitted.
    pub markers: bool,
}

/// A curve in pixels, with its style.
struct CurveLine<'a> {
    curve: &'a Curve,
    look: Look,
    runs: Vec<Vec<Pt>>,
}

/// Minimum distance between the centres of markers on a curve.
const MARKER_DISTANCE: f64 = 2.4 * RADIUS;

impl HistoryPlot {
    /// Creates the figure as a standalone SVG document.
    pub fn to_svg(&self) -> String {
        self.to_svg_among(std::slice::from_ref(self))
    }

    /// Creates the figure as SVG. The axes are long enough for all data of `figures`, which must
    /// include this figure.
    pub(crate) fn to_svg_among(&self, figures: &[Self]) -> String {
        let plot = self.plot(figures);
        let lines: Vec<CurveLine> = self
            .curves
            .iter()
            .map(|curve| CurveLine {
                curve,
                look: if curve.exact {
                    Look { colour: EXACT, ..look(0) }
                } else {
                    look(curve.look)
                },
                runs: runs(&curve.points, &plot),
            })
            .collect();
        let mut layers: Vec<SvgElement> = lines.iter().map(CurveLine::draw).collect();
        if lines.iter().all(|line| line.runs.is_empty()) {
            layers.push(plot.placeholder("no data"));
        }
        let entries = lines.iter().filter(|l| !l.curve.name.is_empty()).map(CurveLine::entry);
        plot.document(&layers, &Legend::new(entries.collect()), &[])
    }

    /// Returns the difference between the highest and the lowest value of the curves.
    pub(crate) fn rise(&self) -> f64 {
        let finite = self.points().map(|point| point.1);
        let (low, high) = finite
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
        f64::max(high - low, 0.0)
    }

    fn points(&self) -> impl Iterator<Item = &Pt> {
        self.curves.iter().flat_map(|curve| &curve.points).filter(|point| is_finite(**point))
    }

    fn plot(&self, figures: &[Self]) -> Plot<'_> {
        let drawn = || figures.iter().flat_map(Self::points);
        let x = Scale::linear(drawn().map(|p| p.0), Pad { lo: 0.02, hi: 0.02 });
        let y = Scale::linear(drawn().map(|p| p.1), Pad { lo: 0.06, hi: 0.06 });
        let titles = Titles { title: &self.title, x_label: &self.x_label, y_label: &self.y_label };
        Plot::new(titles, x, y)
    }
}

fn is_finite(point: Pt) -> bool {
    point.0.is_finite() && point.1.is_finite()
}

/// Splits a curve at its interruptions and converts it to pixels.
fn runs(points: &[Pt], plot: &Plot) -> Vec<Vec<Pt>> {
    points
        .split(|&p| !is_finite(p))
        .filter(|run| !run.is_empty())
        .map(|run| run.iter().map(|&p| plot.place(p)).collect())
        .map(|run: Vec<Pt>| if points.len() > MAX_POINTS { thin(&run) } else { run })
        .collect()
}

impl CurveLine<'_> {
    fn draw(&self) -> SvgElement {
        let mut group = SvgElement::new("g");
        group.add(&SvgElement::new("title").content(&self.curve.name));
        for run in &self.runs {
            if let [only] = run.as_slice() {
                group.add(&self.dot(*only));
            } else {
                group.add(&self.stroke(SvgElement::through("polyline", run)));
            }
        }
        if self.curve.markers {
            let mut last: Option<Pt> = None;
            for &at in self.runs.iter().flatten() {
                let apart = |l: Pt| (at.0 - l.0).abs().max((at.1 - l.1).abs()) >= MARKER_DISTANCE;
                if last.is_none_or(apart) {
                    group.add(&self.marker(at));
                    last = Some(at);
                }
            }
        }
        group
    }

    fn stroke(&self, line: SvgElement) -> SvgElement {
        let line = line
            .set("fill", "none")
            .set("stroke", self.look.colour)
            .set("stroke-linejoin", "round");
        if self.curve.exact {
            line.at("stroke-width", 4.0)
        } else {
            line.at("stroke-width", 1.5).set("stroke-dasharray", self.look.dash)
        }
    }

    /// Draws a dot for a point between two interruptions, where a line would not be visible.
    fn dot(&self, at: Pt) -> SvgElement {
        SvgElement::new("circle")
            .at("cx", at.0)
            .at("cy", at.1)
            .at("r", if self.curve.exact { 2.0 } else { 1.2 })
            .set("fill", self.look.colour)
    }

    fn marker(&self, at: Pt) -> SvgElement {
        marker::draw(self.look.shape, Fill::Hollow, self.look.colour, at)
    }

    fn entry(&self) -> LegendEntry {
        let mut key = SvgElement::new("g");
        key.add(&self.stroke(SvgElement::line((0.0, 0.0), (KEY, 0.0))));
        if self.curve.markers {
            key.add(&self.marker((KEY / 2.0, 0.0)));
        }
        if self.runs.is_empty() {
            LegendEntry::new(key, &format!("{} (no data)", self.curve.name))
        } else {
            LegendEntry::new(key, &self.curve.name)
        }
    }
}

/// Maximum number of points for which a curve is drawn without thinning.
const MAX_POINTS: usize = 1500;

/// Reduces each sequence of points within one pixel column to its first, lowest, highest and last
/// point. These cover the same pixels, so no peak is lost.
fn thin(points: &[Pt]) -> Vec<Pt> {
    points
        .chunk_by(|a, b| libm::floor(a.0) as i64 == libm::floor(b.0) as i64)
        .flat_map(extremes)
        .collect()
}

fn extremes(column: &[Pt]) -> Vec<Pt> {
    let height = |i: usize| column[i].1;
    let by_height = |a: &usize, b: &usize| height(*a).total_cmp(&height(*b));
    let mut kept: Vec<usize> = [
        (0..column.len()).next(),
        (0..column.len()).min_by(by_height),
        (0..column.len()).max_by(by_height),
        (0..column.len()).next_back(),
    ]
    .into_iter()
    .flatten()
    .collect();
    kept.sort_unstable();
    kept.dedup();
    kept.into_iter().map(|i| column[i]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_peaks_and_ends() {
        let mut points: Vec<Pt> =
            (0..10_000).map(|i| (f64::from(i) / 100.0, f64::from(i % 7))).collect();
        points[4321].1 = 99.0;
        points[4322].1 = -99.0;
        let thinned = thin(&points);
        assert!(thinned.len() <= 400);
        assert!(thinned.contains(&points[4321]) && thinned.contains(&points[4322]));
        assert_eq!(thinned.first(), points.first());
        assert_eq!(thinned.last(), points.last());
    }

    #[test]
    fn a_point_alone_in_its_column_is_kept_once() {
        let points = [(0.5, 1.0), (1.5, 2.0), (2.5, 3.0)];
        assert_eq!(thin(&points), points);
    }

    #[test]
    fn order_is_kept_when_the_curve_turns_back() {
        let points = [(0.1, 0.0), (1.1, 1.0), (0.2, 2.0)];
        assert_eq!(thin(&points), points);
    }
}

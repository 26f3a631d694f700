//! The log-log plot: errors against cell size, time step or work.

use super::plot::frame::{KEY, Legend, LegendEntry};
use super::plot::frame::{Plot, Titles};
use super::plot::scale::{Pad, Scale};
use super::plot::style::{CONTEXT, FRONT};
use super::plot::svg::{Pt, SvgElement};
use super::plot::triangle;
use super::plot::triangle::TriangleRow;
use super::series;
use super::series::{PlotSeries, SeriesLine};

/// A log-log plot of errors. The legend is below the frame; slope triangles are in the lower right
/// corner of the frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LogLogPlot {
    /// Title above the frame.
    pub title: String,
    /// Label of the horizontal axis with its unit.
    pub x_label: String,
    /// Label of the vertical axis with its unit.
    pub y_label: String,
    /// Methods with a separate line and name.
    pub series: Vec<PlotSeries>,
    /// Other methods, drawn as thin grey lines without names.
    pub others: Vec<PlotSeries>,
    /// Pareto front (work, error) in ascending order of work, drawn as a broad band behind the
    /// lines.
    pub front: Vec<(f64, f64)>,
    /// Orders of the slope triangles. Orders that are not positive are ignored.
    pub reference_orders: Vec<f64>,
}

/// Fraction of an axis left empty at each end.
const MARGIN: f64 = 0.06;

/// Width of the band of the Pareto front (px).
const BAND: f64 = 11.0;

impl LogLogPlot {
    /// Creates the figure as a standalone SVG document.
    pub fn to_svg(&self) -> String {
        self.to_svg_among(std::slice::from_ref(self))
    }

    /// Creates the figure as SVG. The axes are long enough for all data of `figures`, which must
    /// include this figure.
    pub(crate) fn to_svg_among(&self, figures: &[Self]) -> String {
        let plot = self.plot(figures);
        let lines = self.lines();
        let triangles = self.triangles(&lines, &plot);
        let mut layers = vec![self.band(&plot), triangles.draw(&plot)];
        layers.extend(lines.iter().map(|line| line.draw(&plot)));
        layers.extend(series::failures(&lines).iter().map(|failure| failure.draw(&plot)));
        if lines.iter().all(|line| line.count() == 0) {
            layers.push(plot.placeholder("no data"));
        }
        let mut notes = self.omissions(&lines);
        let without_place = triangles.left_out().map(triangle::name);
        notes.extend(
            without_place.map(|slope| format!("No place for the slope triangle of order {slope}.")),
        );
        plot.document(&layers, &Legend::new(self.entries(&lines)), &notes)
    }

    fn lines(&self) -> Vec<SeriesLine<'_>> {
        let named = self.series.iter().map(SeriesLine::new);
        self.others.iter().map(SeriesLine::in_grey).chain(named).collect()
    }

    /// Creates the frame with axes that contain all data of `figures`. A strip below the data
    /// remains empty if slope triangles need it.
    fn plot(&self, figures: &[Self]) -> Plot<'_> {
        let all: Vec<Vec<SeriesLine>> = figures.iter().map(Self::lines).collect();
        let lines = || all.iter().flatten();
        let heads = all.iter().map(|lines| series::headroom(&series::failures(lines)));
        let head = MARGIN + heads.fold(0.0, f64::max);
        let titles = Titles { title: &self.title, x_label: &self.x_label, y_label: &self.y_label };
        let frame = |foot: f64| {
            let x = Scale::log(lines().flat_map(SeriesLine::xs), Pad { lo: MARGIN, hi: MARGIN });
            let y = Scale::log(lines().flat_map(SeriesLine::errors), Pad { lo: foot, hi: head });
            Plot::new(titles, x, y)
        };
        let draft = frame(MARGIN);
        let strip = |(figure, lines): (&Self, &Vec<SeriesLine>)| {
            let paths: Vec<Vec<Pt>> = lines.iter().map(|line| line.path(&draft)).collect();
            figure.triangles(lines, &draft).strip(&draft, &paths, Pad { lo: MARGIN, hi: head })
        };
        let foot = figures.iter().zip(&all).map(strip).fold(MARGIN, f64::max);
        if foot > MARGIN { frame(foot) } else { draft }
    }

    fn triangles(&self, lines: &[SeriesLine], plot: &Plot) -> TriangleRow {
        let positive = |order: &f64| order.is_finite() && *order > 0.0;
        let has_data = lines.iter().any(|line| line.count() > 0);
        let orders =
            self.reference_orders.iter().copied().filter(|order| has_data && positive(order));
        TriangleRow::new(&orders.collect::<Vec<_>>(), plot)
    }

    fn band(&self, plot: &Plot) -> SvgElement {
        let has_place =
            |point: &&Pt| [point.0, point.1].iter().all(|value| value.is_finite() && *value > 0.0);
        let mut points: Vec<Pt> =
            self.front.iter().filter(has_place).map(|point| plot.place(*point)).collect();
        // A single point is drawn as a line of zero length, whose round ends are visible.
        if let [only] = points[..] {
            points.push(only);
        }
        if points.is_empty() { SvgElement::new("g") } else { band(&points) }
    }

    fn entries(&self, lines: &[SeriesLine]) -> Vec<LegendEntry> {
        let mut entries = series::names(lines);
        if !self.front.is_empty() {
            entries.push(LegendEntry::new(band(&[(3.0, 0.0), (KEY - 3.0, 0.0)]), "Pareto front"));
        }
        if !self.others.is_empty() {
            let line = SvgElement::line((0.0, 0.0), (KEY, 0.0)).set("stroke", CONTEXT);
            let count = self.others.len();
            let text = if count == 1 { "1 other method".into() } else { format!("{count} others") };
            entries.push(LegendEntry::new(line.at("stroke-width", 1.2), &text));
        }
        entries.extend(series::marks(lines));
        entries
    }

    /// Returns notes about points that cannot be drawn on logarithmic axes.
    fn omissions(&self, lines: &[SeriesLine]) -> Vec<String> {
        let points = self.series.iter().chain(&self.others).map(|one| one.points.len());
        let count = points.sum::<usize>() - lines.iter().map(SeriesLine::count).sum::<usize>();
        let points = if count == 1 { "point" } else { "points" };
        let note = format!(
            "Not drawn on logarithmic axes: {count} {points} (a coordinate is not positive)."
        );
        (count > 0).then_some(note).into_iter().collect()
    }
}

fn band(points: &[Pt]) -> SvgElement {
    SvgElement::through("polyline", points)
        .set("fill", "none")
        .set("stroke", FRONT)
        .at("stroke-width", BAND)
        .set("stroke-linecap", "round")
        .set("stroke-linejoin", "round")
}

//! The convergence plot: error against cell size, both axes logarithmic.

use super::plot::frame::{Plot, Titles};
use super::plot::legend::{Legend, PlacedLegend};
use super::plot::scale::{Pad, Scale};
use super::plot::space::{Rect, Space};
use super::plot::svg::{Pt, SvgElement};
use super::plot::triangle;
use super::plot::triangle::Triangle;
use super::series;
use super::series::{FailedLevel, PlotSeries, SeriesLine};

/// A log-log plot of errors against the cell size.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvergencePlot {
    /// Title above the frame.
    pub title: String,
    /// Label of the horizontal axis with its unit.
    pub x_label: String,
    /// Label of the vertical axis with its unit.
    pub y_label: String,
    /// One line each.
    pub series: Vec<PlotSeries>,
    /// Orders shown as slope triangles; an order which is not positive is left out.
    pub reference_orders: Vec<f64>,
}

/// The series of one figure and the levels among them that failed.
struct PlottedLines<'a> {
    lines: Vec<SeriesLine<'a>>,
    failures: Vec<FailedLevel>,
}

impl<'a> PlottedLines<'a> {
    fn new(figure: &'a ConvergencePlot) -> Self {
        let lines: Vec<_> = figure.series.iter().map(SeriesLine::new).collect();
        let failures = series::failures(&lines);
        Self { lines, failures }
    }

    /// Everything which legend and triangles must keep clear of.
    fn paths(&self, plot: &Plot) -> Vec<Vec<Pt>> {
        let lines = self.lines.iter().map(|line| line.path(plot).iter().map(|p| p.0).collect());
        let failures = self.failures.iter().map(|failure| {
            let at = failure.place(plot);
            vec![(at.0, plot.frame.y), at]
        });
        lines.chain(failures).filter(|path: &Vec<Pt>| !path.is_empty()).collect()
    }
}

/// Where legend and slope triangles have found their places.
struct Arrangement {
    legend: Option<PlacedLegend>,
    triangles: Vec<Option<Triangle>>,
}

impl ConvergencePlot {
    /// The figure as a standalone SVG document.
    pub fn to_svg(&self) -> String {
        self.to_svg_among(std::slice::from_ref(self))
    }

    /// The figure with the axes that hold all of `figures`, itself among them.
    pub(crate) fn to_svg_among(&self, figures: &[Self]) -> String {
        let plotted: Vec<_> = figures.iter().map(PlottedLines::new).collect();
        let own = PlottedLines::new(self);
        let plot = self.plot(&plotted);
        let paths: Vec<Vec<Pt>> = own.paths(&plot);
        let PlottedLines { lines, failures } = own;
        let mut entries = series::names(&lines);
        entries.extend(series::marks(&lines));
        let legend = Legend::new(entries);
        let orders = self.orders();
        let arrangement = arrange(&plot, &paths, legend.as_ref(), &orders);

        let triangles = &arrangement.triangles;
        let mut layers: Vec<SvgElement> = triangles.iter().flatten().map(Triangle::draw).collect();
        layers.extend(lines.iter().map(|line| line.draw(&plot)));
        layers.extend(failures.iter().map(|failure| failure.draw(&plot)));
        if lines.iter().all(|line| line.count() == 0) {
            layers.push(plot.placeholder("no data"));
        }
        if let (Some(legend), Some(placed)) = (&legend, &arrangement.legend) {
            layers.push(legend.draw(placed));
        }

        let mut notes = Vec::new();
        let drawn: usize = lines.iter().map(SeriesLine::count).sum();
        let given: usize = self.series.iter().map(|series| series.points.len()).sum();
        if drawn < given {
            notes.push(omission(given - drawn));
        }
        for (&order, _) in orders.iter().zip(triangles).filter(|(_, found)| found.is_none()) {
            let slope = triangle::name(order);
            notes.push(format!("No place for the slope triangle of order {slope}."));
        }
        plot.document(&layers, arrangement.legend.map(|placed| placed.area), &notes)
    }

    fn orders(&self) -> Vec<f64> {
        let positive = |order: &f64| order.is_finite() && *order > 0.0;
        self.reference_orders.iter().copied().filter(positive).collect()
    }

    fn plot(&self, all: &[PlottedLines]) -> Plot<'_> {
        let lines = || all.iter().flat_map(|one| &one.lines);
        let head = all.iter().map(|one| series::headroom(&one.failures)).fold(0.0, f64::max);
        let x = Scale::log(lines().flat_map(SeriesLine::sizes), Pad { lo: 0.06, hi: 0.06 });
        let y = Scale::log(lines().flat_map(SeriesLine::errors), Pad { lo: 0.06, hi: 0.06 + head });
        let titles = Titles { title: &self.title, x_label: &self.x_label, y_label: &self.y_label };
        Plot::new(titles, x, y)
    }
}

fn omission(count: usize) -> String {
    let points = if count == 1 { "point" } else { "points" };
    format!(
        "Without a place on logarithmic axes: {count} {points} (error zero or negative, or h not \
         positive)."
    )
}

/// The first place of the legend beside which as many triangles fit as would without it; a place
/// outside the frame always does.
fn arrange(plot: &Plot, paths: &[Vec<Pt>], legend: Option<&Legend>, orders: &[f64]) -> Arrangement {
    // Beside no data a slope has nothing to be compared with.
    let orders = if paths.is_empty() { &[] } else { orders };
    let space = Space::new(plot.frame, paths);
    let beside = |legend: Option<PlacedLegend>| {
        let mut taken: Vec<Rect> = legend.iter().map(|placed| placed.area).collect();
        let place = |&order: &f64| {
            let triangle = triangle::place(order, plot, &space, &taken);
            taken.extend(triangle.iter().map(|t| t.area));
            triangle
        };
        let triangles = orders.iter().map(place).collect();
        Arrangement { legend, triangles }
    };
    let found = |arrangement: &Arrangement| arrangement.triangles.iter().flatten().count();
    let alone = beside(None);
    let arranged = legend
        .into_iter()
        .flat_map(|legend| legend.places(&plot.frame, &space))
        .map(|placed| beside(Some(placed)))
        .find(|arrangement| found(arrangement) >= found(&alone));
    arranged.unwrap_or(alone)
}

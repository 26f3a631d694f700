//! The work-precision diagram: error against work, both axes logarithmic.

use super::plot::frame::{Plot, Titles};
use super::plot::legend::{KEY, Legend, LegendEntry};
use super::plot::scale::{Pad, Scale};
use super::plot::space::Space;
use super::plot::style::{CONTEXT, FRONT};
use super::plot::svg::{Pt, SvgElement};
use super::series;
use super::series::{FailedLevel, PlotSeries, SeriesLine};
use crate::report::page::dark_theme::with_dark_colours;

/// A log-log plot of errors against the work that they take; `h` of the points is the work.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkPrecision {
    /// Title above the frame.
    pub title: String,
    /// Label of the horizontal axis with its unit.
    pub x_label: String,
    /// Label of the vertical axis with its unit.
    pub y_label: String,
    /// One line each.
    pub series: Vec<PlotSeries>,
    /// Further methods, as thin grey lines without names.
    pub others: Vec<PlotSeries>,
    /// Pareto front (work, error) from the least work on: a broad band below the lines.
    pub front: Vec<(f64, f64)>,
}

/// Width of the band.
const BAND: f64 = 11.0;

impl WorkPrecision {
    /// The figure as a standalone SVG document, in dark colours where the reader prefers them.
    pub fn to_svg(&self) -> String {
        let named = self.series.iter().map(SeriesLine::new);
        let lines: Vec<SeriesLine> =
            self.others.iter().map(SeriesLine::in_grey).chain(named).collect();
        let failures = series::failures(&lines);
        let plot = self.plot(&lines, &failures);
        let paths = paths(&plot, &lines, &failures);

        let mut layers = vec![self.band(&plot)];
        layers.extend(lines.iter().map(|line| line.draw(&plot)));
        layers.extend(failures.iter().map(|failure| failure.draw(&plot)));
        if paths.is_empty() {
            layers.push(plot.placeholder("no data"));
        }
        let legend = Legend::new(self.entries(&lines[self.others.len()..], &lines));
        let space = Space::new(plot.frame, &paths);
        let placed = legend.as_ref().and_then(|legend| legend.places(&plot.frame, &space).next());
        if let (Some(legend), Some(placed)) = (&legend, &placed) {
            layers.push(legend.draw(placed));
        }
        let given = self.series.iter().chain(&self.others).map(|one| one.points.len());
        let missing = given.sum::<usize>() - lines.iter().map(SeriesLine::count).sum::<usize>();
        let note = format!("Without a place on logarithmic axes: {missing}.");
        let notes: Vec<String> = (missing > 0).then_some(note).into_iter().collect();
        with_dark_colours(&plot.document(&layers, placed.map(|placed| placed.area), &notes))
    }

    fn plot(&self, lines: &[SeriesLine], failures: &[FailedLevel]) -> Plot<'_> {
        let x = Scale::log(lines.iter().flat_map(SeriesLine::sizes), Pad { lo: 0.06, hi: 0.06 });
        let head = 0.06 + series::headroom(failures);
        let y = Scale::log(lines.iter().flat_map(SeriesLine::errors), Pad { lo: 0.06, hi: head });
        let titles = Titles { title: &self.title, x_label: &self.x_label, y_label: &self.y_label };
        Plot::new(titles, x, y)
    }

    fn band(&self, plot: &Plot) -> SvgElement {
        let has_place = |(work, error): &&Pt| {
            [work, error].iter().all(|value| value.is_finite() && **value > 0.0)
        };
        let mut points: Vec<Pt> =
            self.front.iter().filter(has_place).map(|point| plot.place(*point)).collect();
        // A line of no length has round ends, and is seen.
        if let [only] = points[..] {
            points.push(only);
        }
        if points.is_empty() {
            return SvgElement::new("g");
        }
        band(&points)
    }

    /// The named lines, the front, the others, and the marks that occur.
    fn entries(&self, named: &[SeriesLine], lines: &[SeriesLine]) -> Vec<LegendEntry> {
        let mut entries = series::names(named);
        if !self.front.is_empty() {
            entries.push(LegendEntry::new(band(&[(3.0, 0.0), (KEY - 3.0, 0.0)]), "Pareto front"));
        }
        if !self.others.is_empty() {
            let line = SvgElement::line((0.0, 0.0), (KEY, 0.0)).set("stroke", CONTEXT);
            let count = self.others.len();
            let text = if count == 1 { "1 other method".into() } else { format!("{count} others") };
            entries.push(LegendEntry::new(line.at("stroke-width", 1.2), &text));
        }
        entries.extend(series::marks(named));
        if lines.iter().any(SeriesLine::has_failed) && !named.iter().any(SeriesLine::has_failed) {
            entries.push(series::failed_entry());
        }
        entries
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

/// Everything which the legend must keep clear of.
fn paths(plot: &Plot, lines: &[SeriesLine], failures: &[FailedLevel]) -> Vec<Vec<Pt>> {
    let lines = lines.iter().map(|line| line.path(plot).iter().map(|p| p.0).collect());
    let failures = failures.iter().map(|failure| {
        let at = failure.place(plot);
        vec![(at.0, plot.frame.y), at]
    });
    lines.chain(failures).filter(|path: &Vec<Pt>| !path.is_empty()).collect()
}

//! The log-log plot: errors against cell size, time step or work.

use super::plot::frame::{KEY, Legend, LegendEntry, Plot, Titles};
use super::plot::scale::{Pad, Scale};
use super::plot::style::{CONTEXT, FRONT, NEUTRAL};
use super::plot::svg::{Pt, SvgElement};
use super::series;
use super::series::{PlotSeries, SeriesLine};

/// A log-log plot of errors with a legend below, and a dotted line for each reference order.
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
    /// Pareto front (work, error) in ascending order of work, drawn as a band behind the lines.
    pub front: Vec<(f64, f64)>,
    /// Orders of the reference lines. Orders that are not positive are ignored.
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

    /// Creates the figure as SVG. Its axes fit the data of `figures`, which include this figure.
    pub(crate) fn to_svg_among(&self, figures: &[Self]) -> String {
        let plot = self.plot(figures);
        let lines = self.lines();
        let mut layers = vec![self.band(&plot)];
        layers
            .extend(self.reference_lines().map(|(_, ends)| dotted(&ends.map(|at| plot.place(at)))));
        layers.extend(lines.iter().map(|line| line.draw(&plot)));
        layers.extend(series::failures(&lines).iter().map(|failure| failure.draw(&plot)));
        if lines.iter().all(|line| line.levels.is_empty()) {
            layers.push(plot.placeholder("no data"));
        }
        plot.document(&layers, &Legend::new(self.entries(&lines)), &self.omissions(&lines))
    }

    fn lines(&self) -> Vec<SeriesLine<'_>> {
        let named = self.series.iter().map(SeriesLine::new);
        self.others.iter().map(SeriesLine::in_grey).chain(named).collect()
    }

    /// Creates the frame with axes that contain all data and reference lines of `figures`.
    fn plot(&self, figures: &[Self]) -> Plot<'_> {
        let all: Vec<Vec<SeriesLine>> = figures.iter().map(Self::lines).collect();
        let lines = || all.iter().flatten();
        let heads = all.iter().map(|lines| series::headroom(&series::failures(lines)));
        let head = MARGIN + heads.fold(0.0, f64::max);
        let references = figures.iter().flat_map(Self::reference_lines);
        let references = references.flat_map(|(_, ends)| ends.map(|end| end.1));
        let x = Scale::log(lines().flat_map(SeriesLine::xs), Pad { lo: MARGIN, hi: MARGIN });
        let errors = lines().flat_map(SeriesLine::errors).chain(references);
        let y = Scale::log(errors, Pad { lo: MARGIN, hi: head });
        let titles = Titles { title: &self.title, x_label: &self.x_label, y_label: &self.y_label };
        Plot::new(titles, x, y)
    }

    /// Returns each positive reference order with the ends of a line of this slope, from fine to
    /// coarse. The line begins at half of the smallest error on the coarsest level, and ends at the
    /// finest level or at half of the smallest error.
    pub(super) fn reference_lines(&self) -> impl Iterator<Item = (f64, [Pt; 2])> {
        let points = || self.series.iter().flat_map(|series| &series.points);
        let points = || points().filter(|point| point.is_drawn());
        let least =
            |errors: &mut dyn Iterator<Item = f64>| 0.5 * errors.fold(f64::INFINITY, f64::min);
        let low = points().map(|point| point.x).fold(f64::INFINITY, f64::min);
        let high = points().map(|point| point.x).fold(0.0, f64::max);
        let top = least(&mut points().filter(|point| point.x == high).map(|point| point.error));
        let bottom = least(&mut points().map(|point| point.error));
        let line = move |order: f64| {
            let end = f64::max(bottom, top * libm::pow(low / high, order));
            let x = f64::max(low, high * libm::pow(end / top, 1.0 / order));
            (order, [(x, end), (high, top)])
        };
        let is_line = move |(order, [(x, end), _]): &(f64, [Pt; 2])| {
            *order > 0.0 && low < high && *end > 0.0 && *x < high && top.is_finite()
        };
        self.reference_orders.iter().copied().map(line).filter(is_line)
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
        entries.extend(self.reference_lines().map(|(order, _)| {
            let key = dotted(&[(0.0, 0.0), (KEY, 0.0)]);
            LegendEntry::new(key, &format!("order {}", order_name(order)))
        }));
        if !self.front.is_empty() {
            entries.push(LegendEntry::new(band(&[(3.0, 0.0), (KEY - 3.0, 0.0)]), "Pareto front"));
        }
        if !self.others.is_empty() {
            let line = SvgElement::line((0.0, 0.0), (KEY, 0.0)).stroke(CONTEXT, 1.2);
            let count = self.others.len();
            let text = if count == 1 { "1 other method".into() } else { format!("{count} others") };
            entries.push(LegendEntry::new(line, &text));
        }
        entries.extend(series::marks(lines));
        entries
    }

    fn omissions(&self, lines: &[SeriesLine]) -> Vec<String> {
        let points = self.series.iter().chain(&self.others).map(|one| one.points.len());
        let count =
            points.sum::<usize>() - lines.iter().map(|line| line.levels.len()).sum::<usize>();
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
        .stroke(FRONT, BAND)
        .set("stroke-linecap", "round")
        .set("stroke-linejoin", "round")
}

fn dotted(ends: &[Pt; 2]) -> SvgElement {
    SvgElement::line(ends[0], ends[1]).stroke(NEUTRAL, 1.4).set("stroke-dasharray", "1.4 3")
}

/// Formats an order in the usual notation: thirds as fractions, other values as short decimals.
pub(super) fn order_name(order: f64) -> String {
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

    #[test]
    fn order_names() {
        let names = [2.0, 5.0 / 3.0, 1.67, 0.75, 10.0].map(order_name);
        assert_eq!(names, ["2", "5/3", "5/3", "0.75", "10"]);
    }
}

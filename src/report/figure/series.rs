//! A series of a log-log plot: its points, its line, its failed levels, and its legend entries.

use super::plot::frame::{KEY, LegendEntry, Plot};
use super::plot::marker;
use super::plot::marker::Fill;
use super::plot::style::{CONTEXT, FRAME_HEIGHT, Look, MarkerShape, NEUTRAL, look};
use super::plot::svg::{Pt, SvgElement};

/// Error of a method on one level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlotPoint {
    /// Cell size, time step or work.
    pub x: f64,
    /// The error; drawn as failed if not finite, and mentioned below the figure if zero.
    pub error: f64,
    /// Use of the level by the judge.
    pub mark: Mark,
}

impl PlotPoint {
    /// Whether the point has a position on logarithmic axes.
    pub(super) fn is_drawn(&self) -> bool {
        let positive = |value: f64| value.is_finite() && value > 0.0;
        positive(self.x) && positive(self.error) && self.mark != Mark::Failed
    }

    /// Whether two points differ by at most 2 %, or by 10 % if the level counts for neither.
    fn coincides(&self, other: &Self) -> bool {
        let both = |marks: &[Mark]| [self, other].iter().all(|point| marks.contains(&point.mark));
        let tolerance = if both(&[Mark::Crossing, Mark::Failed]) { 0.1 } else { 0.02 };
        let near = |a: f64, b: f64| (a / b - 1.0).abs() <= tolerance;
        near(self.x, other.x) && (both(&[Mark::Failed]) || near(self.error, other.error))
    }
}

/// Groups methods whose curves coincide, with the curve of the first method of each group.
pub(super) fn coincident<T>(
    methods: impl Iterator<Item = (T, PlotSeries)>,
) -> Vec<(Vec<T>, PlotSeries)> {
    let mut groups: Vec<(Vec<T>, PlotSeries)> = Vec::new();
    for (method, series) in methods {
        let coincides = |(_, known): &&mut (Vec<T>, PlotSeries)| {
            let mut pairs = known.points.iter().zip(&series.points);
            known.points.len() == series.points.len() && pairs.all(|(a, b)| a.coincides(b))
        };
        match groups.iter_mut().find(coincides) {
            Some((methods, _)) => methods.push(method),
            None => groups.push((vec![method], series)),
        }
    }
    groups
}

/// Use of a level by the judge, and its marker in a plot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// The level is in the asymptotic window: filled marker, solid line.
    Window,
    /// The level is measured but not judged: drawn as in the window, without a legend entry.
    Measured,
    /// The level is outside the window: hollow marker, thin dashed line.
    OutsideWindow,
    /// Particles change their cell on the level: hollow marker with a cross.
    Crossing,
    /// The level has no finite error: arrow at the upper edge of the frame.
    Failed,
}

/// Errors of one method over all levels.
#[derive(Clone, Debug, PartialEq)]
pub struct PlotSeries {
    /// Name in the legend.
    pub name: String,
    /// Index of the colour and marker, which are the same for a method in all figures of a suite.
    pub look: usize,
    /// The levels of the method, in any order.
    pub points: Vec<PlotPoint>,
}

/// Returns the levels that can be drawn, in ascending order of `x`. Those without an error have the
/// mark [`Mark::Failed`].
fn levels(points: &[PlotPoint]) -> Vec<PlotPoint> {
    let level = |&PlotPoint { x, error, mark }: &PlotPoint| {
        let failed = mark == Mark::Failed || !error.is_finite();
        let drawable = x.is_finite() && x > 0.0 && (failed || error > 0.0);
        let mark = if failed { Mark::Failed } else { mark };
        drawable.then_some(PlotPoint { x, error, mark })
    };
    let mut levels: Vec<PlotPoint> = points.iter().filter_map(level).collect();
    levels.sort_by(|a, b| a.x.total_cmp(&b.x));
    levels
}

pub(super) struct SeriesLine<'a> {
    name: &'a str,
    look: Look,
    grey: bool,
    pub(super) levels: Vec<PlotPoint>,
}

impl<'a> SeriesLine<'a> {
    pub(super) fn new(series: &'a PlotSeries) -> Self {
        let look = look(series.look);
        Self { name: &series.name, look, grey: false, levels: levels(&series.points) }
    }

    /// Creates a series for comparison: a thin line without markers.
    pub(super) fn in_grey(series: &'a PlotSeries) -> Self {
        let look = Look { colour: CONTEXT, ..look(0) };
        Self { name: &series.name, look, grey: true, levels: levels(&series.points) }
    }

    pub(super) fn xs(&self) -> impl Iterator<Item = f64> {
        self.levels.iter().map(|level| level.x)
    }

    pub(super) fn errors(&self) -> impl Iterator<Item = f64> {
        self.levels.iter().filter(|level| level.mark != Mark::Failed).map(|level| level.error)
    }

    fn marked_path(&self, plot: &Plot) -> Vec<(Pt, Mark)> {
        let drawn = self.levels.iter().filter(|level| level.mark != Mark::Failed);
        drawn.map(|level| (plot.place((level.x, level.error)), level.mark)).collect()
    }

    pub(super) fn draw(&self, plot: &Plot) -> SvgElement {
        let path = self.marked_path(plot);
        let mut group = SvgElement::new("g");
        group.add(&SvgElement::new("title").content(self.name));
        if self.grey {
            let points: Vec<Pt> = path.iter().map(|(at, _)| *at).collect();
            let line = SvgElement::through("polyline", &points).set("fill", "none");
            group.add(&line.stroke(self.look.colour, 1.2));
            return group;
        }
        for ends in path.windows(2) {
            let line = SvgElement::line(ends[0].0, ends[1].0).set("stroke", self.look.colour);
            let solid = ends.iter().all(|end| matches!(end.1, Mark::Window | Mark::Measured));
            group.add(&if solid {
                line.at("stroke-width", 1.6)
            } else {
                line.at("stroke-width", 0.9).set("stroke-dasharray", self.look.dash)
            });
        }
        for &(at, mark) in &path {
            group.add(&marker::draw(self.look.shape, fill(mark), self.look.colour, at));
        }
        group
    }

    fn entry(&self) -> LegendEntry {
        let Look { colour, shape, .. } = self.look;
        let line = SvgElement::line((0.0, 0.0), (KEY, 0.0)).stroke(colour, 1.6);
        let marker = marker::draw(shape, Fill::Solid, colour, (KEY / 2.0, 0.0));
        let note = if self.levels.is_empty() { " (no data)" } else { "" };
        LegendEntry::new(SvgElement::group(&[line, marker]), &format!("{}{note}", self.name))
    }
}

const MARKS: [(Mark, &str); 4] = [
    (Mark::Window, "in the asymptotic window"),
    (Mark::OutsideWindow, "outside the window"),
    (Mark::Crossing, "particles changed cell"),
    (Mark::Failed, "failed or not finite"),
];

pub(super) fn names(lines: &[SeriesLine]) -> Vec<LegendEntry> {
    lines.iter().filter(|line| !line.grey).map(SeriesLine::entry).collect()
}

/// Returns the legend entries of the marks that occur, for unnamed series only failures.
pub(super) fn marks(lines: &[SeriesLine]) -> Vec<LegendEntry> {
    let occurs = |mark| {
        let drawn = lines.iter().filter(|line| !line.grey || mark == Mark::Failed);
        drawn.flat_map(|line| &line.levels).any(|level| level.mark == mark)
    };
    let marks = MARKS.iter().filter(|(mark, _)| occurs(*mark));
    marks.map(|&(mark, text)| LegendEntry::new(key(mark), text)).collect()
}

fn key(mark: Mark) -> SvgElement {
    let (x, y) = (KEY / 2.0, 0.0);
    if mark != Mark::Failed {
        return marker::draw(MarkerShape::Circle, fill(mark), NEUTRAL, (x, y));
    }
    let arrow = marker::arrow_up((x + 7.0, y + 5.0), (x + 7.0, y - 6.0), NEUTRAL);
    let circle = marker::draw(MarkerShape::Circle, Fill::Hollow, NEUTRAL, (x - 5.0, y));
    SvgElement::group(&[arrow, circle])
}

fn fill(mark: Mark) -> Fill {
    match mark {
        Mark::Window | Mark::Measured => Fill::Solid,
        Mark::OutsideWindow | Mark::Failed => Fill::Hollow,
        Mark::Crossing => Fill::Crossed,
    }
}

/// A failed level with its position in the column of failures at the same `x`.
pub(super) struct FailedLevel {
    x: f64,
    look: Look,
    /// Number of failures of other series above this one, at the same `x`.
    rank: usize,
}

/// Height of the arrow above failed levels, and of each marker below it (px).
const ARROW: f64 = 13.0;
const FAILED_ROW: f64 = 13.0;

/// Maximum fraction of the frame height that is reserved for failed levels.
const LARGEST_HEAD: f64 = 0.4;

/// Returns the failed levels. If several series fail at the same `x`, their markers form a column.
pub(super) fn failures(lines: &[SeriesLine]) -> Vec<FailedLevel> {
    let mut failures: Vec<FailedLevel> = Vec::new();
    for line in lines {
        for level in line.levels.iter().filter(|l| l.mark == Mark::Failed) {
            let same = |f: &&FailedLevel| (f.x / level.x - 1.0).abs() < 0.02;
            let rank = failures.iter().filter(same).count();
            failures.push(FailedLevel { x: level.x, look: line.look, rank });
        }
    }
    failures
}

/// Returns the fraction of the frame height that is reserved above the errors for failed levels.
pub(super) fn headroom(failures: &[FailedLevel]) -> f64 {
    let rows = failures.iter().map(|failure| failure.rank + 1).max();
    rows.map_or(0.0, |rows| (ARROW + FAILED_ROW * rows as f64) / FRAME_HEIGHT).min(LARGEST_HEAD)
}

impl FailedLevel {
    pub(super) fn draw(&self, plot: &Plot) -> SvgElement {
        let top = plot.frame.y;
        let below = ARROW + 7.0 + FAILED_ROW * self.rank as f64;
        let at = (plot.place_x(self.x), top + below.min(plot.frame.h));
        let Look { colour, shape, .. } = self.look;
        let mut group = SvgElement::new("g");
        if self.rank == 0 {
            group.add(&marker::arrow_up((at.0, top + ARROW), (at.0, top + 1.5), NEUTRAL));
        }
        group.add(&marker::draw(shape, Fill::Hollow, colour, at));
        group
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case((0.1, 0.5, Mark::Window), Some((Some(0.5), Mark::Window)))]
    #[case((0.1, f64::NAN, Mark::Window), Some((None, Mark::Failed)))]
    #[case((0.1, f64::INFINITY, Mark::OutsideWindow), Some((None, Mark::Failed)))]
    #[case((0.1, 0.5, Mark::Failed), Some((None, Mark::Failed)))]
    #[case((0.1, 0.0, Mark::Window), None)]
    #[case((0.1, -0.5, Mark::Window), None)]
    #[case((0.0, 0.5, Mark::Window), None)]
    #[case((f64::NAN, 0.5, Mark::Failed), None)]
    fn points_without_a_place_are_dropped(
        #[case] (x, error, mark): (f64, f64, Mark),
        #[case] drawn: Option<(Option<f64>, Mark)>,
    ) {
        let levels = levels(&[PlotPoint { x, error, mark }]);
        let error = |level: &PlotPoint| (level.mark != Mark::Failed).then_some(level.error);
        assert_eq!(levels.first().map(|level| (error(level), level.mark)), drawn);
    }

    /// Levels that count for no case may differ by 10 %, and others by 2 %.
    #[rstest]
    #[case(Mark::Window, 1.0, 0.981, true)]
    #[case(Mark::Window, 1.0, 0.980, false)]
    #[case(Mark::Window, 0.981, 1.0, true)]
    #[case(Mark::Window, 0.980, 1.0, false)]
    #[case(Mark::Crossing, 1.0, 0.91, true)]
    #[case(Mark::Crossing, 1.0, 0.90, false)]
    #[case(Mark::Failed, 1.0, f64::NAN, true)]
    #[case(Mark::Failed, 0.90, f64::NAN, false)]
    fn near_curves_coincide(
        #[case] mark: Mark,
        #[case] x: f64,
        #[case] error: f64,
        #[case] expected: bool,
    ) {
        let series = |scale: (f64, f64)| {
            let points = vec![PlotPoint { x: 1e-6 * scale.0, error: 1e6 * scale.1, mark }];
            PlotSeries { name: String::new(), look: 0, points }
        };
        let groups = coincident([(0, series((1.0, 1.0))), (1, series((x, error)))].into_iter());
        assert_eq!(groups.len() == 1, expected);
    }
}

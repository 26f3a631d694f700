//! A series of the convergence plot: its line, its failed levels, and what the legend says.

use super::levels::{Mark, PlotLevel, PlotPoint, levels};
use super::plot::frame::Plot;
use super::plot::legend::{KEY, LegendEntry};
use super::plot::marker;
use super::plot::marker::Fill;
use super::plot::style::{CONTEXT, HEIGHT, Look, MarkerShape, NEUTRAL, look};
use super::plot::svg::{Pt, SvgElement};

/// The errors of one quantity over all levels.
#[derive(Clone, Debug, PartialEq)]
pub struct PlotSeries {
    /// Name in the legend.
    pub name: String,
    /// Number of its colour and marker: the same for a method in all figures of a suite.
    pub look: usize,
    /// The levels in any order.
    pub points: Vec<PlotPoint>,
}

/// Every mark with its key in the legend, in the order of the legend.
const MARKS: [(Mark, &str); 4] = [
    (Mark::Window, "in the asymptotic window"),
    (Mark::OutsideWindow, "outside the window"),
    (Mark::Crossing, "particles changed cell"),
    (Mark::Failed, "failed or not finite"),
];

/// A series with its appearance.
pub(super) struct SeriesLine<'a> {
    name: &'a str,
    look: Look,
    grey: bool,
    levels: Vec<PlotLevel>,
}

/// A failed level with its place below the upper edge.
pub(super) struct FailedLevel {
    h: f64,
    look: Look,
    /// Number of failures of other series above it at the same cell size.
    rank: usize,
}

/// Height of the arrow and of each failed marker below it.
const ARROW: f64 = 13.0;
const FAILED_ROW: f64 = 13.0;

/// Largest part of the frame which failed levels take from the others.
const LARGEST_HEAD: f64 = 0.4;

/// The failed levels; those of different series at the same cell size stand in a column.
pub(super) fn failures(lines: &[SeriesLine]) -> Vec<FailedLevel> {
    let mut failures: Vec<FailedLevel> = Vec::new();
    for line in lines {
        for level in line.levels.iter().filter(|l| l.mark == Mark::Failed) {
            let same = |f: &&FailedLevel| (f.h / level.h - 1.0).abs() < 0.02;
            let rank = failures.iter().filter(same).count();
            failures.push(FailedLevel { h: level.h, look: line.look, rank });
        }
    }
    failures
}

/// The part of the frame to be kept free above the errors for failed levels.
pub(super) fn headroom(failures: &[FailedLevel]) -> f64 {
    let rows = failures.iter().map(|failure| failure.rank + 1).max();
    rows.map_or(0.0, |rows| (ARROW + FAILED_ROW * rows as f64) / HEIGHT).min(LARGEST_HEAD)
}

/// The series in the legend.
pub(super) fn names(lines: &[SeriesLine]) -> Vec<LegendEntry> {
    lines.iter().map(SeriesLine::entry).collect()
}

/// The marks in the legend: each which occurs.
pub(super) fn marks<'a>(lines: impl IntoIterator<Item = &'a SeriesLine<'a>>) -> Vec<LegendEntry> {
    let levels: Vec<&PlotLevel> = lines.into_iter().flat_map(|line| &line.levels).collect();
    let occurs = |mark| levels.iter().any(|level| level.mark == mark);
    let marks = MARKS.iter().filter(|(mark, _)| occurs(*mark));
    marks.map(|&(mark, text)| LegendEntry::new(key(mark), text)).collect()
}

/// The key of failed levels, where no named series has any.
pub(super) fn failed_entry() -> LegendEntry {
    LegendEntry::new(key(Mark::Failed), MARKS[3].1)
}

fn key(mark: Mark) -> SvgElement {
    let at = (KEY / 2.0, 0.0);
    match mark {
        Mark::Failed => {
            let mut failed = SvgElement::new("g");
            failed.add(&marker::arrow_up((at.0 + 7.0, 5.0), (at.0 + 7.0, -6.0), NEUTRAL));
            failed.add(&marker::draw(
                MarkerShape::Circle,
                Fill::Hollow,
                NEUTRAL,
                (at.0 - 5.0, 0.0),
            ));
            failed
        }
        _ => marker::draw(MarkerShape::Circle, fill(mark), NEUTRAL, at),
    }
}

fn fill(mark: Mark) -> Fill {
    match mark {
        Mark::Window | Mark::Measured => Fill::Solid,
        Mark::OutsideWindow | Mark::Failed => Fill::Hollow,
        Mark::Crossing => Fill::Crossed,
    }
}

impl<'a> SeriesLine<'a> {
    /// A series in its colour.
    pub(super) fn new(series: &'a PlotSeries) -> Self {
        let look = look(series.look);
        Self { name: &series.name, look, grey: false, levels: levels(&series.points) }
    }

    /// A series that is there for comparison: a thin line without markers.
    pub(super) fn in_grey(series: &'a PlotSeries) -> Self {
        let look = Look { colour: CONTEXT, ..look(0) };
        Self { name: &series.name, look, grey: true, levels: levels(&series.points) }
    }

    /// Whether a level failed.
    pub(super) fn has_failed(&self) -> bool {
        self.levels.iter().any(|level| level.mark == Mark::Failed)
    }

    /// Number of levels which are drawn.
    pub(super) fn count(&self) -> usize {
        self.levels.len()
    }

    /// All cell sizes.
    pub(super) fn sizes(&self) -> impl Iterator<Item = f64> {
        self.levels.iter().map(|level| level.h)
    }

    /// All errors of levels which have one.
    pub(super) fn errors(&self) -> impl Iterator<Item = f64> {
        self.levels.iter().filter_map(|level| level.error)
    }

    /// The pixels of the errors.
    pub(super) fn path(&self, plot: &Plot) -> Vec<(Pt, Mark)> {
        self.levels
            .iter()
            .filter_map(|l| l.error.map(|error| (plot.place((l.h, error)), l.mark)))
            .collect()
    }

    /// Line and markers; failed levels are drawn apart.
    pub(super) fn draw(&self, plot: &Plot) -> SvgElement {
        let path = self.path(plot);
        let mut group = SvgElement::new("g");
        group.add(&SvgElement::new("title").content(self.name));
        if self.grey {
            let points: Vec<Pt> = path.iter().map(|(at, _)| *at).collect();
            let line = SvgElement::through("polyline", &points).set("fill", "none");
            group.add(&line.set("stroke", self.look.colour).at("stroke-width", 1.2));
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
        let mut key = SvgElement::new("g");
        key.add(
            &SvgElement::line((0.0, 0.0), (KEY, 0.0))
                .set("stroke", self.look.colour)
                .at("stroke-width", 1.6),
        );
        let at = (KEY / 2.0, 0.0);
        key.add(&marker::draw(self.look.shape, Fill::Solid, self.look.colour, at));
        if self.levels.is_empty() {
            LegendEntry::new(key, &format!("{} (no data)", self.name))
        } else {
            LegendEntry::new(key, self.name)
        }
    }
}

impl FailedLevel {
    /// The pixel of the marker.
    pub(super) fn place(&self, plot: &Plot) -> Pt {
        let below = ARROW + 7.0 + FAILED_ROW * self.rank as f64;
        (plot.place_x(self.h), plot.frame.y + below.min(plot.frame.h))
    }

    /// The marker, below an arrow in the first row.
    pub(super) fn draw(&self, plot: &Plot) -> SvgElement {
        let at = self.place(plot);
        let Look { colour, shape, .. } = self.look;
        let mut group = SvgElement::new("g");
        if self.rank == 0 {
            let top = plot.frame.y;
            group.add(&marker::arrow_up((at.0, top + ARROW), (at.0, top + 1.5), NEUTRAL));
        }
        group.add(&marker::draw(shape, Fill::Hollow, colour, at));
        group
    }
}

//! The frame of a figure: title, axes, grid, legend, and the document around them.

use super::canvas::{Heading, canvas, shorten, text_width, wrap};
use super::scale::{Label, Scale};
use super::style::{FRAME_HEIGHT, GRID, INK, NEUTRAL, TEXT, WIDTH};
use super::svg::{Pt, Rect, SvgElement, number};
use super::ticks::{self, Tick};

#[derive(Clone, Copy, Debug)]
pub(crate) struct Titles<'a> {
    pub(crate) title: &'a str,
    pub(crate) x_label: &'a str,
    pub(crate) y_label: &'a str,
}

#[derive(Debug)]
pub(crate) struct Plot<'a> {
    titles: Titles<'a>,
    heading: Heading,
    pub(crate) frame: Rect,
    x: PlotAxis,
    y: PlotAxis,
}

#[derive(Debug)]
struct PlotAxis {
    scale: Scale,
    ticks: Vec<Tick>,
}

impl PlotAxis {
    fn new(scale: Scale, length: f64, extent: impl Fn(&Label) -> f64) -> Self {
        let ticks = ticks::choose(&scale, length, extent);
        Self { scale, ticks }
    }

    fn labels(&self) -> impl Iterator<Item = (f64, &Label)> {
        self.ticks.iter().filter_map(|t| t.label.as_ref().map(|label| (t.at, label)))
    }
}

const NOTE_LEADING: f64 = 16.0;
const NOTE_GAP: f64 = 6.0;
const MARGIN: f64 = 18.0;
/// Height below the frame (px) for tick labels and the axis label.
const FOOT: f64 = 52.0;
/// Minimum width of the vertical axis labels (px), so that most frames have the same width.
const LABELS: f64 = 38.0;
const MAJOR: f64 = 6.0;
const MINOR: f64 = 3.0;

impl<'a> Plot<'a> {
    pub(crate) fn new(titles: Titles<'a>, x: Scale, y: Scale) -> Self {
        let heading = Heading::new(titles.title, WIDTH);
        let y = PlotAxis::new(y, FRAME_HEIGHT, |_| TEXT + 10.0);
        let top = heading.bottom();
        let widest = y.labels().map(|(_, l)| l.width()).fold(LABELS, f64::max);
        let left = MARGIN + 18.0 + widest;
        let room = WIDTH - left - MARGIN;
        let x = PlotAxis::new(x, room, |l| l.width() + 12.0);
        let overhang = x
            .labels()
            .map(|(at, l)| l.width() / 2.0 - (1.0 - at) * room + 6.0)
            .fold(MARGIN, f64::max);
        let frame = Rect { x: left, y: top, w: WIDTH - left - overhang, h: FRAME_HEIGHT };
        Self { titles, heading, frame, x, y }
    }

    pub(crate) fn place(&self, (x, y): Pt) -> Pt {
        (
            self.frame.x + self.x.scale.fraction(x) * self.frame.w,
            self.frame.bottom() - self.y.scale.fraction(y) * self.frame.h,
        )
    }

    pub(crate) fn place_x(&self, x: f64) -> f64 {
        self.frame.x + self.x.scale.fraction(x) * self.frame.w
    }

    pub(crate) fn placeholder(&self, text: &str) -> SvgElement {
        let middle = (self.frame.x + self.frame.w / 2.0, self.frame.y + self.frame.h / 2.0);
        SvgElement::text(middle, "middle", text).set("fill", NEUTRAL)
    }

    /// Creates the document: `layers` over the grid, `legend` and `notes` below the frame.
    pub(crate) fn document(
        &self,
        layers: &[SvgElement],
        legend: &Legend,
        notes: &[String],
    ) -> String {
        let below = self.frame.bottom() + FOOT;
        let notes: Vec<String> =
            notes.iter().flat_map(|note| wrap(note, TEXT, WIDTH - 2.0 * MARGIN, 4)).collect();
        let first_note = below + legend.height() + NOTE_LEADING - 4.0;
        let height = below + legend.height() + NOTE_LEADING * notes.len() as f64;
        let height = if notes.is_empty() { height } else { height + NOTE_GAP };
        let mut svg = canvas(WIDTH, height, self.titles.title);
        svg.add(&self.grid());
        for layer in layers {
            svg.add(layer);
        }
        svg.add(&self.frame_and_ticks());
        svg.add(&self.texts());
        svg.add(&legend.draw(below));
        for (i, note) in notes.iter().enumerate() {
            let at = (MARGIN, first_note + NOTE_LEADING * i as f64);
            svg.add(&SvgElement::text(at, "start", note).set("fill", NEUTRAL));
        }
        svg.render() + "\n"
    }

    fn grid(&self) -> SvgElement {
        let Rect { x, y, .. } = self.frame;
        let mut grid = SvgElement::new("g").stroke(GRID, 0.8);
        for (at, _) in self.x.labels() {
            let x = x + at * self.frame.w;
            grid.add(&SvgElement::line((x, y), (x, self.frame.bottom())));
        }
        for (at, _) in self.y.labels() {
            let y = self.frame.bottom() - at * self.frame.h;
            grid.add(&SvgElement::line((x, y), (self.frame.right(), y)));
        }
        grid
    }

    fn frame_and_ticks(&self) -> SvgElement {
        let Rect { x, y, w, h } = self.frame;
        let (right, bottom) = (self.frame.right(), self.frame.bottom());
        let mut group = SvgElement::new("g").set("fill", "none").stroke(INK, 0.8);
        group.add(&SvgElement::rect(self.frame));
        let length = |tick: &Tick| if tick.label.is_some() { MAJOR } else { MINOR };
        for tick in &self.x.ticks {
            let (x, inwards) = (x + tick.at * w, length(tick));
            group.add(&SvgElement::line((x, bottom), (x, bottom - inwards)));
            group.add(&SvgElement::line((x, y), (x, y + inwards)));
        }
        for tick in &self.y.ticks {
            let (y, inwards) = (bottom - tick.at * h, length(tick));
            group.add(&SvgElement::line((x, y), (x + inwards, y)));
            group.add(&SvgElement::line((right, y), (right - inwards, y)));
        }
        group
    }

    fn texts(&self) -> SvgElement {
        let Rect { x, y, w, h } = self.frame;
        let bottom = self.frame.bottom();
        let mut group = SvgElement::new("g");
        self.heading.draw(&mut group);
        let ticks = || SvgElement::new("g").set("class", "ticks");
        let (mut below, mut beside) = (ticks(), ticks());
        for (at, label) in self.x.labels() {
            below.add(&label.draw((x + at * w, bottom + 18.0), "middle"));
        }
        for (at, label) in self.y.labels() {
            beside.add(&label.draw((x - 7.0, bottom - at * h + 4.0), "end"));
        }
        group.add(&below);
        group.add(&beside);
        let foot = bottom + 40.0;
        let x_label = shorten(self.titles.x_label, TEXT, w);
        group.add(&SvgElement::text((x + w / 2.0, foot), "middle", &x_label));
        let y_label = shorten(self.titles.y_label, TEXT, h + FOOT);
        let turn =
            format!("translate({} {}) rotate(-90)", number(MARGIN + 2.0), number(y + h / 2.0));
        group.add(&SvgElement::text((0.0, 0.0), "middle", &y_label).set("transform", &turn));
        group
    }
}

/// Width (px) of the line-and-marker sample in front of a legend text.
pub(crate) const KEY: f64 = 30.0;

const KEY_GAP: f64 = 7.0;
const LEGEND_ROW: f64 = 17.0;
const COLUMN_GAP: f64 = 16.0;
/// Distance of the legend from the edges of the figure (px).
const LEGEND_MARGIN: f64 = 10.0;
const MAX_COLUMNS: usize = 4;

#[derive(Clone, Debug)]
pub(crate) struct LegendEntry {
    key: SvgElement,
    text: String,
}

impl LegendEntry {
    /// Creates an entry. Its `key` is drawn from (0, 0) to ([`KEY`], 0).
    pub(crate) fn new(key: SvgElement, text: &str) -> Self {
        let text = shorten(text, TEXT, WIDTH - 2.0 * LEGEND_MARGIN - KEY - KEY_GAP);
        Self { key, text }
    }

    fn width(&self) -> f64 {
        KEY + KEY_GAP + text_width(&self.text, TEXT)
    }
}

/// All legend entries, in as many columns as fit into the figure.
#[derive(Clone, Debug)]
pub(crate) struct Legend {
    entries: Vec<LegendEntry>,
    rows: usize,
}

impl Legend {
    pub(crate) fn new(entries: Vec<LegendEntry>) -> Self {
        let rows = |columns: usize| entries.len().div_ceil(columns).max(1);
        let fits = |rows: &usize| legend_width(&entries, *rows) <= WIDTH - 2.0 * LEGEND_MARGIN;
        let rows = (1..=MAX_COLUMNS).rev().map(rows).find(fits).unwrap_or(rows(1));
        Self { entries, rows }
    }

    /// Returns the height (px), including the distance to the element below; zero without entries.
    pub(crate) fn height(&self) -> f64 {
        if self.entries.is_empty() { 0.0 } else { LEGEND_ROW * self.rows as f64 + LEGEND_MARGIN }
    }

    pub(crate) fn draw(&self, top: f64) -> SvgElement {
        let mut group = SvgElement::new("g").set("class", "legend");
        let mut left = (WIDTH - legend_width(&self.entries, self.rows)) / 2.0;
        for column in self.entries.chunks(self.rows) {
            for (i, entry) in column.iter().enumerate() {
                let middle = top + LEGEND_ROW * (i as f64 + 0.5);
                let mut key = SvgElement::group_at((left, middle));
                key.add(&entry.key);
                group.add(&key);
                let at = (left + KEY + KEY_GAP, middle + 4.0);
                group.add(&SvgElement::text(at, "start", &entry.text));
            }
            left += column_width(column) + COLUMN_GAP;
        }
        group
    }
}

/// Returns the width (px) of entries in columns of `rows` each.
fn legend_width(entries: &[LegendEntry], rows: usize) -> f64 {
    let columns = entries.chunks(rows).map(|column| column_width(column) + COLUMN_GAP);
    columns.sum::<f64>() - COLUMN_GAP
}

fn column_width(column: &[LegendEntry]) -> f64 {
    column.iter().map(LegendEntry::width).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case("short", 3, 1)]
    #[case("short", 9, 3)]
    #[case("a name of about thirty letters", 3, 3)]
    #[case(&"long ".repeat(40), 2, 2)]
    #[case("none", 0, 1)]
    fn entries_fill_as_many_columns_as_fit(
        #[case] text: &str,
        #[case] count: usize,
        #[case] rows: usize,
    ) {
        let entries = vec![LegendEntry::new(SvgElement::new("g"), text); count];
        let legend = Legend::new(entries);
        assert_eq!(legend.rows, rows);
        assert!(legend_width(&legend.entries, rows) <= WIDTH - 2.0 * LEGEND_MARGIN);
    }
}

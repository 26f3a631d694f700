//! The frame of a figure: title, axes, grid, and the document around them.

use super::canvas::{Heading, canvas};
use super::label::Label;
use super::legend::Legend;
use super::scale::Scale;
use super::style::{FRAME_HEIGHT, GRID, INK, NEUTRAL, TEXT, WIDTH};
use super::svg::{Pt, Rect, SvgElement, number};
use super::ticks::Tick;
use super::{text, ticks};

/// The texts around a frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Titles<'a> {
    pub(crate) title: &'a str,
    pub(crate) x_label: &'a str,
    pub(crate) y_label: &'a str,
}

/// A frame with two scales.
#[derive(Debug)]
pub(crate) struct Plot<'a> {
    titles: Titles<'a>,
    heading: Heading,
    /// The box that holds the data.
    pub(crate) frame: Rect,
    x: PlotAxis,
    y: PlotAxis,
}

#[derive(Debug)]
struct PlotAxis {
    scale: Scale,
    ticks: Vec<Tick>,
    factor: Option<Label>,
}

impl PlotAxis {
    fn new(scale: Scale, length: f64, extent: impl Fn(&Label) -> f64) -> Self {
        let ticks = ticks::choose(&scale, length, extent);
        Self { scale, ticks, factor: scale.factor() }
    }

    fn labels(&self) -> impl Iterator<Item = (f64, &Label)> {
        self.ticks.iter().filter_map(|t| t.label.as_ref().map(|label| (t.at, label)))
    }
}

const NOTE_LEADING: f64 = 16.0;
const NOTE_GAP: f64 = 6.0;
const MARGIN: f64 = 18.0;
/// Height below the frame for tick labels and the axis label.
const FOOT: f64 = 52.0;
/// Minimum width of the labels of the vertical axis, so that most frames have the same width.
const LABELS: f64 = 38.0;
const MAJOR: f64 = 6.0;
const MINOR: f64 = 3.0;

impl<'a> Plot<'a> {
    /// Lays the frame out so that titles and tick labels have their place around it.
    pub(crate) fn new(titles: Titles<'a>, x: Scale, y: Scale) -> Self {
        let heading = Heading::new(titles.title, WIDTH);
        let y = PlotAxis::new(y, FRAME_HEIGHT, |_| TEXT + 10.0);
        let top = heading.bottom() + if y.factor.is_some() { 14.0 } else { 0.0 };
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

    /// The pixel of a pair of values.
    pub(crate) fn place(&self, (x, y): Pt) -> Pt {
        (
            self.frame.x + self.x.scale.fraction(x) * self.frame.w,
            self.frame.bottom() - self.y.scale.fraction(y) * self.frame.h,
        )
    }

    /// The horizontal pixel of a value.
    pub(crate) fn place_x(&self, x: f64) -> f64 {
        self.frame.x + self.x.scale.fraction(x) * self.frame.w
    }

    /// Pixels per working unit (per decade on logarithmic axes) along both axes.
    pub(crate) fn pace(&self) -> Pt {
        (self.frame.w / self.x.scale.span(), self.frame.h / self.y.scale.span())
    }

    /// A text in the middle of a frame which has nothing else to show.
    pub(crate) fn placeholder(&self, text: &str) -> SvgElement {
        let middle = (self.frame.x + self.frame.w / 2.0, self.frame.y + self.frame.h / 2.0);
        SvgElement::text(middle, "middle", text).set("fill", NEUTRAL)
    }

    /// The complete document: `layers` over the grid, then `legend` and `notes` below the frame.
    pub(crate) fn document(
        &self,
        layers: &[SvgElement],
        legend: &Legend,
        notes: &[String],
    ) -> String {
        let below = self.frame.bottom() + FOOT;
        let notes: Vec<String> =
            notes.iter().flat_map(|note| text::wrap(note, TEXT, WIDTH - 2.0 * MARGIN, 4)).collect();
        let first_note = below + legend.height() + NOTE_LEADING - 4.0;
        let height = below + legend.height() + NOTE_LEADING * notes.len() as f64;
        let height = if notes.is_empty() { height } else { height + NOTE_GAP };
        let mut svg = canvas((WIDTH, height), self.titles.title);
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
        let mut grid = SvgElement::new("g").set("stroke", GRID).at("stroke-width", 0.8);
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
        let mut group =
            SvgElement::new("g").set("fill", "none").set("stroke", INK).at("stroke-width", 0.8);
        group.add(&SvgElement::new("rect").at("x", x).at("y", y).at("width", w).at("height", h));
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
        let (right, bottom) = (self.frame.right(), self.frame.bottom());
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
        let mut room = w;
        if let Some(factor) = &self.x.factor {
            group.add(&factor.draw((right, foot - 2.0), "end"));
            room -= 2.0 * factor.width() + 16.0;
        }
        if let Some(factor) = &self.y.factor {
            group.add(&factor.draw((x, y - 5.0), "start"));
        }
        let x_label = text::shorten(self.titles.x_label, TEXT, room);
        group.add(&SvgElement::text((x + w / 2.0, foot), "middle", &x_label));
        let y_label = text::shorten(self.titles.y_label, TEXT, h + FOOT);
        let turn =
            format!("translate({} {}) rotate(-90)", number(MARGIN + 2.0), number(y + h / 2.0));
        group.add(&SvgElement::text((0.0, 0.0), "middle", &y_label).set("transform", &turn));
        group
    }
}

//! The legend: what it says, and where it hides nothing.

use super::space::{Rect, Space};
use super::style::{GRID, HEIGHT, PAPER, TEXT, WIDTH};
use super::svg::{Pt, SvgElement};
use super::text;

/// Width of the sample of line and marker in front of a text.
pub(crate) const KEY: f64 = 30.0;

/// One line of the legend.
#[derive(Clone, Debug)]
pub(crate) struct LegendEntry {
    key: SvgElement,
    text: String,
}

impl LegendEntry {
    /// An entry whose `key` is drawn from (0, 0) to ([`KEY`], 0).
    pub(crate) fn new(key: SvgElement, text: &str) -> Self {
        let text = text::shorten(text, TEXT, LONGEST);
        Self { key, text }
    }

    fn width(&self) -> f64 {
        KEY + KEY_GAP + text::width(&self.text, TEXT)
    }
}

/// All entries.
#[derive(Clone, Debug)]
pub(crate) struct Legend {
    entries: Vec<LegendEntry>,
}

/// A legend with its place on the canvas.
#[derive(Clone, Debug)]
pub(crate) struct PlacedLegend {
    columns: usize,
    /// The box around the legend.
    pub(crate) area: Rect,
}

const KEY_GAP: f64 = 7.0;
const ROW: f64 = 17.0;
const INNER: f64 = 6.0;
const COLUMN_GAP: f64 = 16.0;
const LONGEST: f64 = 330.0;
/// Distance from the frame.
const INSET: f64 = 10.0;
/// Distance from the data; a marker reaches about six pixels from its centre.
const CLEAR: f64 = 11.0;

impl Legend {
    /// A legend of `entries`; nothing if there are none.
    pub(crate) fn new(entries: Vec<LegendEntry>) -> Option<Self> {
        (!entries.is_empty()).then_some(Self { entries })
    }

    /// Free places inside the frame, the customary ones first, then one outside.
    pub(crate) fn places(&self, frame: &Rect, space: &Space) -> impl Iterator<Item = PlacedLegend> {
        let inside = (1..=2).flat_map(move |columns| {
            let (w, h) = self.size(columns);
            let (dx, dy) = (frame.w - w - 2.0 * INSET, frame.h - h - 2.0 * INSET);
            let place = move |(across, down): Pt| {
                let (x, y) = (frame.x + INSET + across * dx, frame.y + INSET + down * dy);
                PlacedLegend { columns, area: Rect { x, y, w, h } }
            };
            positions().into_iter().filter(move |_| dx >= 0.0 && dy >= 0.0).map(place)
        });
        inside
            .filter(|placed| space.clearance_of(&placed.area) >= CLEAR)
            .chain(std::iter::once_with(|| self.outside(frame)))
    }

    /// Below the frame: at its side it would halve the scale at which the figure is printed.
    fn outside(&self, frame: &Rect) -> PlacedLegend {
        let columns =
            (1..=4).rev().find(|&columns| self.size(columns).0 <= WIDTH - 2.0 * INSET).unwrap_or(1);
        let (w, h) = self.size(columns);
        let x = (frame.x + (frame.w - w) / 2.0).clamp(INSET, (WIDTH - w - INSET).max(INSET));
        let area = Rect { x, y: HEIGHT, w, h };
        PlacedLegend { columns, area }
    }

    fn columns(&self, columns: usize) -> impl Iterator<Item = &[LegendEntry]> {
        self.entries.chunks(self.entries.len().div_ceil(columns))
    }

    fn size(&self, columns: usize) -> Pt {
        let mut size = (2.0 * INNER - COLUMN_GAP, 0.0_f64);
        for column in self.columns(columns) {
            size.0 += width(column) + COLUMN_GAP;
            size.1 = size.1.max(2.0 * INNER + ROW * column.len() as f64);
        }
        size
    }

    /// The legend at its place.
    pub(crate) fn draw(&self, placed: &PlacedLegend) -> SvgElement {
        let Rect { x, y, w, h } = placed.area;
        let mut group = SvgElement::new("g");
        group.add(
            &SvgElement::new("rect")
                .at("x", x)
                .at("y", y)
                .at("width", w)
                .at("height", h)
                .set("fill", PAPER)
                .set("stroke", GRID)
                .at("stroke-width", 0.8),
        );
        let mut left = x + INNER;
        for column in self.columns(placed.columns) {
            for (i, entry) in column.iter().enumerate() {
                let middle = y + INNER + ROW * (i as f64 + 0.5);
                let mut key = SvgElement::group_at((left, middle));
                key.add(&entry.key);
                group.add(&key);
                let at = (left + KEY + KEY_GAP, middle + 4.0);
                group.add(&SvgElement::text(at, "start", &entry.text));
            }
            left += width(column) + COLUMN_GAP;
        }
        group
    }
}

fn width(column: &[LegendEntry]) -> f64 {
    column.iter().map(LegendEntry::width).fold(0.0, f64::max)
}

/// Fractions of the free width and height: corners, then the sides, then the inside.
fn positions() -> Vec<Pt> {
    const STEPS: i32 = 8;
    let rank = |i: i32| i32::from(i != 0 && i != STEPS);
    let mut grid: Vec<(i32, i32)> =
        (0..=STEPS).flat_map(|j| (0..=STEPS).rev().map(move |i| (i, j))).collect();
    grid.sort_by_key(|&(i, j)| rank(i) + rank(j));
    grid.iter()
        .map(|&(i, j)| (f64::from(i) / f64::from(STEPS), f64::from(j) / f64::from(STEPS)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Rect = Rect { x: 60.0, y: 30.0, w: 560.0, h: 350.0 };

    fn legend(text: &str, count: usize) -> Legend {
        Legend::new(vec![LegendEntry::new(SvgElement::new("g"), text); count]).unwrap()
    }

    #[test]
    fn the_corners_come_first() {
        let corners = [(1.0, 0.0), (0.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        assert_eq!(positions()[..4], corners);
    }

    #[test]
    fn a_legend_keeps_away_from_the_data() {
        let line = vec![(60.0, 30.0), (620.0, 380.0)];
        let space = Space::new(FRAME, &[line]);
        let placed = legend("a curve", 3).places(&FRAME, &space).next().unwrap();
        assert!(FRAME.contains(&placed.area));
        assert!(space.clearance_of(&placed.area) >= CLEAR);
    }

    #[test]
    fn a_full_frame_sends_the_legend_below() {
        let lines: Vec<Vec<Pt>> = (0..8)
            .map(|i| 30.0 + 50.0 * f64::from(i))
            .map(|y| vec![(60.0, y), (620.0, y)])
            .collect();
        let space = Space::new(FRAME, &lines);
        for name in ["short", "a name which takes some forty characters"] {
            let placed = legend(name, 3).places(&FRAME, &space).next().unwrap();
            assert!(placed.area.y >= HEIGHT && placed.area.right() <= WIDTH, "{name}");
        }
    }
}

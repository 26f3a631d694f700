//! The legend below the frame of a figure.

use super::style::{TEXT, WIDTH};
use super::svg::SvgElement;
use super::text;

/// Width of the sample of line and marker in front of a text.
pub(crate) const KEY: f64 = 30.0;

const KEY_GAP: f64 = 7.0;
const ROW: f64 = 17.0;
const COLUMN_GAP: f64 = 16.0;
/// Distance from the edges of the figure (px).
const MARGIN: f64 = 10.0;
/// Maximum number of columns.
const MOST_COLUMNS: usize = 4;

/// One line of the legend.
#[derive(Clone, Debug)]
pub(crate) struct LegendEntry {
    key: SvgElement,
    text: String,
}

impl LegendEntry {
    /// An entry whose `key` is drawn from (0, 0) to ([`KEY`], 0).
    pub(crate) fn new(key: SvgElement, text: &str) -> Self {
        let text = text::shorten(text, TEXT, WIDTH - 2.0 * MARGIN - KEY - KEY_GAP);
        Self { key, text }
    }

    fn width(&self) -> f64 {
        KEY + KEY_GAP + text::width(&self.text, TEXT)
    }
}

/// All entries, in as many columns as fit into the width of the figure.
#[derive(Clone, Debug)]
pub(crate) struct Legend {
    entries: Vec<LegendEntry>,
    rows: usize,
}

impl Legend {
    /// A legend of `entries`.
    pub(crate) fn new(entries: Vec<LegendEntry>) -> Self {
        let rows = |columns: usize| entries.len().div_ceil(columns).max(1);
        let fits = |rows: &usize| width(&entries, *rows) <= WIDTH - 2.0 * MARGIN;
        let rows = (1..=MOST_COLUMNS).rev().map(rows).find(fits).unwrap_or(rows(1));
        Self { entries, rows }
    }

    /// Height (px), with the distance from what is below; zero if there are no entries.
    pub(crate) fn height(&self) -> f64 {
        if self.entries.is_empty() { 0.0 } else { ROW * self.rows as f64 + MARGIN }
    }

    /// The legend in the middle of the figure, its upper edge at `top`.
    pub(crate) fn draw(&self, top: f64) -> SvgElement {
        let mut group = SvgElement::new("g").set("class", "legend");
        let mut left = (WIDTH - width(&self.entries, self.rows)) / 2.0;
        for column in self.entries.chunks(self.rows) {
            for (i, entry) in column.iter().enumerate() {
                let middle = top + ROW * (i as f64 + 0.5);
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

/// Width (px) of entries in columns of `rows` each.
fn width(entries: &[LegendEntry], rows: usize) -> f64 {
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
        assert!(width(&legend.entries, rows) <= WIDTH - 2.0 * MARGIN);
    }
}

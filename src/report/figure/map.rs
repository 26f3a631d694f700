//! The map: a table of numbers on coloured fields, with one row for each case.
//!
//! Each field has its number as text; colours are only a guide, which remains distinguishable in
//! grey print. A gap separates rows whose names begin with different words.

use super::plot::canvas::{Heading, canvas, text_width};
use super::plot::style::{INK, NEUTRAL, PAPER, TEXT};
use super::plot::svg::{Rect, SvgElement};
use crate::verify::rounded;

/// A table of numbers on coloured fields.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// Title above the table.
    pub title: String,
    /// Label of the horizontal axis, which lists the columns.
    pub x_label: String,
    /// Name of the quantity that the fields show.
    pub z_label: String,
    /// Heading of each column.
    pub columns: Vec<String>,
    /// Name and fields of each row.
    pub rows: Vec<(String, Vec<MapField>)>,
}

/// One field of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct MapField {
    /// Value that determines the colour; the paper colour for `None` or a value that is not finite.
    pub value: Option<f64>,
    /// Text printed in the field.
    pub text: String,
}

const LEFT: f64 = 14.0;
/// Distance of the axis from the fields, and length of its ticks (px).
const AXIS: f64 = 3.0;
const TICK: f64 = 4.0;
const ROW: f64 = 17.0;
/// Minimum width of a field (px). Longer column names widen the fields.
const FIELD: f64 = 62.0;
/// Gap between rows whose names begin with different words (px).
const GAP: f64 = 5.0;

/// Formats a swept value as a column heading, rounded to five digits.
pub(crate) fn column_head(value: f64) -> String {
    rounded(value, 5).to_string()
}

impl Map {
    /// Creates the figure as a standalone SVG document.
    pub fn to_svg(&self) -> String {
        let names = self.rows.iter().map(|(name, _)| name.as_str());
        let left = LEFT + names.map(|name| text_width(name, TEXT)).fold(0.0, f64::max) + 10.0;
        let field =
            self.columns.iter().map(|name| text_width(name, TEXT) + 8.0).fold(FIELD, f64::max);
        let across = field * self.columns.len() as f64;
        let note = format!("{}: dark is low, light is high", self.z_label);
        let width = (left + across).max(LEFT + text_width(&note, TEXT)) + LEFT;
        let heading = Heading::new(&self.title, width);
        let head = heading.bottom() + 40.0;
        let (places, bottom) = self.places(head);
        let height = bottom + 30.0;
        let mut svg = canvas(width, height, &self.title);
        heading.draw(&mut svg);
        let middle = left + across / 2.0;
        svg.add(&SvgElement::text((middle, head - 28.0), "middle", &self.x_label));
        let line = |from, to| SvgElement::line(from, to).stroke(INK, 0.8);
        svg.add(&line((left, head - AXIS), (left + across, head - AXIS)));
        for (k, column) in self.columns.iter().enumerate() {
            let x = left + field * (k as f64 + 0.5);
            svg.add(&SvgElement::text((x, head - 12.0), "middle", column));
            svg.add(&line((x, head - AXIS), (x, head - AXIS - TICK)));
        }
        let fields = self.rows.iter().flat_map(|(_, fields)| fields);
        let range = ColourRange::new(fields.filter_map(|field| field.value));
        for ((name, fields), y) in self.rows.iter().zip(places) {
            let mut row = SvgElement::new("g");
            row.add(&SvgElement::text((left - 8.0, y + ROW - 4.5), "end", name));
            for (k, MapField { value, text }) in fields.iter().enumerate() {
                let x = left + field * k as f64;
                let known = value.filter(|value| value.is_finite());
                let known = known.map(|value| colour(range.share(value)));
                let (fill, ink) = known.unwrap_or_else(|| (PAPER.to_owned(), NEUTRAL));
                let square = SvgElement::rect(Rect { x, y, w: field, h: ROW });
                row.add(&square.set("fill", &fill).set("stroke", PAPER));
                let middle = (x + field / 2.0, y + ROW - 4.5);
                row.add(&SvgElement::text(middle, "middle", text).set("fill", ink));
            }
            svg.add(&row);
        }
        svg.add(&SvgElement::text((LEFT, bottom + 18.0), "start", &note));
        svg.render() + "\n"
    }

    /// Returns the positions of the rows, starting at `y`, and the position after the last row.
    fn places(&self, mut y: f64) -> (Vec<f64>, f64) {
        let mut places = Vec::new();
        let mut group = None;
        for (name, _) in &self.rows {
            let first = name.split('-').next();
            if group.is_some_and(|known| known != first) {
                y += GAP;
            }
            group = Some(first);
            places.push(y);
            y += ROW;
        }
        (places, y)
    }
}

/// Minimum ratio of the largest to the smallest value for which the colour scale is logarithmic.
const SPAN: f64 = 1e3;

/// Smallest and largest finite value of a map, which have the ends of the colours.
#[derive(Clone, Copy)]
struct ColourRange([f64; 2]);

impl ColourRange {
    fn new(values: impl Iterator<Item = f64>) -> Self {
        let finite = values.filter(|value| value.is_finite());
        Self(finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
            [low.min(value), high.max(value)]
        }))
    }

    /// Returns the position of a value between dark (0) and light (1); 0.5 if all values are equal.
    fn share(self, value: f64) -> f64 {
        let Self([low, high]) = self;
        let is_logarithmic = low > 0.0 && high / low > SPAN;
        let place = |x: f64| if is_logarithmic { libm::log10(x) } else { x };
        let share = (place(value) - place(low)) / (place(high) - place(low));
        if share.is_finite() { share } else { 0.5 }
    }
}

/// Text colours on dark and light fields, which are the same in both themes.
const OVER_DARK: &str = "#fff";
const OVER_LIGHT: &str = "#000";

/// Shades from dark to light (cividis, after Nunez, Anderton & Renslow 2018).
const COLOURS: [[f64; 3]; 6] = [
    [0.0, 32.0, 81.0],
    [60.0, 77.0, 110.0],
    [107.0, 110.0, 119.0],
    [148.0, 143.0, 120.0],
    [202.0, 186.0, 106.0],
    [253.0, 234.0, 69.0],
];

/// Returns the colour at `share` (0 dark, 1 light), and the colour of text on it.
fn colour(share: f64) -> (String, &'static str) {
    let last = COLOURS.len() - 1;
    let place = share.clamp(0.0, 1.0) * last as f64;
    let low = (place as usize).min(last - 1);
    let rest = place - low as f64;
    let mixed: [f64; 3] =
        std::array::from_fn(|k| COLOURS[low][k] * (1.0 - rest) + COLOURS[low + 1][k] * rest);
    let [r, g, b] = mixed.map(|channel| libm::round(channel) as u8);
    (format!("#{r:02x}{g:02x}{b:02x}"), if share < 0.45 { OVER_DARK } else { OVER_LIGHT })
}

/// Merges rows whose names differ in the last word (`flip-usf/musl`). Removes a common first word.
pub(crate) fn merged_fields(rows: Vec<(String, Vec<MapField>)>) -> Vec<(String, Vec<MapField>)> {
    let first =
        |name: &str| name.split_once('-').map_or(String::new(), |(word, _)| word.to_owned());
    let common = rows.first().map(|(name, _)| first(name)).unwrap_or_default();
    let is_common = rows.iter().all(|(name, _)| first(name) == common);
    let mut kept: Vec<(String, Vec<MapField>)> = Vec::new();
    for (name, fields) in rows {
        let name = if is_common { name[common.len()..].trim_start_matches('-') } else { &name };
        let (stem, last) = name.rsplit_once('-').unwrap_or(("", name));
        match kept.last_mut() {
            Some((known, shown))
                if known.rsplit_once('-').map_or("", |(stem, _)| stem) == stem
                    && shown.iter().map(|field| &field.text).eq(fields.iter().map(|f| &f.text)) =>
            {
                *known += &format!("/{last}");
            }
            _ => kept.push((name.to_owned(), fields)),
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(values: &[Option<f64>]) -> String {
        let field = |value: &Option<f64>| MapField { value: *value, text: "x".to_owned() };
        Map {
            title: "Limits".to_owned(),
            x_label: "place".to_owned(),
            z_label: "C".to_owned(),
            columns: values.iter().map(|_| "0".to_owned()).collect(),
            rows: vec![("a & b".to_owned(), values.iter().map(field).collect())],
        }
        .to_svg()
    }

    #[test]
    fn heads_of_columns_are_short() {
        assert_eq!(
            [1.0 / 3.0, 0.4999, 1e-9].map(column_head),
            ["0.33333", "0.4999", "0.000000001"]
        );
    }

    /// Fields are 62 px wide and 17 px high. There is a gap of 5 px between rows whose names begin
    /// differently. Values at fifths of the range have one of the six shades; the value in the
    /// middle has a mixture of two.
    #[test]
    fn each_value_is_in_the_field_of_its_row_and_column() {
        let field = |value: f64| MapField { value: Some(value), text: format!("<{value}") };
        let map = Map {
            title: "Limits".to_owned(),
            x_label: "place".to_owned(),
            z_label: "C".to_owned(),
            columns: ["0.1", "0.2", "0.3"].map(str::to_owned).into(),
            rows: vec![
                ("a-x".to_owned(), [0.5, 2.75, 5.0].map(field).into()),
                ("b-y".to_owned(), [1.4, f64::INFINITY, 4.1].map(field).into()),
            ],
        };
        let svg = map.to_svg();
        let left = 14.0 + (0.63 + 0.4 + 0.63) * 12.0 + 10.0;
        for (row, column, fill, ink) in [
            (0.0, 0.0, "#002051", "#fff"),
            (0.0, 1.0, "#807f78", "#000"),
            (0.0, 2.0, "#fdea45", "#000"),
            (1.0, 0.0, "#3c4d6e", "#fff"),
            (1.0, 1.0, "#ffffff", "#4d4d4d"),
            (1.0, 2.0, "#caba6a", "#000"),
        ] {
            let (x, y) = (left + 62.0 * column, 75.0 + 22.0 * row);
            let value = map.rows[row as usize].1[column as usize].value.expect("a value");
            let expected = format!(
                "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"62.00\" height=\"17.00\" \
                 fill=\"{fill}\" stroke=\"#ffffff\"/>\n<text x=\"{:.2}\" y=\"{:.2}\" \
                 text-anchor=\"middle\" fill=\"{ink}\">&lt;{value}</text>",
                x + 31.0,
                y + 12.5
            );
            assert!(svg.contains(&expected), "{expected}\n{svg}");
        }
        for (text, x, y, anchor) in [
            ("a-x", left - 8.0, 87.5, "end"),
            ("b-y", left - 8.0, 109.5, "end"),
            ("0.3", left + 155.0, 63.0, "middle"),
            ("place", left + 93.0, 47.0, "middle"),
            ("C: dark is low, light is high", 14.0, 132.0, "start"),
        ] {
            let text = format!("<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{anchor}\">{text}</");
            assert!(svg.contains(&text), "{text}\n{svg}");
        }
        let latex = map.to_pgfplots();
        let data: Vec<&str> =
            latex.lines().filter(|line| line.starts_with(['0', '1', '2'])).collect();
        let expected = ["0 0 5e-1", "1 0 2.75e0", "2 0 5e0", "0 1 1.4e0", "1 1 nan", "2 1 4.1e0"];
        assert_eq!(data, expected);
        for words in [
            "title={Limits}, xlabel={place}, ylabel={}, width=6.8cm, height=3.2cm,",
            "colorbar style={ylabel={C}}, xtick={0,...,2}, xticklabels={{0.1}, {0.2}, {0.3}}, \
             ytick={0,...,1}, yticklabels={{a-x}, {b-y}}, xmin=-0.5, xmax=2.5, ymin=-0.5, ymax=1.5]",
            "mesh/cols=3, ",
            "at (axis cs:2,1) {$<$4.1};",
        ] {
            assert!(latex.contains(words), "{words}\n{latex}");
        }
    }

    #[test]
    fn missing_and_non_finite_values_give_no_nan() {
        for values in [&[][..], &[None], &[Some(f64::NAN)], &[Some(f64::INFINITY), Some(1.0)]] {
            let svg = map(values);
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        }
    }
}

//! The map: a table of numbers over coloured fields, a row for each case.
//!
//! Numbers are printed in the fields, so that colours only guide the eye; they run from dark to
//! light in steps of equal lightness and survive grey print. A gap parts rows whose names begin
//! otherwise.

use super::plot::style::{FONT, GRID, INK, NEUTRAL, PAPER, TEXT, TITLE};
use super::plot::svg::{SvgElement, number};
use super::plot::text;

/// A table of numbers over coloured fields.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// Title above the table.
    pub title: String,
    /// Label of the columns.
    pub x_label: String,
    /// Label of the numbers.
    pub z_label: String,
    /// Head of each column.
    pub columns: Vec<String>,
    /// Name and fields of each row.
    pub rows: Vec<(String, Vec<MapField>)>,
}

/// One field.
#[derive(Clone, Debug, PartialEq)]
pub struct MapField {
    /// Value that gives the colour; white for none, or one that is not finite.
    pub value: Option<f64>,
    /// Text printed in it.
    pub text: String,
}

const LEFT: f64 = 14.0;
const TOP: f64 = 18.0;
const ROW: f64 = 17.0;
/// Least width of a field: wider where the name of a column is.
const FIELD: f64 = 62.0;
/// Between rows whose names begin with another word.
const GAP: f64 = 5.0;
/// Height of the bar of colours, with its labels.
const BAR: f64 = 12.0;
const BAR_WIDTH: f64 = 240.0;
/// Steps of the bar.
const SHADES: u32 = 48;

/// Red, green and blue from dark to light (after Nunez, Anderton & Renslow 2018, cividis).
const COLOURS: [[f64; 3]; 6] = [
    [0.0, 32.0, 81.0],
    [60.0, 77.0, 110.0],
    [107.0, 110.0, 119.0],
    [148.0, 143.0, 120.0],
    [202.0, 186.0, 106.0],
    [253.0, 234.0, 69.0],
];

/// The colour at `share` of the way from dark to light, and that of a text over it.
fn colour(share: f64) -> (String, &'static str) {
    let last = COLOURS.len() - 1;
    let place = share.clamp(0.0, 1.0) * last as f64;
    let low = (place as usize).min(last - 1);
    let rest = place - low as f64;
    let mixed: [f64; 3] =
        std::array::from_fn(|k| COLOURS[low][k] * (1.0 - rest) + COLOURS[low + 1][k] * rest);
    let [r, g, b] = mixed.map(|channel| libm::round(channel) as u8);
    (format!("#{r:02x}{g:02x}{b:02x}"), if share < 0.5 { PAPER } else { INK })
}

impl Map {
    /// The figure as a standalone SVG document.
    pub fn to_svg(&self) -> String {
        let names = self.rows.iter().map(|(name, _)| name.as_str());
        let names = names.chain([self.z_label.as_str()]).map(|name| text::width(name, TEXT));
        let left = LEFT + names.fold(0.0, f64::max) + 10.0;
        let field =
            self.columns.iter().map(|name| text::width(name, TEXT) + 8.0).fold(FIELD, f64::max);
        let across = field * self.columns.len() as f64;
        let width = (left + across).max(left + BAR_WIDTH) + LEFT;
        let heading = text::wrap(&self.title, 1.12 * TITLE, width - 2.0 * LEFT, 3);
        let head = TOP + 17.0 * heading.len() as f64 + 34.0;
        let (places, bottom) = self.places(head);
        let height = bottom + 62.0;
        let mut svg = SvgElement::new("svg")
            .set("xmlns", "http://www.w3.org/2000/svg")
            .set("viewBox", &format!("0 0 {} {}", number(width), number(height)))
            .at("width", width)
            .at("height", height)
            .set("role", "img")
            .set("font-family", FONT)
            .at("font-size", TEXT)
            .set("fill", INK);
        svg.add(&SvgElement::new("title").content(&self.title));
        svg.add(
            &SvgElement::new("rect").at("width", width).at("height", height).set("fill", PAPER),
        );
        for (i, line) in heading.iter().enumerate() {
            let at = (width / 2.0, TOP + 4.0 + 17.0 * i as f64);
            let line = SvgElement::text(at, "middle", line).at("font-size", TITLE);
            svg.add(&line.set("font-weight", "bold"));
        }
        let middle = left + across / 2.0;
        svg.add(&SvgElement::text((middle, head - 22.0), "middle", &self.x_label));
        for (k, column) in self.columns.iter().enumerate() {
            let at = (left + field * (k as f64 + 0.5), head - 6.0);
            svg.add(&SvgElement::text(at, "middle", column));
        }
        let range = self.range();
        for ((name, fields), y) in self.rows.iter().zip(places) {
            svg.add(&row(name, fields, (left, y, field), range));
        }
        svg.add(&self.bar((left, bottom + 16.0), range));
        svg.render() + "\n"
    }

    /// Where rows lie that start at `y`, and where they end.
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

    /// The smallest and the largest finite value.
    fn range(&self) -> (f64, f64) {
        let values = self.rows.iter().flat_map(|(_, fields)| fields).filter_map(|f| f.value);
        let finite = values.filter(|value| value.is_finite());
        let (low, high) = finite
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        if low < high { (low, high) } else { (0.0, 1.0) }
    }

    /// The colours with their numbers.
    fn bar(&self, (x, y): (f64, f64), (low, high): (f64, f64)) -> SvgElement {
        let mut group = SvgElement::new("g");
        let step = BAR_WIDTH / f64::from(SHADES);
        for k in 0..SHADES {
            let (fill, _) = colour((f64::from(k) + 0.5) / f64::from(SHADES));
            let at = x + step * f64::from(k);
            let shade = SvgElement::new("rect").at("x", at).at("y", y);
            // Wider than its place, so that no gap shows between neighbours.
            let wide = if k + 1 < SHADES { step + 0.6 } else { step };
            group.add(&shade.at("width", wide).at("height", BAR).set("fill", &fill));
        }
        let labels = [(0.0, "start", low), (0.5, "middle", 0.5 * (low + high)), (1.0, "end", high)];
        for (share, anchor, value) in labels {
            let at = (x + share * BAR_WIDTH, y + BAR + 15.0);
            let digits = if high.abs() < 0.995 { 4 } else { 2 };
            group.add(&SvgElement::text(at, anchor, &format!("{value:.digits$}")));
        }
        group.add(&SvgElement::text((x - 8.0, y + BAR - 2.0), "end", &self.z_label));
        group
    }
}

fn row(
    name: &str,
    fields: &[MapField],
    (x, y, width): (f64, f64, f64),
    (low, high): (f64, f64),
) -> SvgElement {
    let mut group = SvgElement::new("g");
    group.add(&SvgElement::text((x - 8.0, y + ROW - 4.5), "end", name));
    for (k, field) in fields.iter().enumerate() {
        let at = x + width * k as f64;
        let value = field.value.filter(|value| value.is_finite());
        let known = value.map(|value| colour((value - low) / (high - low)));
        let (fill, ink) = known.unwrap_or((PAPER.to_owned(), NEUTRAL));
        let square =
            SvgElement::new("rect").at("x", at).at("y", y).at("width", width).at("height", ROW);
        group.add(&square.set("fill", &fill).set("stroke", GRID).at("stroke-width", 0.5));
        let middle = (at + width / 2.0, y + ROW - 4.5);
        group.add(&SvgElement::text(middle, "middle", &field.text).set("fill", ink));
    }
    group
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
    fn the_ends_of_the_range_have_the_ends_of_the_colours() {
        let svg = map(&[Some(0.5), Some(2.0)]);
        for (fill, ink) in [("#002051", PAPER), ("#fdea45", INK)] {
            assert_eq!(
                (colour(f64::from(u8::from(fill == "#fdea45"))).0.as_str(), true),
                (fill, svg.contains(fill))
            );
            assert_eq!(colour(f64::from(u8::from(fill == "#fdea45"))).1, ink);
        }
        assert!(svg.contains("a &amp; b"));
    }

    #[test]
    fn nothing_and_what_is_not_finite_stay_white() {
        for values in [&[][..], &[None], &[Some(f64::NAN)], &[Some(f64::INFINITY), Some(1.0)]] {
            let svg = map(values);
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        }
    }
}

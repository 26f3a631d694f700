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
/// Positive values that span more have colours by their logarithms.
const SPAN: f64 = 1e3;

/// Colours of values.
#[derive(Debug, Clone, Copy)]
struct ColourScale {
    low: f64,
    high: f64,
    is_logarithmic: bool,
}

impl ColourScale {
    /// The scale from the smallest to the largest finite value.
    fn of(values: impl Iterator<Item = f64>) -> Self {
        let finite = values.filter(|value| value.is_finite());
        let (low, high) = finite
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        let (low, high) = if low < high { (low, high) } else { (0.0, 1.0) };
        Self { low, high, is_logarithmic: low > 0.0 && high / low > SPAN }
    }

    /// The share of the way from dark to light.
    fn share(self, value: f64) -> f64 {
        let [value, low, high] = if self.is_logarithmic {
            [value, self.low, self.high].map(libm::log)
        } else {
            [value, self.low, self.high]
        };
        (value - low) / (high - low)
    }

    /// The values at both ends of the bar and in its middle, as labels.
    fn labels(self) -> [String; 3] {
        let Self { low, high, is_logarithmic } = self;
        let middle = if is_logarithmic { libm::sqrt(low * high) } else { 0.5 * (low + high) };
        [low, middle, high].map(|value| match high.abs() {
            _ if is_logarithmic => format!("{value:.0e}"),
            most if most < 0.995 => format!("{value:.4}"),
            _ => format!("{value:.2}"),
        })
    }
}

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
        let fields = self.rows.iter().flat_map(|(_, fields)| fields);
        let scale = ColourScale::of(fields.filter_map(|field| field.value));
        for ((name, fields), y) in self.rows.iter().zip(places) {
            svg.add(&row(name, fields, (left, y, field), scale));
        }
        svg.add(&self.bar((left, bottom + 16.0), scale));
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

    /// The colours with their numbers.
    fn bar(&self, (x, y): (f64, f64), scale: ColourScale) -> SvgElement {
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
        let places = [(0.0, "start"), (0.5, "middle"), (1.0, "end")];
        for ((share, anchor), label) in places.into_iter().zip(scale.labels()) {
            let at = (x + share * BAR_WIDTH, y + BAR + 15.0);
            group.add(&SvgElement::text(at, anchor, &label));
        }
        group.add(&SvgElement::text((x - 8.0, y + BAR - 2.0), "end", &self.z_label));
        group
    }
}

fn row(
    name: &str,
    fields: &[MapField],
    (x, y, width): (f64, f64, f64),
    scale: ColourScale,
) -> SvgElement {
    let mut group = SvgElement::new("g");
    group.add(&SvgElement::text((x - 8.0, y + ROW - 4.5), "end", name));
    for (k, field) in fields.iter().enumerate() {
        let at = x + width * k as f64;
        let value = field.value.filter(|value| value.is_finite());
        let known = value.map(|value| colour(scale.share(value)));
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
    fn values_over_decades_have_colours_by_their_logarithms() {
        let scale = ColourScale::of([1e-2, 1.0, 1e8, f64::INFINITY].into_iter());
        assert!((scale.share(1e3) - 0.5).abs() <= 1e-12);
        assert_eq!(scale.labels(), ["1e-2", "1e3", "1e8"]);
        let scale = ColourScale::of([0.0, 1e8].into_iter());
        assert_eq!(scale.share(5e7), 0.5);
    }

    #[test]
    fn nothing_and_what_is_not_finite_stay_white() {
        for values in [&[][..], &[None], &[Some(f64::NAN)], &[Some(f64::INFINITY), Some(1.0)]] {
            let svg = map(values);
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        }
    }
}

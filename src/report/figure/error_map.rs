//! Maps of the error in each part of the body, with a panel for each case. All panels have the same
//! length scale and colour scale, so that cases can be compared visually.

use super::colour_scale::{ColourScale, colour};
use super::plot::canvas::{Heading, canvas, shorten, wrap};
use super::plot::style::{GRID, NEUTRAL, TEXT, WIDTH};
use super::plot::svg::SvgElement;
use crate::verify::ErrorField;
use std::collections::BTreeMap;
use std::fmt::Write;

const LEFT: f64 = 14.0;
const GAP: f64 = 16.0;
/// Number of panels per row for plane bodies.
const PLANES: usize = 2;
/// Maximum height of a panel for a plane body (px).
const HIGHEST: f64 = 260.0;
/// Height of a panel for a bar (px).
const LINE: f64 = 14.0;
/// Maximum number of lines of a case name.
const LINES: usize = 2;
/// Height of one line of a case name (px).
const LEADING: f64 = 14.0;
/// Number of distinct shades. Each part is drawn in the nearest shade.
const SHADES: f64 = 24.0;

/// The error in each part of the body, with one panel for each case.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorMap {
    /// Title above the panels.
    pub title: String,
    /// Label of the colour bar: the quantity with its unit.
    pub label: String,
    /// Name and errors of each case.
    pub panels: Vec<(String, ErrorField)>,
}

/// Scale and position of the bodies in their panels.
struct BodyWindow {
    low: [f64; 2],
    high: [f64; 2],
    /// Pixels per metre.
    zoom: f64,
    width: f64,
    height: f64,
    /// Vertical distance between panels.
    gap: f64,
    /// Number of panels per row.
    columns: usize,
}

impl ErrorMap {
    fn window(&self) -> BodyWindow {
        let parts = || self.panels.iter().flat_map(|(_, field)| &field.parts);
        let margin = self.panels.iter().map(|(_, field)| 0.5 * field.size).fold(0.0, f64::max);
        let low =
            [0, 1].map(|i| parts().map(|part| part[i]).fold(f64::INFINITY, f64::min) - margin);
        let high =
            [0, 1].map(|i| parts().map(|part| part[i]).fold(f64::NEG_INFINITY, f64::max) + margin);
        let is_plane = self.panels.iter().any(|(_, field)| field.is_plane);
        let columns = if is_plane { PLANES } else { 1 };
        let width = (WIDTH - 2.0 * LEFT - GAP * (columns - 1) as f64) / columns as f64;
        let zoom = width / (high[0] - low[0]);
        if !is_plane {
            return BodyWindow { low, high, zoom, width, height: LINE, gap: 4.0, columns };
        }
        let zoom = zoom.min(HIGHEST / (high[1] - low[1]));
        let height = zoom * (high[1] - low[1]);
        BodyWindow { low, high, zoom, width, height, gap: GAP, columns }
    }

    /// Creates the figure as a standalone SVG document.
    pub fn to_svg(&self) -> String {
        let window = self.window();
        let BodyWindow { width, columns, .. } = window;
        let heading = Heading::new(&self.title, WIDTH);
        let top = heading.bottom() + 6.0;
        let names: Vec<Vec<String>> =
            self.panels.iter().map(|(name, _)| wrap(name, TEXT, width, LINES)).collect();
        let named = names.iter().map(Vec::len).max().unwrap_or(0) as f64 * LEADING;
        let row = window.height + 4.0 + named + window.gap;
        let bottom = top + row * self.panels.len().div_ceil(columns) as f64;
        let errors = self.panels.iter().flat_map(|(_, field)| &field.parts).map(|part| part[2]);
        let scale = ColourScale::of(errors.filter(|error| *error > 0.0));
        let height = bottom + 60.0;
        let mut svg = canvas(WIDTH, height, &self.title);
        heading.draw(&mut svg);
        for (k, ((_, field), name)) in self.panels.iter().zip(&names).enumerate() {
            let x = LEFT + (width + GAP) * (k % columns) as f64;
            let y = top + row * (k / columns) as f64;
            let mut panel = SvgElement::group_at((x, y));
            for (i, line) in name.iter().enumerate() {
                let at = (0.0, 12.0 + LEADING * i as f64);
                panel.add(&SvgElement::text(at, "start", line));
            }
            let mut body = SvgElement::group_at((0.0, 4.0 + named));
            drawn(&mut body, field, &window, scale);
            panel.add(&body);
            svg.add(&panel);
        }
        let label = shorten(&self.label, TEXT, WIDTH - 2.0 * LEFT);
        svg.add(&SvgElement::text((LEFT, bottom + 14.0), "start", &label));
        svg.add(&scale.bar((LEFT, bottom + 22.0), ""));
        svg.render() + "\n"
    }
}

/// Draws one path of squares for each shade, and one path of crosses for errors that are not
/// finite.
fn drawn(panel: &mut SvgElement, field: &ErrorField, window: &BodyWindow, scale: ColourScale) {
    let BodyWindow { low, high, zoom, width, height, .. } = window;
    let mut paths: BTreeMap<i64, String> = BTreeMap::new();
    let side = libm::ceil((field.size * zoom).max(2.0));
    let tall = if field.is_plane { side } else { *height };
    for [x, y, error] in &field.parts {
        let across = libm::round((x - low[0]) * zoom - 0.5 * side);
        let down = if field.is_plane { (high[1] - y) * zoom - 0.5 * side } else { 0.0 };
        let down = libm::round(down);
        // A zero error has the darkest shade. An error that is not finite has no shade.
        let share = if *error > 0.0 { scale.share(*error) } else { 0.0 };
        let shade = if error.is_finite() { libm::round(share * SHADES) as i64 } else { -1 };
        let path = paths.entry(shade).or_default();
        // Writing to a string does not fail.
        let _ = match shade {
            -1 => write!(path, "M{across} {down}l{side} {tall}m0-{tall}l-{side} {tall}"),
            _ => write!(path, "M{across} {down}h{side}v{tall}h-{side}z"),
        };
    }
    let frame = SvgElement::new("rect").at("width", *width).at("height", *height);
    panel.add(&frame.set("fill", "none").set("stroke", GRID));
    for (shade, path) in paths {
        let squares = SvgElement::new("path").set("d", &path);
        panel.add(&match shade {
            -1 => squares.set("stroke", NEUTRAL),
            _ => squares.set("fill", &colour(shade as f64 / SHADES).0),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(parts: Vec<[f64; 3]>, is_plane: bool) -> String {
        let field = ErrorField { is_plane, size: 0.5, parts };
        let panels = vec![("one".to_owned(), field.clone()), ("two".to_owned(), field)];
        ErrorMap { title: "A body".to_owned(), label: "error (m)".to_owned(), panels }.to_svg()
    }

    #[test]
    fn the_largest_error_is_light_and_nan_is_crossed_out() {
        let svg = map(vec![[0.0, 0.0, 1e-6], [1.0, 0.0, 1.0], [1.0, 1.0, f64::NAN]], true);
        for fill in ["#002051", "#fdea45"] {
            assert!(svg.contains(&format!("z\" fill=\"{fill}\"")), "{svg}");
        }
        assert_eq!(svg.matches(&format!(" stroke=\"{NEUTRAL}\"")).count(), 2, "{svg}");
        assert!(svg.contains(">\u{2212}6<") && svg.contains(">\u{2212}4<"), "{svg}");
    }

    #[test]
    fn a_body_on_a_line_is_drawn_as_a_strip() {
        let svg = map(vec![[0.0, 0.0, 0.0], [1.0, 0.0, 2.0]], false);
        assert!(svg.contains("v14h-"), "{svg}");
    }

    /// A long name of a case is shortened if another panel is next to it. The note after the name
    /// remains visible on the next line.
    #[test]
    fn the_note_after_a_long_name_is_visible() {
        let field = ErrorField { is_plane: true, size: 0.5, parts: vec![[0.0; 3], [1.0; 3]] };
        let name = "mpm-cubic-bspline-flip-musl, where it broke";
        let panels = vec![(name.to_owned(), field.clone()), ("short".to_owned(), field)];
        let svg = ErrorMap { title: "A".to_owned(), label: "e".to_owned(), panels }.to_svg();
        assert!(svg.contains(">where it broke<") && svg.contains(">short<"), "{svg}");
    }

    /// The figure contains no NaN as a coordinate.
    #[test]
    fn empty_panels_contain_no_nan() {
        for parts in [vec![[0.0, 0.0, 0.0]], vec![[0.0, 0.0, f64::NAN]]] {
            let svg = map(parts, true);
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        }
    }
}

//! Draws bodies by their boundary lines (rims), including holes, with one colour for each material.

use super::view::View;
use crate::report::figure::plot::style::{INK, look};
use crate::report::figure::plot::svg::{Pt, SvgElement, number};
use crate::suite::model::Scene;

/// Opacity of a body, through which the grid is visible.
const OPACITY: &str = "0.35";

/// Maximum distance between points that count as equal, relative to the size of the body.
const ROUNDING: f64 = 1e-9;

/// Returns the closed lines around a body in the plane of the first two axes (m).
pub(super) fn rims(view: &View, body: &Scene) -> Vec<Vec<Pt>> {
    let Some(outline) = &body.outline else {
        let (low, high) = view.rise(body);
        let (left, right) = (body.from[0], body.to[0]);
        return vec![vec![(left, low), (right, low), (right, high), (left, high)]];
    };
    // A rim is complete when it returns to its first point. The next point then starts another rim.
    let tolerance = ROUNDING * (body.to[0] - body.from[0]);
    let mut rims: Vec<Vec<Pt>> = vec![Vec::new()];
    for point in outline.trace() {
        let Some(rim) = rims.last_mut() else { continue };
        let is_start = |start: &Pt| libm::hypot(start.0 - point.0, start.1 - point.1) <= tolerance;
        if rim.len() > 2 && rim.first().is_some_and(is_start) {
            rims.push(Vec::new());
        } else {
            rim.push(point);
        }
    }
    rims.retain(|rim| !rim.is_empty());
    rims
}

/// Chooses the colours of the bodies. Bodies with the same material and density have the same
/// colour.
pub(super) fn colours(scene: &Scene) -> Vec<&'static str> {
    let mut known: Vec<String> = Vec::new();
    let mut colour = |body: &Scene| {
        let material = format!("{:?} {:?}", body.material, body.density);
        let place = known.iter().position(|other| *other == material);
        look(place.unwrap_or_else(|| {
            known.push(material);
            known.len() - 1
        }))
        .colour
    };
    scene.each().iter().map(&mut colour).collect()
}

/// Draws a body with its holes. If the scene has several bodies, the body is labelled with
/// `number_of_body`.
pub(super) fn draw(view: &View, body: &Scene, number_of_body: usize, colour: &str) -> SvgElement {
    let mut path = String::new();
    let rims = rims(view, body);
    for rim in &rims {
        for (k, point) in rim.iter().enumerate() {
            let (x, y) = view.place(*point);
            path += &format!("{}{} {}", if k == 0 { "M" } else { "L" }, number(x), number(y));
        }
        path.push('Z');
    }
    let mut group = SvgElement::new("g");
    let shape = SvgElement::new("path").set("d", &path).set("fill", colour);
    let shape = shape.set("fill-opacity", OPACITY).set("fill-rule", "evenodd");
    group.add(&shape.set("stroke", INK).at("stroke-width", 1.2));
    if view.scene.bodies.len() > 1 {
        let (low, high) = view.rise(body);
        let (x, y) = view.place((0.5 * (body.from[0] + body.to[0]), 0.5 * (low + high)));
        let name = SvgElement::text((x, y + 4.0), "middle", &number_of_body.to_string());
        group.add(&name.set("font-weight", "bold"));
    }
    group
}

/// Draws a sample of the body colour in front of the description of the body.
pub(super) fn swatch((x, y): Pt, colour: &str) -> SvgElement {
    let square = SvgElement::new("rect").at("x", x).at("y", y - 9.0).at("width", 10.0);
    let square = square.at("height", 10.0).set("fill", colour).set("fill-opacity", OPACITY);
    square.set("stroke", INK).at("stroke-width", 1.0)
}

//! Draws markers: the shape shows the series, and the filling whether the level counts.

use super::style::{MarkerShape, PAPER};
use super::svg::{Pt, SvgElement};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fill {
    Solid,
    Hollow,
    Crossed,
}

/// Nominal radius of a marker (px).
pub(crate) const RADIUS: f64 = 4.2;

/// Radius of a crossed marker (px). The larger radius keeps the cross visible in print.
const CROSSED_RADIUS: f64 = 5.6;

pub(crate) fn draw(shape: MarkerShape, fill: Fill, colour: &str, at: Pt) -> SvgElement {
    let radius = match fill {
        Fill::Solid | Fill::Hollow => RADIUS,
        Fill::Crossed => CROSSED_RADIUS,
    };
    let inside = match fill {
        Fill::Solid => colour,
        Fill::Hollow | Fill::Crossed => PAPER,
    };
    let body = body(shape, at, radius).set("fill", inside).stroke(colour, 1.2);
    if fill != Fill::Crossed {
        return body;
    }
    let arm = 0.55 * CROSSED_RADIUS;
    let (x, y) = (at.0, at.1 + lowered(shape) * CROSSED_RADIUS);
    let stroke = |dy| SvgElement::line((x - arm, y - dy), (x + arm, y + dy)).stroke(colour, 1.2);
    SvgElement::group(&[body, stroke(arm), stroke(-arm)])
}

/// Draws an arrow from `tail` straight up to `tip`, for a value that does not fit in the frame.
pub(crate) fn arrow_up(tail: Pt, tip: Pt, colour: &str) -> SvgElement {
    let mut arrow = SvgElement::new("g").set("fill", "none").stroke(colour, 1.3);
    arrow.add(&SvgElement::line(tail, tip));
    let head = [(tip.0 - 3.2, tip.1 + 4.5), tip, (tip.0 + 3.2, tip.1 + 4.5)];
    arrow.add(&SvgElement::through("polyline", &head));
    arrow
}

/// Returns how far the centroid of a triangle is below the centre of the marker, in radii.
fn lowered(shape: MarkerShape) -> f64 {
    match shape {
        MarkerShape::Up => 0.2,
        MarkerShape::Down => -0.2,
        _ => 0.0,
    }
}

fn body(shape: MarkerShape, at: Pt, radius: f64) -> SvgElement {
    // Corners for the unit radius. All shapes have about the same area.
    let corners: &[Pt] = match shape {
        MarkerShape::Circle => {
            return SvgElement::new("circle").at("cx", at.0).at("cy", at.1).at("r", radius);
        }
        MarkerShape::Square => &[(-0.92, -0.92), (0.92, -0.92), (0.92, 0.92), (-0.92, 0.92)],
        MarkerShape::Up => &[(0.0, -1.25), (1.15, 0.85), (-1.15, 0.85)],
        MarkerShape::Down => &[(0.0, 1.25), (1.15, -0.85), (-1.15, -0.85)],
        MarkerShape::Right => &[(1.25, 0.0), (-0.85, 1.15), (-0.85, -1.15)],
        MarkerShape::Diamond => &[(0.0, -1.35), (1.05, 0.0), (0.0, 1.35), (-1.05, 0.0)],
        MarkerShape::Pentagon => {
            &[(0.0, -1.15), (1.09, -0.36), (0.68, 0.93), (-0.68, 0.93), (-1.09, -0.36)]
        }
        MarkerShape::Star => &[
            (0.0, -1.45),
            (0.38, -0.53),
            (1.38, -0.45),
            (0.62, 0.2),
            (0.85, 1.17),
            (0.0, 0.65),
            (-0.85, 1.17),
            (-0.62, 0.2),
            (-1.38, -0.45),
            (-0.38, -0.53),
        ],
    };
    let corners: Vec<Pt> =
        corners.iter().map(|&(x, y)| (at.0 + radius * x, at.1 + radius * y)).collect();
    SvgElement::through("polygon", &corners).set("stroke-linejoin", "round")
}

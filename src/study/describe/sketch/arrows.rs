//! Arrows of what acts inside a body: uniform accelerations, and the velocity that it starts with.

use super::view::View;
use crate::report::figure::plot::style::look;
use crate::report::figure::plot::svg::{Pt, SvgElement};
use crate::suite::model::Scene;
use crate::suite::scene::load::LoadTarget;

/// Length of the longest arrow.
const LONGEST: f64 = 24.0;

/// Arrows along each axis of a body.
const ALONG: usize = 5;

/// A velocity below this share of the largest is drawn as none.
const SMALLEST: f64 = 0.05;

/// An arrow from `tail` to `tip`.
pub(super) fn arrow(tail: Pt, tip: Pt, colour: &str) -> SvgElement {
    let (dx, dy) = (tip.0 - tail.0, tip.1 - tail.1);
    let length = libm::hypot(dx, dy).max(1e-9);
    let (ux, uy) = (dx / length, dy / length);
    let head = f64::min(6.0, 0.6 * length);
    let barb = |side: f64| {
        let (back, aside) = (head, 0.5 * side * head);
        (tip.0 - back * ux - aside * uy, tip.1 - back * uy + aside * ux)
    };
    let mut group = SvgElement::new("g").set("stroke", colour).set("fill", "none");
    group.add(&SvgElement::line(tail, tip).at("stroke-width", 1.5));
    let head = SvgElement::through("polyline", &[barb(1.0), tip, barb(-1.0)]);
    group.add(&head.at("stroke-width", 1.5));
    group
}

/// The vector on the canvas of one in the plane of the scene, the longest of which is `largest`.
fn shown(vector: Pt, largest: f64) -> Pt {
    (LONGEST * vector.0 / largest, -LONGEST * vector.1 / largest)
}

/// Times (s) of which the first is taken at which a load that grows from nothing is there.
const TIMES: [f64; 4] = [0.0, 1e-6, 1e-3, 0.1];

/// The direction on the canvas of what first differs from zero.
pub(super) fn direction(at: impl Fn(f64) -> Pt) -> Option<Pt> {
    let (x, y) = TIMES.into_iter().map(at).find(|v| libm::hypot(v.0, v.1) > 0.0)?;
    let size = libm::hypot(x, y);
    size.is_finite().then(|| (x / size, -y / size))
}

/// The stated velocities of a body at the start, where they are not zero.
pub(super) fn initial_velocity(view: &View, body: &Scene) -> SvgElement {
    let (low, high) = view.rise(body);
    let rows = if body.dimension() == 1 { 1 } else { ALONG };
    let share = |k: usize, count: usize| (k as f64 + 0.5) / count as f64;
    let places = (0..ALONG * rows).map(|k| {
        let (across, up) = (share(k % ALONG, ALONG), share(k / ALONG, rows));
        (body.from[0] + across * (body.to[0] - body.from[0]), low + up * (high - low))
    });
    let velocity = |place: Pt| {
        let mut values = View::in_scene(body, place);
        values.push(0.0);
        let component = |axis: usize| body.initial_velocity.get(axis).map(|v| v.eval(&values));
        (place, (component(0).unwrap_or(0.0), component(1).unwrap_or(0.0)))
    };
    let velocities: Vec<(Pt, Pt)> =
        places.filter(|place| View::covers(body, *place)).map(velocity).collect();
    let size = |v: &Pt| libm::hypot(v.0, v.1);
    let largest = velocities.iter().map(|(_, v)| size(v)).fold(0.0, f64::max);
    let mut group = SvgElement::new("g");
    for (place, v) in velocities.iter().filter(|(_, v)| size(v) > SMALLEST * largest) {
        let ((x, y), (dx, dy)) = (view.place(*place), shown(*v, largest));
        let (tail, tip) = ((x - 0.5 * dx, y - 0.5 * dy), (x + 0.5 * dx, y + 0.5 * dy));
        group.add(&arrow(tail, tip, look(2).colour));
    }
    group
}

/// The uniform accelerations of the scene, above the grid.
pub(super) fn accelerations(view: &View) -> SvgElement {
    let mut group = SvgElement::new("g");
    let uniform = view.scene.loads_on(LoadTarget::Body).filter(|load| load.is_uniform());
    for (k, load) in uniform.enumerate() {
        let centre: Vec<f64> = view.scene.from.iter().map(|_| 0.0).collect();
        let component = |axis: usize, t: f64| {
            let known = view.scene.dimension() > axis;
            if known { load.stated(axis, &centre, t, &[0.0; 3]) } else { 0.0 }
        };
        let Some((ux, uy)) = direction(|t| (component(0, t), component(1, t))) else { continue };
        let (x, y) = view.place((view.to[0], view.to[1]));
        let (dx, dy) = (LONGEST * ux, LONGEST * uy);
        let middle = (x - 18.0 - 80.0 * k as f64, y - 26.0);
        let tail = (middle.0 - 0.5 * dx, middle.1 - 0.5 * dy);
        group.add(&arrow(tail, (tail.0 + dx, tail.1 + dy), look(1).colour));
        let place = (middle.0 - 18.0, y - 22.0);
        group.add(&SvgElement::text(place, "end", load.effect.name()));
    }
    group
}

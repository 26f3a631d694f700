//! Symbols in a sketch: conditions and loads on faces, accelerations and initial velocities.

use super::shape::rims;
use super::view::View;
use crate::exact::Region;
use crate::report::figure::plot::style::{INK, PAPER, look};
use crate::report::figure::plot::svg::{Pt, SvgElement};
use crate::suite::model::{Scene, SceneFace};
use crate::suite::scene::load::{ListedLoad, LoadTarget};

/// Distance (px) between hatches or rollers along a face; `ARROW_STEP` is the distance between
/// arrows.
const STEP: f64 = 9.0;
const ARROW_STEP: f64 = 26.0;

/// Distance (px) by which hatches or rollers extend from a face; `ARROW` is the length of an arrow.
const REACH: f64 = 8.0;
const ARROW: f64 = 20.0;

/// A traction is drawn along the face if its normal component is below this fraction of its size.
const ALONG: f64 = 0.3;

/// A face on the canvas: its ends and its outward direction.
struct Edge {
    ends: [Pt; 2],
    out: Pt,
}

impl Edge {
    fn of(view: &View, face: &SceneFace) -> Self {
        let scene = &view.scene;
        let x = if face.high { scene.to[face.axis] } else { scene.from[face.axis] };
        let [low, high] = ends(view, face, x);
        let at = |along: f64| if face.axis == 0 { (x, along) } else { (along, x) };
        let sign = if face.high { 1.0 } else { -1.0 };
        let out = if face.axis == 0 { (sign, 0.0) } else { (0.0, -sign) };
        Self { ends: [view.place(at(low)), view.place(at(high))], out }
    }

    fn length(&self) -> f64 {
        let [a, b] = self.ends;
        libm::hypot(b.0 - a.0, b.1 - a.1)
    }

    /// Returns the point at the relative position `share` along the face, `away` pixels outside it.
    fn at(&self, share: f64, away: f64) -> Pt {
        let ([a, b], out) = (self.ends, self.out);
        (a.0 + share * (b.0 - a.0) + away * out.0, a.1 + share * (b.1 - a.1) + away * out.1)
    }

    /// Returns relative positions along the face that are about `step` apart.
    fn shares(&self, step: f64) -> impl Iterator<Item = f64> {
        let count = libm::floor(self.length() / step).max(1.0) as usize;
        (0..count).map(move |k| (k as f64 + 0.5) / count as f64)
    }

    /// Returns tail and tip of an arrow in `direction`. The arrow of a pressure ends at the face,
    /// and the arrow of a tension starts there. An arrow along the face is drawn next to it.
    fn loaded(&self, share: f64, direction: Option<Pt>) -> (Pt, Pt) {
        let (ux, uy) = direction.unwrap_or(self.out);
        let (x, y) = (ARROW * ux, ARROW * uy);
        let pull = ux * self.out.0 + uy * self.out.1;
        if pull.abs() < ALONG {
            let middle = self.at(share, 0.5 * REACH);
            let tail = (middle.0 - 0.5 * x, middle.1 - 0.5 * y);
            return (tail, (tail.0 + x, tail.1 + y));
        }
        let near = self.at(share, 2.0);
        if pull > 0.0 { (near, (near.0 + x, near.1 + y)) } else { ((near.0 - x, near.1 - y), near) }
    }

    fn line(&self, away: f64, width: f64, colour: &str) -> SvgElement {
        let line = SvgElement::line(self.at(0.0, away), self.at(1.0, away));
        line.set("stroke", colour).at("stroke-width", width)
    }

    /// Draws the hatching of a wall that starts `away` pixels from the face.
    fn hatching(&self, away: f64, group: &mut SvgElement) {
        let lean = 0.5 * REACH / self.length();
        for share in self.shares(STEP) {
            let (from, to) = (self.at(share + lean, away), self.at(share - lean, away + REACH));
            group.add(&SvgElement::line(from, to).set("stroke", INK).at("stroke-width", 1.0));
        }
    }
}

/// Returns the first two components of a load's traction (Pa) at the relative position `share`
/// along its face.
fn traction(view: &View, load: &ListedLoad, face: &SceneFace, share: f64, t: f64) -> Pt {
    let scene = &view.scene;
    let x = if face.high { scene.to[face.axis] } else { scene.from[face.axis] };
    let [low, high] = ends(view, face, x);
    let along = low + share * (high - low);
    let mut values = View::in_scene(scene, if face.axis == 0 { (x, along) } else { (along, x) });
    values.push(t);
    let found = load.traction(&values);
    let component = |axis: usize| found.get(axis).copied().unwrap_or(0.0);
    (component(0), component(1))
}

/// Returns the ends of a face (m) along the other axis. A body that is not a box may touch only a
/// part of the face; the ends are then those of this part.
fn ends(view: &View, face: &SceneFace, x: f64) -> [f64; 2] {
    let (scene, other) = (&view.scene, 1 - face.axis);
    if scene.mapped.is_some() {
        let tolerance = 1e-9 * (scene.to[face.axis] - scene.from[face.axis]);
        let pair = |point: &Pt| if face.axis == 0 { *point } else { (point.1, point.0) };
        let on_face = rims(view, scene).concat().iter().map(pair).collect::<Vec<Pt>>();
        let on_face = on_face.iter().filter(|point| (point.0 - x).abs() <= tolerance);
        let (low, high) = on_face.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), point| {
            (low.min(point.1), high.max(point.1))
        });
        if low < high {
            return [low, high];
        }
    }
    match scene.dimension() {
        1 => [0.0, view.h],
        _ => [scene.from[other], scene.to[other]],
    }
}

pub(super) fn draw(view: &View, number: usize, face: &SceneFace) -> SvgElement {
    let edge = Edge::of(view, face);
    let mut group = SvgElement::new("g");
    match face.condition() {
        "fixed" => {
            group.add(&edge.line(0.0, 2.5, INK));
            edge.hatching(0.0, &mut group);
        }
        "roller" => {
            group.add(&edge.line(0.0, 1.5, INK));
            for share in edge.shares(STEP) {
                let (x, y) = edge.at(share, 0.5 * REACH);
                let roller = SvgElement::new("circle").at("cx", x).at("cy", y).at("r", 3.0);
                group.add(&roller.set("fill", PAPER).set("stroke", INK));
            }
            group.add(&edge.line(REACH, 1.5, INK));
        }
        "friction" => {
            // The wall is drawn next to the body, because the body can separate from it.
            group.add(&edge.line(3.0, 1.5, INK));
            edge.hatching(3.0, &mut group);
        }
        "periodic" => group.add(&edge.line(0.0, 2.0, INK).set("stroke-dasharray", "6 4")),
        // The direction of the prescribed motion is not drawn.
        "velocity" => group.add(&edge.line(0.0, 4.0, look(2).colour)),
        _ => {}
    }
    for load in view.scene.loads_on(LoadTarget::Face(number)) {
        for share in edge.shares(ARROW_STEP) {
            let (tail, tip) =
                edge.loaded(share, direction(|t| traction(view, load, face, share, t)));
            group.add(&arrow(tail, tip, look(1).colour));
        }
    }
    group
}

/// Draws a particle set that a load refers to, as a dashed box with its name.
pub(super) fn set(view: &View, set: &Region) -> SvgElement {
    let across = if view.scene.dimension() == 1 { (0.0, view.h) } else { (set.from[1], set.to[1]) };
    let low = view.place((set.from[0], across.0));
    let high = view.place((set.to[0], across.1));
    let mut group = SvgElement::new("g");
    let frame = SvgElement::new("rect").at("x", low.0).at("y", high.1);
    let frame = frame.at("width", high.0 - low.0).at("height", low.1 - high.1);
    let frame = frame.set("fill", "none").set("stroke", look(1).colour);
    group.add(&frame.at("stroke-width", 1.5).set("stroke-dasharray", "5 3"));
    let name = (0.5 * (low.0 + high.0), high.1 - 5.0);
    group.add(&SvgElement::text(name, "middle", &set.name));
    group
}

/// Length of the longest arrow (px).
const LONGEST: f64 = 24.0;

/// Number of arrows along each axis of a body.
const PER_AXIS: usize = 5;

/// Minimum velocity that gets an arrow, as a fraction of the largest velocity.
const SMALLEST: f64 = 0.05;

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

/// Converts a vector in the plane of the scene to the canvas. `largest` is the length of the
/// longest vector.
fn shown(vector: Pt, largest: f64) -> Pt {
    (LONGEST * vector.0 / largest, -LONGEST * vector.1 / largest)
}

/// Times (s) at which a load is evaluated. The first time with a non-zero load is used.
const TIMES: [f64; 4] = [0.0, 1e-6, 1e-3, 0.1];

/// Returns the direction on the canvas of the first non-zero vector that `at` returns.
pub(super) fn direction(at: impl Fn(f64) -> Pt) -> Option<Pt> {
    let (x, y) = TIMES.into_iter().map(at).find(|v| libm::hypot(v.0, v.1) > 0.0)?;
    let size = libm::hypot(x, y);
    size.is_finite().then(|| (x / size, -y / size))
}

/// Draws arrows for the initial velocities of a body, if they are not zero.
pub(super) fn initial_velocity(view: &View, body: &Scene) -> SvgElement {
    let (low, high) = view.rise(body);
    let rows = if body.dimension() == 1 { 1 } else { PER_AXIS };
    let share = |k: usize, count: usize| (k as f64 + 0.5) / count as f64;
    let places = (0..PER_AXIS * rows).map(|k| {
        let (across, up) = (share(k % PER_AXIS, PER_AXIS), share(k / PER_AXIS, rows));
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

/// Draws arrows for the uniform accelerations of the scene, above the grid.
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

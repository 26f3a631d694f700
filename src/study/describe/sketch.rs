//! A sketch of a scene: bodies, grid and faces, as text and as SVG.

use crate::report::figure::plot::style::{FONT, GRID, INK, PAPER, TEXT, WIDTH, look};
use crate::report::figure::plot::svg::{Pt, SvgElement};
use crate::suite::model::grid_size::grid_axis;
use crate::suite::model::load::LoadTarget;
use crate::suite::model::{ConvergencePlan, Scene, SceneFace, Suite};

/// Most characters along the first axis, and along the second.
const COLUMNS: usize = 60;
const ROWS: usize = 14;

/// A line of text is about twice as high as a character is wide.
const ASPECT: f64 = 0.5;

/// The grid of the coarsest level in the plane of the first two axes.
struct View<'a> {
    scene: &'a Scene,
    from: [f64; 2],
    to: [f64; 2],
    h: f64,
}

impl<'a> View<'a> {
    fn of(suite: &'a Suite) -> Option<Self> {
        let plan = suite.plan::<ConvergencePlan>()?;
        let (scene, h) = (&plan.scene, plan.refine.levels.first()?.h);
        // A bar is drawn as one cell high.
        let (mut from, mut to) = ([0.0; 2], [0.0, h]);
        for axis in 0..scene.dimension().min(2) {
            let (start, cells) = grid_axis(scene, axis, h);
            (from[axis], to[axis]) = (start, start + cells * h);
        }
        Some(Self { scene, from, to, h })
    }

    /// Number of the body that covers a place, in the middle of a third axis.
    fn body_at(&self, x: f64, y: f64) -> Option<usize> {
        let holds = |body: &Scene| {
            let place: Vec<f64> = (0..body.dimension())
                .map(|axis| match axis {
                    0 => x,
                    1 => y,
                    _ => 0.5 * (body.from[axis] + body.to[axis]),
                })
                .collect();
            let inside = |(axis, x): (usize, &f64)| (body.from[axis]..=body.to[axis]).contains(x);
            place.iter().enumerate().all(inside)
                && body.outline.as_ref().is_none_or(|outline| outline.holds(&place))
        };
        self.scene.each().iter().position(holds)
    }
}

/// Face with its condition or load: `left: fixed`.
fn label(scene: &Scene, number: usize, face: &SceneFace) -> String {
    let loads: Vec<&str> =
        scene.loads_on(LoadTarget::Face(number)).map(|load| load.effect.name()).collect();
    let state = if loads.is_empty() { face.condition().to_owned() } else { loads.join(", ") };
    format!("{}: {state}", face.name)
}

/// The scene as text, a character for a part of the grid: `.` where it is empty, `#` (or the number
/// of the body, of several) where there is material. Empty for a suite without levels.
pub fn sketch_text(suite: &Suite) -> Vec<String> {
    let Some(view) = View::of(suite) else { return Vec::new() };
    let size = [view.to[0] - view.from[0], view.to[1] - view.from[1]];
    let whole = |number: f64, most: usize| (libm::round(number) as usize).clamp(1, most);
    let ratio = ASPECT * size[1] / size[0];
    let (columns, rows) = match view.scene.dimension() {
        1 => (COLUMNS, 1),
        _ if ratio * COLUMNS as f64 > ROWS as f64 => (whole(ROWS as f64 / ratio, COLUMNS), ROWS),
        _ => (COLUMNS, whole(ratio * COLUMNS as f64, ROWS)),
    };
    let several = view.scene.bodies.len() > 1;
    let character = |column: usize, row: usize| {
        let x = view.from[0] + size[0] * (column as f64 + 0.5) / columns as f64;
        let y = view.to[1] - size[1] * (row as f64 + 0.5) / rows as f64;
        match view.body_at(x, y) {
            None => '.',
            Some(body) if several => char::from_digit((body as u32 + 1) % 36, 36).unwrap_or('#'),
            Some(_) => '#',
        }
    };
    let mut lines: Vec<String> =
        (0..rows).map(|row| (0..columns).map(|column| character(column, row)).collect()).collect();
    let coordinates = |at: [f64; 2]| match view.scene.dimension() {
        1 => format!("{:.4}", at[0]),
        _ => format!("({:.4}, {:.4})", at[0], at[1]),
    };
    lines.push(format!("grid from {} to {} m", coordinates(view.from), coordinates(view.to)));
    let faces = view.scene.faces.iter().enumerate();
    let faces: Vec<String> = faces.map(|(i, face)| label(view.scene, i, face)).collect();
    lines.extend((!faces.is_empty()).then(|| faces.join("; ")));
    lines
}

/// The scene as an SVG document: cells of the coarsest level, bodies, held and loaded faces; `None`
/// for a suite without levels.
pub fn sketch_svg(suite: &Suite) -> Option<String> {
    const MARGIN: f64 = 60.0;
    let view = View::of(suite)?;
    let size = [view.to[0] - view.from[0], view.to[1] - view.from[1]];
    let scale = (WIDTH - 2.0 * MARGIN) / size[0].max(size[1]);
    let height = size[1] * scale + 2.0 * MARGIN;
    let at = |x: f64, y: f64| -> Pt {
        (MARGIN + (x - view.from[0]) * scale, height - MARGIN - (y - view.from[1]) * scale)
    };
    let mut svg = SvgElement::new("svg")
        .set("xmlns", "http://www.w3.org/2000/svg")
        .set("viewBox", &format!("0 0 {WIDTH} {height:.0}"))
        .set("font-family", FONT)
        .at("font-size", TEXT);
    svg.add(&SvgElement::new("title").content(&format!("Scene of {}", suite.name)));
    let paper = SvgElement::new("rect").at("width", WIDTH).at("height", height);
    svg.add(&paper.set("fill", PAPER));
    for (k, body) in view.scene.each().iter().enumerate() {
        let outline: Vec<Pt> = outline(body, view.h).iter().map(|p| at(p.0, p.1)).collect();
        let shape = SvgElement::through("polygon", &outline);
        svg.add(&shape.set("fill", look(k).colour).set("fill-opacity", "0.35").set("stroke", INK));
    }
    for axis in 0..2 {
        let count = libm::round(size[axis] / view.h) as usize;
        for k in 0..=count {
            let x = view.from[axis] + k as f64 * view.h;
            let (a, b) = if axis == 0 {
                (at(x, view.from[1]), at(x, view.to[1]))
            } else {
                (at(view.from[0], x), at(view.to[0], x))
            };
            svg.add(&SvgElement::line(a, b).set("stroke", GRID));
        }
    }
    for (number, face) in view.scene.faces.iter().enumerate().filter(|(_, face)| face.axis < 2) {
        let text = label(view.scene, number, face);
        let (scene, other) = (view.scene, 1 - face.axis);
        let x = if face.high { scene.to[face.axis] } else { scene.from[face.axis] };
        let ends = if scene.dimension() == 1 {
            (0.0, view.h)
        } else {
            (scene.from[other], scene.to[other])
        };
        let place = |along: f64| if face.axis == 0 { at(x, along) } else { at(along, x) };
        let (a, b) = (place(ends.0), place(ends.1));
        if !face.hold.is_free() {
            svg.add(&SvgElement::line(a, b).set("stroke", INK).at("stroke-width", 3.0));
        }
        let middle = (0.5 * (a.0 + b.0), 0.5 * (a.1 + b.1));
        let (shift, anchor) = match (face.axis, face.high) {
            (0, false) => ((-6.0, -8.0 - 0.5 * (a.1 - b.1).abs()), "start"),
            (0, true) => ((6.0, -8.0 - 0.5 * (a.1 - b.1).abs()), "end"),
            (_, false) => ((0.0, 18.0), "middle"),
            (_, true) => ((0.0, -24.0), "middle"),
        };
        let label = SvgElement::text((middle.0 + shift.0, middle.1 + shift.1), anchor, &text);
        svg.add(&label.set("fill", INK));
    }
    let corners = [(view.from, (0.0, 34.0), "start"), (view.to, (0.0, 34.0), "end")];
    for (corner, shift, anchor) in corners {
        let (x, _) = at(corner[0], corner[1]);
        let place = (x + shift.0, height - MARGIN + shift.1);
        svg.add(&SvgElement::text(place, anchor, &format!("{:.4} m", corner[0])).set("fill", INK));
    }
    Some(svg.render() + "\n")
}

/// Outline of a body in the plane of the first two axes; a bar is one cell high.
fn outline(body: &Scene, h: f64) -> Vec<Pt> {
    if let Some(outline) = &body.outline {
        return outline.trace();
    }
    let (low, high) = if body.dimension() == 1 { (0.0, h) } else { (body.from[1], body.to[1]) };
    vec![(body.from[0], low), (body.to[0], low), (body.to[0], high), (body.from[0], high)]
}

//! The sketch as an SVG document.

use super::view::View;
use super::{shape, symbols};
use crate::report::figure::plot::canvas::{canvas, wrap};
use crate::report::figure::plot::style::{GRID, INK, NEUTRAL, TEXT, WIDTH};
use crate::report::figure::plot::svg::{Pt, SvgElement};
use crate::study::describe::{self, stated};
use crate::subject::PlaneState;
use crate::suite::model::Suite;
use crate::suite::scene::face::FACES;

/// Minimum width (px) of cells that are drawn. Smaller cells would appear as a grey area.
const FINEST: f64 = 3.0;

/// Height (px) of a line of text below the scene.
const LINE: f64 = 16.0;

/// Maximum number of lines of text per row.
const MOST_LINES: usize = 3;

/// Left end (px) of the names of rows.
const NAMES: f64 = 12.0;

/// Left end (px) of the values of rows.
const VALUES: f64 = 142.0;

/// Draws the scene as an SVG document: cells of the coarsest level, bodies, and faces with their
/// conditions and loads. All other information is text. `None` for a suite without a scene.
pub fn sketch_svg(suite: &Suite) -> Option<String> {
    let view = View::of(suite)?;
    let colours = shape::colours(&view.scene);
    let words = words(&view);
    let lines: usize = words.iter().map(Row::lines).sum();
    let height = view.height() + 8.0 + LINE * lines as f64;
    let title = format!("Scene of {}", suite.name);
    let mut svg = canvas(WIDTH, height, &title);
    svg.add(&grid(&view));
    for (k, (body, colour)) in view.scene.each().iter().zip(&colours).enumerate() {
        svg.add(&shape::draw(&view, body, k + 1, colour));
    }
    for body in view.scene.each() {
        svg.add(&symbols::initial_velocity(&view, body));
    }
    for (k, one) in view.scene.faces.iter().enumerate().filter(|(_, face)| face.axis < 2) {
        svg.add(&symbols::draw(&view, k, one));
    }
    for set in &view.scene.sets {
        svg.add(&symbols::set(&view, set));
    }
    svg.add(&symbols::accelerations(&view));
    if view.scene.plane == PlaneState::Axisymmetric {
        let ends = [view.place((0.0, view.from[1])), view.place((0.0, view.to[1]))];
        let axis = SvgElement::line((ends[0].0, ends[0].1 + 14.0), (ends[1].0, ends[1].1 - 14.0));
        svg.add(&axis.set("stroke", INK).set("stroke-dasharray", "9 3 2 3"));
    }
    svg.add(&corners(&view));
    let mut y = view.height() + 2.0;
    let mut bodies = colours.iter();
    for row in &words {
        if let Some(colour) = row.is_body.then(|| bodies.next()).flatten() {
            svg.add(&shape::swatch((VALUES - 16.0, y), colour));
        }
        for (k, name) in row.name.iter().enumerate() {
            let at = (NAMES, y + LINE * k as f64);
            svg.add(&SvgElement::text(at, "start", name).set("fill", NEUTRAL));
        }
        for (k, line) in row.value.iter().enumerate() {
            svg.add(&SvgElement::text((VALUES, y + LINE * k as f64), "start", line));
        }
        y += LINE * row.lines() as f64;
    }
    Some(svg.render() + "\n")
}

/// A text row below the scene, with its name and value split into lines.
struct Row {
    name: Vec<String>,
    value: Vec<String>,
    is_body: bool,
}

impl Row {
    fn lines(&self) -> usize {
        self.name.len().max(self.value.len())
    }
}

/// Returns the rows below the scene: the viewing direction, and the statement of the problem.
fn words(view: &View) -> Vec<Row> {
    let cells = |axis: usize| libm::round(view.size()[axis] / view.h);
    let counts = match view.scene.dimension() {
        1 => format!("{} cells", cells(0)),
        _ => format!("{} x {} cells", cells(0), cells(1)),
    };
    let mut rows = vec![("grid".to_owned(), format!("{counts} of {} m", stated(view.h)))];
    if view.scene.dimension() == 3 {
        rows.push(("view".to_owned(), "plane of X and Y, seen along Z".to_owned()));
    }
    if !view.is_to_scale() {
        rows.push(("scale".to_owned(), "Y is drawn larger than X".to_owned()));
    }
    let mut statement = describe::Rows::new();
    describe::scene(&view.scene, &mut statement);
    rows.extend(statement.into_iter().filter(|(name, _)| name != "grid"));
    // Neighbouring faces with equal text share a row.
    let is_face = |name: &str| FACES.contains(&name);
    let alike = rows.chunk_by(|a, b| is_face(&a.0) && is_face(&b.0) && a.1 == b.1);
    let row = |alike: &[(String, String)]| {
        let names: Vec<&str> = alike.iter().map(|(name, _)| name.trim()).collect();
        let name = names.join(", ");
        Row {
            is_body: name == "body" || name.starts_with("body "),
            name: wrap(&name, TEXT, VALUES - NAMES - 4.0, MOST_LINES),
            value: wrap(&alike[0].1, TEXT, WIDTH - VALUES - NAMES, MOST_LINES),
        }
    };
    alike.map(row).collect()
}

fn grid(view: &View) -> SvgElement {
    let mut group = SvgElement::new("g").set("stroke", GRID).at("stroke-width", 0.8);
    for (axis, length) in view.size().into_iter().enumerate() {
        let count = libm::round(length / view.h) as usize;
        // If cells are too small to be drawn, only the boundary of the grid is drawn.
        let fine = view.h * view.scale()[axis] < FINEST;
        for k in (0..=count).step_by(if fine { count.max(1) } else { 1 }) {
            let x = view.from[axis] + k as f64 * view.h;
            let (a, b) = match axis {
                0 => ((x, view.from[1]), (x, view.to[1])),
                _ => ((view.from[0], x), (view.to[0], x)),
            };
            group.add(&SvgElement::line(view.place(a), view.place(b)));
        }
    }
    group
}

/// Labels the corners of the grid with their coordinates, below the grid and on its left.
fn corners(view: &View) -> SvgElement {
    let mut group = SvgElement::new("g");
    let low = view.place((view.from[0], view.from[1]));
    let high = view.place((view.to[0], view.to[1]));
    let mut add = |at: Pt, anchor: &str, value: f64| {
        group.add(&SvgElement::text(at, anchor, &stated(value)));
    };
    let below = low.1 + 30.0;
    add((low.0, below), "middle", view.from[0]);
    add((high.0, below), "middle", view.to[0]);
    if view.scene.dimension() > 1 {
        let beside = low.0 - 12.0;
        add((beside, low.1), "end", view.from[1]);
        add((beside, high.1 + 4.0), "end", view.to[1]);
    }
    group
}

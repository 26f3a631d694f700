//! Sketches a scene with its bodies, grid, faces and loads, as text and as SVG.
//!
//! Symbols follow the usual conventions (hatching for a fixed face, rollers, arrows for loads).
//! Other information is written below the picture, as in reports.

mod shape;
mod svg;
mod symbols;
mod view;

use self::view::View;
use crate::suite::model::{Scene, SceneFace, Suite};
use crate::suite::scene::load::LoadTarget;
pub use svg::sketch_svg;

/// Maximum number of characters of the text sketch along the first axis.
const COLUMNS: usize = 60;

/// Maximum number of characters of the text sketch along the second axis.
const ROWS: usize = 14;

/// Width of a character divided by the height of a line.
const ASPECT: f64 = 0.5;

/// Describes a face and its condition or loads, such as `left: fixed`.
fn label(scene: &Scene, number: usize, face: &SceneFace) -> String {
    let loads: Vec<&str> =
        scene.loads_on(LoadTarget::Face(number)).map(|load| load.effect.name()).collect();
    let state = if loads.is_empty() { face.condition().to_owned() } else { loads.join(", ") };
    format!("{}: {state}", face.name)
}

/// Returns the scene as text, with one character for each part of the grid: `.` if it is empty, `#`
/// (or the number of the body, if there are several) if it contains material. Empty for a suite
/// without a scene.
pub fn sketch_text(suite: &Suite) -> Vec<String> {
    let Some(view) = View::of(suite) else { return Vec::new() };
    let size = view.size();
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
        match view.scene.each().iter().position(|body| View::covers(body, (x, y))) {
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
    let faces: Vec<String> = faces.map(|(i, face)| label(&view.scene, i, face)).collect();
    lines.extend((!faces.is_empty()).then(|| faces.join("; ")));
    lines
}

//! Warns of interfaces and loaded faces inside a cell.

use super::subject::Preflight;
use crate::suite::model::Scene;
use crate::suite::scene::grid_axis;
use crate::suite::scene::load::LoadTarget;
use crate::suite::yaml::locate::Path;
use crate::suite::yaml::{Diagnostic, Severity};

/// Maximum distance (cells) from a grid line that counts as rounding error.
const ROUNDING: f64 = 1e-6;

struct Plane {
    axis: usize,
    x: f64,
    what: String,
    path: Path,
    severity: Severity,
}

impl Plane {
    /// Returns the distance from the nearest grid line, in cells of size `h` (m).
    fn off(&self, scene: &Scene, h: f64) -> f64 {
        let line = (self.x - grid_axis(scene, self.axis, h).0) / h;
        (line - libm::round(line)).abs()
    }
}

pub(crate) fn check(preflight: &Preflight<'_>) -> Vec<Diagnostic> {
    let planes = planes(&preflight.plan.scene);
    planes.iter().filter_map(|plane| inside_a_cell(preflight, plane)).collect()
}

/// Whether all interfaces and loaded faces lie on grid lines if cells have the size `h` (m).
pub(crate) fn is_aligned(scene: &Scene, h: f64) -> bool {
    planes(scene).iter().all(|plane| plane.off(scene, h) <= ROUNDING)
}

fn planes(scene: &Scene) -> Vec<Plane> {
    let mut planes = loaded_faces(scene);
    planes.extend(interfaces(scene));
    planes
}

fn inside_a_cell(preflight: &Preflight<'_>, plane: &Plane) -> Option<Diagnostic> {
    let (scene, Plane { x, what, path, .. }) = (&preflight.plan.scene, plane);
    let level = preflight.levels().iter().find(|level| plane.off(scene, level.h) > ROUNDING)?;
    let (cells, share) = (level.cells, plane.off(scene, level.h));
    let message =
        format!("with {cells} cells {what} at {x:.4} m is {share:.2} cells away from a grid line");
    let found = preflight.finding(plane.severity, path, &message);
    Some(found.with_help(
        "a face or interface inside a cell can reduce the order by one: choose a cell size that divides the length",
    ))
}

fn loaded_faces(scene: &Scene) -> Vec<Plane> {
    let loaded = scene.loads.iter().filter_map(|load| match load.target() {
        LoadTarget::Face(i) => scene.faces.get(i),
        LoadTarget::Body | LoadTarget::Rim(_) | LoadTarget::Set(_) => None,
    });
    loaded
        .map(|face| {
            let x = if face.high { scene.to[face.axis] } else { scene.from[face.axis] };
            let what = format!("the loaded {} face", face.name);
            let path = Path::top("scene").then("loads");
            // The finding is only a note: particles transfer the load to the grid, so the method
            // determines the point where the load acts.
            Plane { axis: face.axis, x, what, path, severity: Severity::Note }
        })
        .collect()
}

fn interfaces(scene: &Scene) -> Vec<Plane> {
    let mut planes = Vec::new();
    for (i, body) in scene.bodies.iter().enumerate() {
        for axis in 0..scene.dimension() {
            let x = body.to[axis];
            let meets = |other: &Scene| (other.from[axis] - x).abs() <= 1e-9 * x.abs().max(1.0);
            if scene.bodies.iter().any(meets) {
                let path = Path::top("scene").then("bodies").then(i);
                let what = "the interface of two bodies".to_owned();
                planes.push(Plane { axis, x, what, path, severity: Severity::Warning });
            }
        }
    }
    planes
}

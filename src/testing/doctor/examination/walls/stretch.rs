//! A bar that is stretched evenly from a wall, in which linear functions of place must stay linear.
//!
//! With the initial velocity `v = a (X - X_wall)` along the normal a bar of linear elasticity
//! stretches evenly until a wave arrives from its free end: every particle keeps its velocity. A
//! method reproduces this where its functions represent a linear velocity up to the wall. It does
//! not where nodes beyond the wall are held at zero, for instance: the exact values are the odd
//! continuation of the field.

use super::measure::{BarEnd, bar};
use crate::testing::doctor::course::displacement;
use crate::testing::doctor::patient::{Hindrance, Patient};
use crate::testing::doctor::scene::{BoxScene, FACES, H, Kind};
use crate::testing::doctor::vectors::AffineField;

/// Strain rate times the time of a wave through a cell.
const RATE: f64 = 1e-4;

/// Distance that waves travel (cells), and number of steps.
const TRAVEL: f64 = 4.0;
const STEPS: u64 = 16;

/// Errors of the displacements within two cells of the walls at both ends of `axis`, over the
/// displacement at a distance of one cell; positive away from the wall.
pub(super) fn stretch_errors(
    patient: &Patient<'_>,
    kind: Kind,
    axis: usize,
    condition: &'static str,
) -> Result<[f64; 2], Hindrance> {
    let ends = [false, true].map(|high| BarEnd { axis, high });
    let scenes = ends.map(|end| scene(kind, end, condition));
    let courses = patient.run_all(&scenes)?;
    Ok(std::array::from_fn(|k| {
        let (end, scene, course) = (ends[k], &scenes[k], &courses[k]);
        let strain = scene.velocity.gradient[axis][axis] * course.times[course.last()];
        let mut largest = 0.0_f64;
        for (label, u) in course.points(displacement, course.last()) {
            let depth = end.depth(scene, label);
            let error = (-end.sign() * u[axis] - strain * depth) / (strain * H);
            // NaN stays.
            if depth <= 2.0 * H && !(error.abs() <= largest.abs()) {
                largest = error;
            }
        }
        largest
    }))
}

/// The bar with one wall, stretched from there.
fn scene(kind: Kind, end: BarEnd, condition: &'static str) -> BoxScene {
    let mut scene = bar(kind, end.axis, condition);
    scene.faces = vec![(FACES[end.axis][usize::from(end.high)], condition)];
    let wall = if end.high {
        scene.grid.0[end.axis] -= 4.0 * H;
        scene.body.1[end.axis]
    } else {
        scene.grid.1[end.axis] += 4.0 * H;
        scene.body.0[end.axis]
    };
    let mut velocity = AffineField::default();
    velocity.gradient[end.axis][end.axis] = RATE * scene.wave_speed() / H;
    velocity.centre[end.axis] = wall;
    scene.velocity = velocity;
    scene.with_waves(TRAVEL, STEPS)
}

//! Examination of walls with a given velocity.
//!
//! A wall of the velocity v pushes a bar at rest with the force `rho c v A` until waves return.
//! Walls at low ends have a constant velocity, and walls at high ends `v t/T` with the run time T.

use super::stress::{constant_and_rate, judge_ends};
use super::walls::bar;
use crate::testing::doctor::prelude::*;

pub(super) const EXAMINATION: Examination = Examination {
    name: "moving-wall",
    expected: "a wall of the velocity v, constant or growing, pushes a bar at rest with the force \
               rho c v per area, and points next to the wall move with the wall",
    after: &["translation", "transfer", "stress", "vibration", "walls"],
    covers: &["conditions: velocity"],
    examine: |patient| judge_ends(patient, &[2, 1, 3], &RULES, pushed, measure),
};

/// Velocity of the wall along its normal and along its tangents, relative to the wave speed.
const SHARES: [f64; 3] = [1e-3, 0.6e-3, -0.4e-3];

/// Smooth motions have force errors of up to 0.2. After a sudden start, the force oscillates.
const RULES: Rules<4> = Rules {
    quantities: [
        ("force", 1.0, 0.5),
        ("growth of the force", 1.0, 0.3),
        ("displacement along the normal", 1.0, 0.3),
        ("along the wall", 1.0, 0.3),
    ],
    findings: &[
        (
            "wall-velocity-missing",
            [0.0, 0.0, 0.0, ANY],
            "the wall does not move, or a velocity that varies keeps its value of the start, which \
             is zero at high ends",
        ),
        (
            "wall-velocity-without-force",
            [0.0, 0.0, 1.0, ANY],
            "particles move with the wall, but their velocities do not change: nodal velocities \
             are set, but not the accelerations from which FLIP updates particles",
        ),
        ("wall-velocity-sign", [-1.0, -1.0, -1.0, ANY], "the sign is wrong"),
        (
            "wall-velocity-along-normal-only",
            [1.0, 1.0, 1.0, 0.0],
            "only the component along the normal is given to the nodes",
        ),
        (
            "wall-velocity-differs",
            [ANY; 4],
            "nodes on the wall do not have the velocity of the wall at the time of the step, or \
             their accelerations are not its change during the step",
        ),
    ],
    look_at: "nodes on a face with the condition `velocity`: their velocity is the value at the \
              time of the step (all components), and the velocity change of particles is \
              interpolated from the change of this value; walls are applied after all loads",
};

/// Returns component `i` of the velocity of the wall (m/s), at high ends at the end of the run.
fn wall_velocity(scene: &BoxScene, (axis, high): (usize, bool), i: usize) -> f64 {
    let sign = if high && i == axis { -1.0 } else { 1.0 };
    sign * SHARES[(i + scene.dimension - axis) % scene.dimension] * scene.wave_speed()
}

fn pushed(kind: Kind, axis: usize, high: bool) -> BoxScene {
    let mut scene = bar(kind, axis, "fixed");
    scene.faces.clear();
    if high {
        scene.grid.0[axis] -= 4.0 * H;
    } else {
        scene.grid.1[axis] += 4.0 * H;
    }
    let growth = if high { format!("*t/{:e}", scene.end()) } else { String::new() };
    let value = |i| format!("({:e}){growth}", wall_velocity(&scene, (axis, high), i));
    let values: Vec<String> = (0..kind.0).map(value).collect();
    let face = FACES[axis][usize::from(high)];
    scene.extras.walls.push((face, format!("{{velocity: {values:?}}}")));
    scene
}

fn measure(scene: &BoxScene, course: &Course, end: (usize, bool)) -> Row<4> {
    let (axis, high) = end;
    let length = scene.body.1[axis] - scene.body.0[axis];
    let gained = |k| length * course.mean(velocity, k)[axis];
    let gained: Vec<f64> = (0..=course.last()).map(gained).collect();
    let [_, rate] = constant_and_rate(&course.times, &gained);
    let slope = if high { rate * scene.end() } else { line(&course.times, &gained).1 };
    let force = slope / (scene.wave_speed() * wall_velocity(scene, end, axis));
    let at_wall = |i: usize| {
        let wall = if high { scene.body.1[axis] } else { scene.body.0[axis] };
        let points = course.points(displacement, course.last());
        let near = points.map(|(label, u)| ((label[axis] - wall).abs(), u[i]));
        let (depths, moved): (Vec<f64>, Vec<f64>) = near.filter(|(x, _)| *x <= 2.0 * H).unzip();
        let way = wall_velocity(scene, end, i) * scene.end() * if high { 0.5 } else { 1.0 };
        line(&depths, &moved).0 / way
    };
    let along = (scene.dimension > 1).then(|| at_wall((axis + 1) % scene.dimension));
    let (start, growth) = if high { (None, Some(force)) } else { (Some(force), None) };
    (FACES[axis][usize::from(high)].to_owned(), [start, growth, Some(at_wall(axis)), along])
}

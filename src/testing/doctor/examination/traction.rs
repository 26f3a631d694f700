//! Examination of tractions on the faces of a free body.
//!
//! Without walls, the momentum of a body grows by `P = A int p dt` in every scheme that conserves
//! momentum. Tractions on low faces are constant. Tractions on high faces are `p (1 + t/T)` with
//! the run time T, times `3 (Y - Y0)^2/w^2` with the mean 1 along the width w of the face.

use super::stress::{constant_and_rate, judge_ends};
use crate::testing::doctor::prelude::*;

pub(super) const EXAMINATION: Examination = Examination {
    name: "traction",
    expected: "a free body gains the momentum p A t under a traction p on a face of area A",
    after: &["translation", "transfer", "stress"],
    covers: &["loads: traction"],
    examine: |patient| judge_ends(patient, &[2, 3, 1], &RULES, loaded, measure),
};

/// Traction along the normal and along the tangents, relative to Young's modulus.
const SHARES: [f64; 3] = [1e-4, -0.7e-4, 0.4e-4];

const CELLS: f64 = 4.0;

/// The momentum of all particles or nodes is exact; the sum over a sample has an error.
const RULES: Rules<4> = Rules {
    quantities: [
        ("force along the normal", 1.0, 0.1),
        ("along the face", 1.0, 0.1),
        ("growth with time", 1.0, 0.3),
        ("share of the momentum in the half next to the face", 1.0, 0.5),
    ],
    findings: &[
        ("traction-missing", [0.0, 0.0, 0.0, ANY], "the traction has no effect"),
        (
            "traction-on-another-face",
            [ANY, ANY, ANY, 0.0],
            "the traction acts at the wrong end of the body",
        ),
        (
            "traction-of-one-time",
            [1.0, 1.0, 0.0, ANY],
            "a traction that varies in time keeps the value of the start",
        ),
        (
            "traction-along-normal-only",
            [1.0, 0.0, ANY, ANY],
            "only the component along the normal is applied",
        ),
        ("traction-halved", [0.5, 0.5, 0.5, ANY], "half the force is applied"),
        ("traction-doubled", [2.0, 2.0, 2.0, ANY], "the force is applied twice"),
        ("traction-sign", [-1.0, -1.0, -1.0, ANY], "the force has a wrong sign"),
        (
            "traction-differs",
            [ANY; 4],
            "the force is not the integral of the traction over the face: another factor (density, \
             cell size), or, on high faces only, values of another place or time",
        ),
    ],
    look_at: "the force of a traction: the traction (Pa) at places on the face and at the time of \
              the step, times reference area, distributed to nodes with weights that sum to one; \
              all components, and `face` of the load",
};

/// Returns component `i` of the traction (Pa) at the start.
fn traction(scene: &BoxScene, axis: usize, i: usize) -> f64 {
    scene.young * SHARES[(i + scene.dimension - axis) % scene.dimension]
}

fn loaded(kind: Kind, axis: usize, high: bool) -> BoxScene {
    let scene = BoxScene::of_cells(kind, [0.75, 0.25, 0.5], CELLS, 2.0);
    let mut scene = BoxScene { young: 3.1, ..scene }.with_waves(3.0 * CELLS, 48);
    let other = (axis + 1) % kind.0;
    let (label, low) = (["X", "Y", "Z"][other], scene.body.0[other]);
    let factor = match (high, kind.0) {
        (false, _) => String::new(),
        (true, 1) => format!("*(1 + t/{:e})", scene.end()),
        _ => format!("*(1 + t/{:e})*3*(({label} - {low})/{})^2", scene.end(), CELLS * H),
    };
    let values = (0..kind.0).map(|i| format!("({:e}){factor}", traction(&scene, axis, i)));
    let (values, face) = (values.collect::<Vec<_>>(), FACES[axis][usize::from(high)]);
    scene.extras.loads.push(format!("traction: {{on: {face}, value: {values:?}, at: surface}}"));
    scene
}

fn measure(scene: &BoxScene, course: &Course, (axis, high): (usize, bool)) -> Row<4> {
    let factors = |i: usize| {
        let impulse = |k| scene.density * CELLS * H * course.mean(velocity, k)[i];
        let impulses: Vec<f64> = (0..=course.last()).map(impulse).collect();
        let [constant, rate] = constant_and_rate(&course.times, &impulses);
        [constant, rate * scene.end()].map(|force| force / traction(scene, axis, i))
    };
    let [normal, growth] = factors(axis);
    // Waves cross 3/8 of the body in an eighth of the run.
    let mut half = scene.body.clone();
    let inner = if high { &mut half.0 } else { &mut half.1 };
    inner[axis] = scene.centre()[axis];
    let early = course.last() / 8;
    let near =
        0.5 * course.within(&half).mean(velocity, early)[axis] / course.mean(velocity, early)[axis];
    let along = (scene.dimension > 1).then(|| factors((axis + 1) % scene.dimension)[0]);
    let face = FACES[axis][usize::from(high)].to_owned();
    (face, [Some(normal), along, high.then_some(growth), Some(near)])
}

//! Examination of a rigid body that crosses several cells at constant speed.

use crate::testing::doctor::motion::uniform;
use crate::testing::doctor::prelude::*;

pub(super) const EXAMINATION: Examination = Examination {
    name: "translation",
    expected: "a body without stress moves at constant velocity through four cells, with x = X + v \
               t to rounding",
    after: &["rest", "initial-velocity"],
    covers: &[],
    examine,
};

/// Velocity (m/s). The body moves to coordinates above 1 and below 0.
pub(super) const VELOCITY: [f64; 3] = [0.25, -0.15625, 0.125];

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = patient.able(&[2, 3, 1], &ANY_LAW, &|kind| {
        // Particles stay away from cell faces, even if the solver is half a step ahead.
        let from = [0.375 + 0.1125 * H, 0.125 + 0.101_562_5 * H, 0.5 + 0.106_25 * H];
        let mut scene = BoxScene::of_cells(kind, from, 4.0, 7.0);
        scene.velocity = scene.uniform(VELOCITY);
        BoxScene { steps: 80, dt: 0.025, ..scene }
    })?;
    uniform(patient, &scene)
}

//! Examination of a free vibrating body, whose energy must not grow.
//!
//! A body that starts with a uniform stretch rate vibrates for two periods. Its kinetic energy
//! hardly exceeds its initial value in schemes that compute the strain from the updated velocities
//! (USL, MUSL), or the forces from the updated stress (USF). In forward Euler, each step multiplies
//! the amplitude of a mode with the angular frequency w by `sqrt(1 + w^2 dt^2)`.

use crate::testing::doctor::prelude::*;

pub(super) const EXAMINATION: Examination = Examination {
    name: "vibration",
    expected: "the kinetic energy of a free vibrating body is at most 1.3 times its initial value",
    after: &["translation", "force", "transfer", "stress"],
    covers: &[],
    examine,
};

const CELLS: f64 = 6.0;

/// Number of periods of the lowest mode. In one period, a wave travels to the other end and back.
const PERIODS: f64 = 2.0;

/// Distance that waves travel per step (cells).
const COURANT: f64 = 0.3;

/// Stretch rate (1/s). Strains stay below 1e-4.
const RATE: f64 = 1e-5;

/// Maximum kinetic energy, relative to its initial value.
const MOST: f64 = 1.3;

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = patient.able(&[1, 2, 3], &ELASTIC, &scene)?;
    let course = patient.run(&scene)?;
    let start = kinetic_energy(&course, 0);
    let most = (1..=course.last()).map(|k| kinetic_energy(&course, k) / start);
    let most = most.fold(0.0, |a, b| if b.is_nan() { f64::INFINITY } else { f64::max(a, b) });
    let (last, steps, energy) = (course.last(), scene.steps, shown(most));
    let mut measured = format!(
        "in {last} of {steps} steps, the kinetic energy is at most {energy} times its initial value"
    );
    if let Some(failure) = &course.failure {
        measured.push_str(&format!("; then the run failed: {failure}"));
    }
    let is_kept = course.failure.is_none() && most <= MOST;
    let finding = (!is_kept).then(|| {
        SolverFinding::defect(
            "vibration-grows",
            measured.clone(),
            "vibrations gain energy. One possible cause is forward Euler: strains are updated with \
             the velocity before the forces act, and forces are computed from the stress before \
             this update",
            "the velocity in the strain update: USL and MUSL use the velocity after the forces \
             act. USF uses the velocity before the forces act, and then computes the forces from \
             the new stress",
        )
    });
    Ok(Examined::new(measured, finding))
}

fn scene(kind: Kind) -> BoxScene {
    // The faces of the body are in the middle of cells. On nodes, domains of GIMP would reach the
    // next nodes with a tiny weight while the body vibrates, where USL is unstable.
    let from = [0.75, 0.25, 0.5].map(|x| x + 0.5 * H);
    let mut scene = BoxScene::of_cells(kind, from, CELLS, 2.0);
    scene.velocity = scene.slope((0, 0), RATE);
    scene.young = 3.1;
    let travel = 2.0 * PERIODS * CELLS;
    scene.with_waves(travel, libm::ceil(travel / COURANT) as u64)
}

/// Returns the kinetic energy divided by density in state `k` (m5/s2 in 3-D).
fn kinetic_energy(course: &Course, k: usize) -> f64 {
    let weights = course.states[0].weight.iter();
    weights.zip(course.points(velocity, k)).map(|(weight, (_, v))| 0.5 * weight * v.dot(&v)).sum()
}

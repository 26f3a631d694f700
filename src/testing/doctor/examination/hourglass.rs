//! Examination of a velocity that alternates from node to node.
//!
//! Square elements with one quadrature point in their middle have no strain in the motion
//! `cos(pi X/h) cos(pi Y/h)` (Flanagan & Belytschko 1981, IJNME 17): its nodes move apart with a
//! constant velocity, and no stress returns them. Every other quadrature resists, so that the
//! displacement in this mode stays far below `v t`. Particles move with an interpolated nodal
//! velocity that has a small share of the mode, so their displacement is small too, also if the
//! rest of the mode stays in the velocities (the null space of the transfer).

use crate::testing::doctor::prelude::*;

pub(super) const EXAMINATION: Examination = Examination {
    name: "hourglass",
    expected: "a velocity that alternates from node to node is resisted: its displacement stays \
               far below velocity times time",
    after: &["translation", "fall", "transfer", "stress", "walls"],
    covers: &[],
    examine,
};

/// Amplitude of the velocity, relative to the wave speed.
const SPEED: f64 = 1e-4;

const RULES: Rules<1> = Rules {
    quantities: [("displacement divided by velocity times time", 0.0, 0.4)],
    findings: &[(
        "hourglass-mode",
        [ANY],
        "no stress resists the alternating mode: square or hexahedral elements with one quadrature \
         point and without hourglass control, or particles that move with a share of their own \
         velocity, from which the grid never receives this mode",
    )],
    look_at: "the quadrature of elements: full integration, or a force that resists hourglass \
              modes; stresses or strains that are averaged over the points of a cell; the velocity in \
              the update of positions",
};

fn scene(kind: Kind) -> BoxScene {
    let scene = BoxScene::of_cells(kind, [0.75, 0.25, 0.5], 6.0, 2.0);
    let mut scene = BoxScene { young: 3.1, ..scene }.with_waves(10.0, 40);
    let speed = SPEED * scene.wave_speed();
    let wave = |i: usize| {
        let label = ["X", "Y"][i];
        format!("cos({}*({label} - {}))", std::f64::consts::PI / H, scene.body.0[i])
    };
    let mut velocity = vec!["0".to_owned(); kind.0];
    velocity[0] = format!("{speed:e}*{}*{}", wave(0), wave(1));
    scene.extras.velocity = Some(velocity);
    scene
}

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = patient.able(&[2, 3], &ELASTIC, &scene)?;
    let course = patient.run(&scene)?;
    let Some(share) = share(&scene, &course) else {
        return Err(Hindrance::Lacks(
            "points at which the alternating mode is not zero".to_owned(),
        ));
    };
    Ok(RULES.judge(&[("alternating mode".to_owned(), [Some(share)])]))
}

/// Returns the amplitude of the mode relative to `v t`; `None` if the mode is zero at all points.
fn share(scene: &BoxScene, course: &Course) -> Option<f64> {
    let mode = |label: Vector3<f64>| {
        let phase = |i: usize| std::f64::consts::PI / H * (label[i] - scene.body.0[i]);
        libm::cos(phase(0)) * libm::cos(phase(1))
    };
    let (mut product, mut square, mut volume) = (0.0, 0.0, 0.0);
    for ((label, u), weight) in
        course.points(displacement, course.last()).zip(&course.states[0].weight)
    {
        product += weight * mode(label) * u[0];
        square += weight * mode(label) * mode(label);
        volume += weight;
    }
    let way = SPEED * scene.wave_speed() * scene.end();
    (square > 0.01 * volume).then(|| product / (square * way))
}

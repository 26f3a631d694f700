//! Examinations of a body that fills a periodic axis: rigid motion, and ends under pressure.

use super::translation::VELOCITY;
use crate::testing::doctor::motion::{CHANGED, uniform};
use crate::testing::doctor::prelude::*;

pub(super) const EXAMINATION: Examination = Examination {
    name: "periodic",
    expected: "a body that fills a periodic axis moves along this axis at constant velocity, and \
               its displacements are not wrapped",
    after: &["translation", "stress"],
    covers: &["conditions: periodic"],
    examine,
};

pub(super) const ENDS: Examination = Examination {
    name: "periodic-ends",
    expected: "if the two ends of a periodic axis move towards each other, they stop each other",
    after: &["translation", "force", "transfer", "periodic", "stress", "walls", "hourglass"],
    covers: &["conditions: periodic"],
    examine: examine_ends,
};

/// Length (cells) of a moving body along the periodic axis.
const CELLS: f64 = 4.0;
/// Length (cells) along the periodic axis of a body whose ends press against each other.
const LONG: f64 = 12.0;

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let first = patient.able(&[2, 1, 3], &ANY_LAW, &|kind| along(kind, 0))?;
    let mut all = Examined::default();
    for axis in 0..first.dimension {
        let examined = one_axis(patient, &along((first.dimension, first.law), axis), axis)?;
        let measured = if axis == 0 { examined.measured } else { String::new() };
        all.add(Examined::new(measured, examined.findings));
    }
    Ok(all)
}

fn along(kind: Kind, axis: usize) -> BoxScene {
    let mut scene = BoxScene::of_cells(kind, [0.25; 3], CELLS, 3.0);
    scene.grid.0[axis] = scene.body.0[axis];
    scene.grid.1[axis] = scene.body.1[axis];
    scene.velocity = AffineField::along(axis, VELOCITY[0]);
    scene.faces = FACES[axis].map(|face| (face, "periodic")).to_vec();
    BoxScene { steps: 60, dt: 0.025, ..scene }
}

fn examine_ends(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let first = patient.able(&[2, 1, 3], &ELASTIC, &|kind| along(kind, 0))?;
    let mut all = Examined::default();
    for axis in 0..first.dimension {
        let lost = lost_at_ends(patient, (first.dimension, first.law), axis)?;
        all.measured = format!(
            "one half of the body transfers {} of its momentum across the periodic ends",
            shown(lost)
        );
        if !(lost >= 0.4) {
            let seen = format!("{}, expected about 0.9", all.measured);
            all.findings.push(not_closed(axis, &seen));
            break;
        }
    }
    Ok(all)
}

/// Returns the share of momentum that the upper half of a body loses across the ends of a periodic
/// axis. The initial velocity increases along the axis, so the ends collide.
fn lost_at_ends(patient: &Patient<'_>, kind: Kind, axis: usize) -> Result<f64, Hindrance> {
    let mut scene = BoxScene::of_cells(kind, [0.25; 3], CELLS, 3.0);
    scene.body.1[axis] = scene.body.0[axis] + LONG * H;
    scene.grid.0[axis] = scene.body.0[axis];
    scene.grid.1[axis] = scene.body.1[axis];
    (scene.young, scene.poisson) = (3.1, 0.0);
    scene.faces = FACES[axis].map(|face| (face, "periodic")).to_vec();
    scene.velocity = scene.slope((axis, axis), 1e-3);
    let scene = scene.with_waves(2.5, 10);
    let course = patient.run(&scene)?;
    let momentum = |k: usize| -> f64 {
        let all = course.points(velocity, k).zip(&course.states[0].weight);
        let upper = all.filter(|((label, _), _)| label[axis] > scene.centre()[axis]);
        upper.map(|((_, v), weight)| weight * v[axis]).sum()
    };
    Ok(1.0 - momentum(course.last()) / momentum(0))
}

fn one_axis(patient: &Patient<'_>, scene: &BoxScene, axis: usize) -> Result<Examined, Hindrance> {
    let examined = uniform(patient, scene)?;
    let first = examined.findings.first().filter(|finding| finding.name != CHANGED);
    let Some(first) = first else { return Ok(examined) };
    let course = patient.run(scene)?;
    let (last, period) = (course.last(), CELLS * H);
    let distance = VELOCITY[0] * course.times[last];
    let wrapped = course.points(displacement, last).any(|(_, u)| {
        let periods = (distance - u[axis]) / period;
        libm::round(periods) != 0.0 && (periods - libm::round(periods)).abs() <= 1e-3
    });
    let name = ["x", "y", "z"][axis];
    let finding = if wrapped {
        SolverFinding::defect(
            "displacements-wrapped",
            format!(
                "along {name}, some displacements differ from the distance of {distance} m by \
                 multiples of the period of {period} m"
            ),
            "positions are wrapped into the period, and displacements are computed from wrapped \
             positions",
            "the displacements in the answer to `advance`, which must keep growing: store \
             displacements separately, or count periods",
        )
    } else {
        not_closed(axis, &first.seen)
    };
    Ok(Examined::new(examined.measured, vec![finding]))
}

fn not_closed(axis: usize, seen: &str) -> SolverFinding {
    SolverFinding::defect(
        "periodic-axis",
        format!("along {}: {seen}", ["x", "y", "z"][axis]),
        "the two ends of a periodic axis are not treated as the same position",
        "node indices, which are taken modulo the number of cells N (not of nodes): node N is node \
         0 in every sum, and for every basis function that reaches across the end",
    )
}

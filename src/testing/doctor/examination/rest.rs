//! Examination of a body at rest without stress and loads, which must not move.

use crate::subject::Precision;
use crate::testing::doctor::motion::single;
use crate::testing::doctor::prelude::*;

pub(super) const EXAMINATION: Examination = Examination {
    name: "rest",
    expected: "a body at rest, without stress and loads, does not move",
    after: &["conversation"],
    covers: &[],
    examine,
};

/// Maximum deviation from the mean motion of a body that moves as a whole, over the largest motion.
const AS_ONE: f64 = 0.02;

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = patient.able(&[2, 3, 1], &ANY_LAW, &|kind| {
        let scene = BoxScene::of_cells(kind, [0.2625, 0.3875, 0.1375], 4.0, 4.0);
        BoxScene { young: 3.0, steps: 20, dt: 0.01, ..scene }
    })?;
    let course = patient.run(&scene)?;
    let last = course.last();
    let way = course.farthest(displacement, last, [0.0; 3]) / H;
    let speed = course.farthest(velocity, last, [0.0; 3]) / scene.wave_speed();
    let [largest, fastest] = [way, speed].map(shown);
    let measured = format!(
        "after {last} steps, the largest displacement is {largest} cells and the largest speed is \
         {fastest} of the wave speed"
    );
    let tolerance = patient.rounding();
    if way <= tolerance && speed <= tolerance {
        complete(course)?;
        return Ok(Examined::new(measured, None));
    }
    let claims_double = patient.solver.precision() == Precision::Double;
    // Smaller motions are rounding errors; an acceleration moves the body farther in one step.
    let is_noise = claims_double && way.max(speed) <= 1e-5;
    let finding = if is_noise { single(way, speed) } else { cause(&course) };
    Ok(Examined::new(measured, Some(finding)))
}

fn cause(course: &Course) -> SolverFinding {
    let (last, d) = (course.last(), course.problem.dimension);
    let (u, v) = (course.mean(displacement, last), course.mean(velocity, last));
    let is_of_all = |field, mean| {
        course.farthest(field, last, mean) <= AS_ONE * course.farthest(field, last, [0.0; 3])
    };
    let [mean_u, mean_v] = [u, v].map(|mean| shown_vector(mean, d));
    if course.points(displacement, last).all(|(label, u)| (u - label).norm() <= 1e-3 * H) {
        return SolverFinding::defect(
            "positions-for-displacements",
            format!("the mean of the column `displacement` is {mean_u} for a body at rest"),
            "the column contains positions instead of displacements",
            "the displacements in the answer to `advance`: position minus `reference_position`",
        );
    }
    if !(is_of_all(displacement, u) && is_of_all(velocity, v)) {
        return apart(course);
    }
    let t = &course.times[1..];
    let speeds: Vec<f64> =
        (1..=last).map(|k| course.mean(velocity, k).dot(&v) / v.norm()).collect();
    let (_, slope, off) = line(t, &speeds);
    if v.norm() > 0.0 && off <= AS_ONE * v.norm() && slope * course.times[last] >= 0.5 * v.norm() {
        let (end, g) = (shown(course.times[last]), shown_vector(slope / v.norm() * v, d));
        return SolverFinding::defect(
            "gravity-left-on",
            format!(
                "the whole body has the velocity {mean_v} m/s after {end} s, an acceleration of {g} \
                 m/s2"
            ),
            "the solver applies gravity or another uniform acceleration that is not in the problem",
            "the default gravity of the solver: in this problem `loads` is empty and `body_force` \
             is \"none\", so the acceleration must be zero",
        );
    }
    if v.norm() * course.times[last] >= 0.5 * u.norm() {
        return SolverFinding::defect(
            "velocity-of-its-own",
            format!("the whole body has the velocity {mean_v} m/s, expected zero"),
            "the body starts with a velocity that is not in the problem",
            "the initial velocity: `particles.velocity` of this problem is zero",
        );
    }
    SolverFinding::defect(
        "displaced-from-the-start",
        format!("from the start on, the whole body is displaced by {mean_u} m and does not move"),
        "displacements are not measured from `reference_position`, or particles are moved during \
         initialisation",
        "the origin of the grid; an offset between the coordinates of the solver and those of the \
         problem; the initial positions of particles",
    )
}

fn apart(course: &Course) -> SolverFinding {
    let (last, d) = (course.last(), course.problem.dimension);
    let labels = course.points(displacement, last).map(|(label, _)| label);
    let centre = labels.sum::<Vector3<f64>>() * (1.0 / course.states[last].len() as f64);
    let outward: f64 =
        course.points(velocity, last).map(|(label, v)| v.dot(&(label - centre))).sum();
    let speed = shown(course.farthest(velocity, last, [0.0; 3]));
    let (side, mean) = (
        if outward > 0.0 { "outwards" } else { "inwards" },
        shown_vector(course.mean(velocity, last), d),
    );
    SolverFinding::defect(
        "stress-at-rest",
        format!(
            "points move with up to {speed} m/s, mostly {side} relative to the centre of the body, \
             and with {mean} m/s on average"
        ),
        "particles start with a stress or deformation that is not in the problem, or surface \
         tension, friction or a wall acts on the body",
        "the initial F (identity), stress (zero) and volume; volumes that are computed as h^D \
         divided by the particles per cell instead of read from the problem; a pressure that is \
         not zero at det F = 1",
    )
}

//! Examination of a body at rest without stress and loads, which must not move.

use crate::subject::Precision;
use crate::testing::doctor::course::{
    Course, displacement, dot, line, minus, shown, shown_vector, size, times, velocity,
};
use crate::testing::doctor::finding::SolverFinding;
use crate::testing::doctor::motion::single;
use crate::testing::doctor::patient::{Examination, Examined, Hindrance, Patient};
use crate::testing::doctor::scene::{ANY_LAW, BoxScene, H};

pub(super) const EXAMINATION: Examination = Examination {
    name: "rest",
    expected: "a body at rest, without stress and loads, does not move",
    after: &["conversation"],
    covers: &[],
    examine,
};

/// The body counts as moving as a whole if points deviate from the mean motion by at most this
/// share of the largest motion.
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
    let measured = format!(
        "after {last} steps, the largest displacement is {} cells and the largest speed is {} of \
         the wave speed",
        shown(way),
        shown(speed)
    );
    let tolerance = patient.rounding();
    let mut findings = Vec::new();
    if !(way <= tolerance && speed <= tolerance) {
        let claims_double = patient.solver.precision() == Precision::Double;
        // Smaller motions are rounding errors of single precision, because an acceleration due to a
        // defect causes far larger motion in one step.
        let is_noise = claims_double && way.max(speed) <= 1e-5;
        findings.push(if is_noise { single(way, speed) } else { cause(&course) });
    } else if let Some(failure) = &course.failure {
        return Err(Hindrance::Broke(failure.clone()));
    }
    Ok(Examined::new(measured, findings))
}

fn cause(course: &Course) -> SolverFinding {
    let (last, d) = (course.last(), course.problem.dimension);
    let (u, v) = (course.mean(displacement, last), course.mean(velocity, last));
    let spread = |field, mean| course.farthest(field, last, mean);
    let reach = |field| course.farthest(field, last, [0.0; 3]);
    let are_positions =
        course.points(displacement, last).all(|(label, u)| size(minus(u, label)) <= 1e-3 * H);
    if are_positions {
        return SolverFinding::defect(
            "positions-for-displacements",
            format!(
                "the mean of the column `displacement` is {} for a body at rest",
                shown_vector(u, d)
            ),
            "the column contains positions instead of displacements",
            "the displacements in the answer to `advance`: position minus `reference_position`",
        );
    }
    let as_one = spread(displacement, u) <= AS_ONE * reach(displacement)
        && spread(velocity, v) <= AS_ONE * reach(velocity);
    if !as_one {
        return apart(course);
    }
    let t = &course.times[1..];
    let speeds: Vec<f64> = (1..=last).map(|k| dot(course.mean(velocity, k), v) / size(v)).collect();
    let (_, slope, off) = line(t, &speeds);
    if size(v) > 0.0 && off <= AS_ONE * size(v) && slope * course.times[last] >= 0.5 * size(v) {
        let g = times(slope / size(v), v);
        let seen = format!(
            "the whole body has the velocity {} m/s after {} s, an acceleration of {} m/s2",
            shown_vector(v, d),
            shown(course.times[last]),
            shown_vector(g, d)
        );
        return SolverFinding::defect(
            "gravity-left-on",
            seen,
            "the solver applies gravity or another uniform acceleration that is not in the problem",
            "the default gravity of the solver: in this problem `loads` is empty and `body_force` \
             is \"none\", so the acceleration must be zero",
        );
    }
    if size(v) * course.times[last] >= 0.5 * size(u) {
        let seen =
            format!("the whole body has the velocity {} m/s, expected zero", shown_vector(v, d));
        return SolverFinding::defect(
            "velocity-of-its-own",
            seen,
            "the body starts with a velocity that is not in the problem",
            "the initial velocity: `particles.velocity` of this problem is zero",
        );
    }
    SolverFinding::defect(
        "displaced-from-the-start",
        format!(
            "from the start on, the whole body is displaced by {} m and does not move",
            shown_vector(u, d)
        ),
        "displacements are not measured from `reference_position`, or particles are moved during \
         initialisation",
        "the origin of the grid; an offset between the coordinates of the solver and those of the \
         problem; the initial positions of particles",
    )
}

fn apart(course: &Course) -> SolverFinding {
    let (last, d) = (course.last(), course.problem.dimension);
    let centre = {
        let labels = course.points(displacement, last).map(|(label, _)| label);
        let sum = labels.fold([0.0; 3], |sum, x| std::array::from_fn(|i| sum[i] + x[i]));
        times(1.0 / course.states[last].len() as f64, sum)
    };
    let outward: f64 =
        course.points(velocity, last).map(|(label, v)| dot(v, minus(label, centre))).sum();
    let speed = course.farthest(velocity, last, [0.0; 3]);
    let seen = format!(
        "points move with up to {} m/s, mostly {} relative to the centre of the body, and with {} \
         m/s on average",
        shown(speed),
        if outward > 0.0 { "outwards" } else { "inwards" },
        shown_vector(course.mean(velocity, last), d)
    );
    SolverFinding::defect(
        "stress-at-rest",
        seen,
        "particles start with a stress or deformation that is not in the problem, or surface \
         tension, friction or a wall acts on the body",
        "the initial F (identity), stress (zero) and volume; volumes that are computed as h^D \
         divided by the particles per cell instead of read from the problem; a pressure that is \
         not zero at det F = 1",
    )
}

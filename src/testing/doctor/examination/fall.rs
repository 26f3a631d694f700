//! Examination of a body in free fall.

use crate::subject::Precision;
use crate::testing::doctor::course::{
    Course, displacement, line, minus, shown, shown_vector, size, times, velocity,
};
use crate::testing::doctor::finding::{FindingWeight, SolverFinding};
use crate::testing::doctor::motion::single;
use crate::testing::doctor::patient::{Examination, Examined, Hindrance, Patient};
use crate::testing::doctor::scene::{ANY, BoxScene};

pub(super) const EXAMINATION: Examination = Examination {
    name: "fall",
    expected: "a body without stress falls with the velocity v = g t, exact in any scheme, and the \
               displacement u = g t^2/2",
    after: &["conversation", "rest", "translation"],
    covers: &["loads: gravity"],
    examine,
};

/// Gravity (m/s2). The value differs from 9.81, because a solver may use 9.81 by default.
const GRAVITY: f64 = 3.7;

/// Maximum relative difference between a measured value and the value that a suspected cause
/// predicts.
const NEAR: f64 = 0.02;

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = patient.able(&[2, 3, 1], &ANY, &|kind| {
        let mut scene = BoxScene::of_cells(kind, [0.2625, 0.3875, 0.1375], 4.0, 6.0);
        let mut gravity = vec![0.0; kind.0];
        gravity[kind.0 - 1] = -GRAVITY;
        scene.gravity = Some(gravity);
        BoxScene { steps: 40, dt: 0.01, ..scene }
    })?;
    let course = patient.run(&scene)?;
    let mut g = [0.0; 3];
    g[scene.dimension - 1] = -GRAVITY;
    let (last, d) = (course.last(), scene.dimension);
    let end = course.times[last];
    let (v, u) = (course.mean(velocity, last), course.mean(displacement, last));
    let measured = format!(
        "after {last} steps, v = {} m/s and u = {} m; expected v = {} m/s and u = {} m",
        shown_vector(v, d),
        shown_vector(u, d),
        shown_vector(times(end, g), d),
        shown_vector(times(0.5 * end * end, g), d)
    );
    let mut findings: Vec<SolverFinding> = of_speed(patient, &course, g).into_iter().collect();
    // Positions are examined only if the velocities have no defect, because wrong velocities cause
    // wrong positions.
    if findings.iter().all(|finding| finding.weight == FindingWeight::Remark) {
        findings.extend(of_distance(patient, &course, g));
    }
    if findings.is_empty()
        && let Some(failure) = course.failure
    {
        return Err(Hindrance::Broke(failure));
    }
    Ok(Examined::new(measured, findings))
}

/// Returns a finding if the velocities differ from g t.
fn of_speed(patient: &Patient<'_>, course: &Course, g: [f64; 3]) -> Option<SolverFinding> {
    let (last, d) = (course.last(), course.problem.dimension);
    let end = course.times[last];
    let off = |k: usize| course.farthest(velocity, k, times(course.times[k], g));
    let most = (1..=last).map(off).fold(0.0, f64::max) / (GRAVITY * end);
    if most <= patient.rounding() {
        return None;
    }
    if patient.solver.precision() == Precision::Double && most <= 1e-5 {
        return Some(single(0.0, most));
    }
    let v = course.mean(velocity, last);
    let spread = course.farthest(velocity, last, v) / (GRAVITY * end);
    if spread > NEAR && spread > NEAR * most {
        return Some(SolverFinding::defect(
            "force-uneven",
            format!(
                "the velocities of points differ from their mean by up to {} of g t",
                shown(spread)
            ),
            "nodal body forces are not computed with the weights of the nodal masses",
            "the sums for nodal mass and nodal body force, which must use the same weights; walls \
             or contact that are not in the problem",
        ));
    }
    let axis = d - 1;
    let along: Vec<f64> = (1..=last).map(|k| course.mean(velocity, k)[axis]).collect();
    let (start, slope, _) = line(&course.times[1..], &along);
    let factor = slope / g[axis];
    let across = size(minus(v, std::array::from_fn(|i| if i == axis { v[i] } else { 0.0 })));
    if across > NEAR * GRAVITY * end {
        return Some(SolverFinding::defect(
            "gravity-along-another-axis",
            format!("the body falls in the direction {}", shown_vector(times(1.0 / size(v), v), d)),
            "gravity acts along a different axis than in the problem",
            "the order of axes: `body_force_value` has its components in the order x, y, z",
        ));
    }
    if (factor - 1.0).abs() > 1e-3 {
        let seen =
            format!("the acceleration is {} times the gravity of the problem", shown(factor));
        let (name, cause) = factor_cause(factor, course);
        return Some(SolverFinding::defect(
            name,
            seen,
            &cause,
            "the code that adds body forces: add mass times `body_force_value` (m/s2) to the nodal \
             force, once and with the sign of the problem",
        ));
    }
    let steps = start / (g[axis] * course.problem.dt);
    let seen = format!(
        "the measured velocity is v = g (t {}{} dt), expected v = g t",
        if steps < 0.0 { "- " } else { "+ " },
        shown(steps.abs())
    );
    Some(if (steps + 0.5).abs() <= NEAR {
        SolverFinding::remark(
            "velocity-half-a-step-behind",
            seen,
            "the scheme is a leapfrog: the reported velocities belong to a time half a step before \
             the reported positions",
            "the velocities in `state`. Suites that judge velocities will show order 1 in dt. The \
             mean of two successive velocities belongs to the time of the positions",
        )
    } else {
        SolverFinding::defect(
            "velocity-of-another-time",
            seen,
            "the reported velocities belong neither to the time after the step, nor to half a step \
             before this time as in a leapfrog",
            "the code before the first step: v(-dt/2) = v0 - a dt/2, not v0 + a dt/2; the number \
             of steps; the variable from which the answer takes velocities",
        )
    })
}

pub(super) fn factor_cause(factor: f64, course: &Course) -> (&'static str, String) {
    let density = course.problem.materials[0].density;
    let mass = course.problem.particles.mass.first().copied().unwrap_or(f64::NAN);
    let is = |wanted: f64| (factor / wanted - 1.0).abs() <= NEAR;
    if factor.abs() <= 1e-3 {
        return ("gravity-missing", "gravity or the body force has no effect".to_owned());
    }
    if is(-1.0) {
        return ("gravity-upwards", "gravity or the body force has the wrong sign".to_owned());
    }
    let h = course.problem.grid.h;
    let candidates = [
        (h, "the acceleration is multiplied by the cell size"),
        (1.0 / h, "the acceleration is divided by the cell size"),
        (
            2.0,
            "the acceleration is added twice (as gravity and as a body force, or in both halves of \
             a step)",
        ),
        (0.5, "the acceleration is added in one half of each step only"),
        (density, "the force per mass is multiplied by the density"),
        (1.0 / density, "the acceleration is divided by the density"),
        (mass, "the force per mass is multiplied by the particle mass twice"),
        (1.0 / mass, "the acceleration is divided by the mass of a particle"),
        (
            9.81 / GRAVITY,
            "the solver uses its own gravity of 9.81 m/s2 instead of the gravity of the problem",
        ),
        (
            1.0 + 9.81 / GRAVITY,
            "the solver adds its own gravity of 9.81 m/s2 to the gravity of the problem",
        ),
        (1e3, "a length is in mm instead of m"),
        (1e-3, "a length is in mm instead of m"),
    ];
    let known = candidates.into_iter().find(|(wanted, _)| is(*wanted));
    let cause =
        known.map_or("the acceleration is multiplied by an unknown factor", |(_, cause)| cause);
    ("gravity-scaled", cause.to_owned())
}

/// Returns a finding if the positions differ from g t^2/2 although the velocities are correct.
fn of_distance(patient: &Patient<'_>, course: &Course, g: [f64; 3]) -> Option<SolverFinding> {
    let (last, dt, axis) = (course.last(), course.problem.dt, course.problem.dimension - 1);
    let end = course.times[last];
    let off = course.mean(displacement, last)[axis] - 0.5 * g[axis] * end * end;
    let steps = off / (g[axis] * end * 0.5 * dt);
    if steps.abs() * dt / end <= patient.rounding() {
        return None;
    }
    let seen = format!(
        "the measured displacement is u = g t^2/2 {} {} g t dt/2, expected u = g t^2/2",
        if steps < 0.0 { "-" } else { "+" },
        shown(steps.abs())
    );
    let near = 0.1;
    Some(if (steps - 1.0).abs() <= near {
        SolverFinding::remark(
            "start-half-a-step-off",
            seen,
            "each step updates velocities first and then positions, but the run starts with the \
             velocity at t = 0 instead of -dt/2. The velocities that move particles are then too \
             large by a dt/2 (a: acceleration), which lowers the order in time by one",
            "the start of the run: subtract dt/2 times the initial acceleration from the velocity \
             before the first step. Suites then show the order in time of the scheme",
        )
    } else if (steps + 1.0).abs() <= near {
        SolverFinding::defect(
            "positions-before-velocities",
            seen,
            "positions are updated with the velocities before the step (forward Euler). This has \
             order 1 in time, and stresses make the energy grow",
            "the order of the updates: first velocities, then positions with the new velocities",
        )
    } else {
        SolverFinding::defect(
            "way-not-of-velocities",
            seen,
            "the reported positions do not follow from the reported velocities",
            "the velocity that moves particles, which must include gravity exactly once",
        )
    })
}

//! Examination of a body force that the solver requests for positions and times.

use super::fall::factor_cause;
use super::translation::VELOCITY;
use crate::external::{BodyForceField, LevelProblem};
use crate::testing::doctor::prelude::*;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

pub(super) const EXAMINATION: Examination = Examination {
    name: "force",
    expected: "the solver requests the body force at reference positions and at the time of each \
               step, and applies each value to the point for which it was requested",
    after: &["translation", "fall"],
    covers: &["loads: body_force", "manufactured"],
    examine,
};

/// Force per unit mass at the start (m/s2).
const FORCE: f64 = 0.8;
/// Growth rate of the force per unit mass (m/s3).
const RATE: f64 = 6.0;

/// Maximum relative difference between a measured value and the value that a cause predicts.
const NEAR: f64 = 0.1;

/// A request: its time (s) and reference position (m).
type Question = (f64, [f64; 3]);

type Questions = Arc<Mutex<Vec<Question>>>;

fn locked(asked: &Questions) -> MutexGuard<'_, Vec<Question>> {
    asked.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A force along the first axis as a function of position (m) and time (s).
type ForceAlong = fn(f64, f64) -> f64;

/// A body force that records the times and positions at which the solver requests it.
#[derive(Clone)]
struct AskedForce {
    asked: Questions,
    force: ForceAlong,
}

impl BodyForceField for AskedForce {
    fn at(&self, _: usize, label: &[f64], t: f64) -> [f64; 3] {
        let place = std::array::from_fn(|i| label.get(i).copied().unwrap_or_default());
        locked(&self.asked).push((t, place));
        [(self.force)(place[0], t), 0.0, 0.0]
    }
}

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let moving = patient.able_with(
        &[2, 3, 1],
        &ANY_LAW,
        &|kind| {
            let mut scene = BoxScene::of_cells(kind, [0.2625, 0.3875, 0.1375], 4.0, 6.0);
            scene.velocity = AffineField::uniform([VELOCITY[0], 0.0, 0.0]);
            BoxScene { steps: 20, dt: 0.02, ..scene }
        },
        &|needs| needs.manufactured = true,
    )?;
    let asked = Questions::default();
    let force: ForceAlong = |_, t| FORCE + RATE * t;
    let mut course = run(patient, &moving, &asked, true, force);
    // A request outside the body ends the run; a run without this check records all requests.
    if matches!(course, Err(Hindrance::Broke(_))) {
        course = run(patient, &moving, &asked, false, force).or(course);
    }
    // Wrong requests are reported as the cause of a failed run.
    let requests = other_times(&asked, &moving).or_else(|| places(&asked, &moving));
    let course = match (course, requests) {
        (Err(Hindrance::Broke(_)), Some(finding)) => {
            let measured = "nothing, because the run ended early".to_owned();
            return Ok(Examined::new(measured, Some(finding)));
        }
        (Err(other), _) => return Err(other),
        (Ok(course), None) => course,
        (Ok(_), Some(finding)) => {
            let measured = format!("{} values were requested", locked(&asked).len());
            return Ok(Examined::new(measured, Some(finding)));
        }
    };
    let mut found = of_time(&asked, &course);
    let resting = BoxScene { velocity: AffineField::default(), steps: 1, ..moving.clone() };
    if found.is_none() {
        let course = run(patient, &resting, &Questions::default(), true, |x, _| x / H)?;
        found = of_points(&course, resting.dt / H);
    }
    let (count, last) = (locked(&asked).len(), course.last());
    let gained = course.mean(velocity, last)[0] - VELOCITY[0];
    let [gained, wanted] = [gained, integral(course.times[last])].map(shown);
    let measured = format!(
        "{count} values were requested in {last} steps; the speed increases by {gained} m/s, \
         expected {wanted} m/s"
    );
    Ok(Examined::new(measured, found))
}

fn integral(t: f64) -> f64 {
    FORCE * t + 0.5 * RATE * t * t
}

pub(super) fn ramp(problem: &mut LevelProblem) {
    let force = AskedForce { asked: Questions::default(), force: |_, t| FORCE + RATE * t };
    problem.body_force = Some(Arc::new(force));
    problem.constant_body_force = None;
}

/// Runs `scene` with a force along the first axis. With `checks_places`, the problem has its
/// fields, so a request for a position outside the body is an error.
fn run(
    patient: &Patient<'_>,
    scene: &BoxScene,
    asked: &Questions,
    checks_places: bool,
    force: ForceAlong,
) -> Result<Course, Hindrance> {
    let mut problem = scene.problem()?;
    let force = AskedForce { asked: asked.clone(), force };
    problem.body_force = Some(Arc::new(force));
    if !checks_places {
        problem.fields = None;
    }
    complete(patient.run_problem(scene, problem)?)
}

fn other_times(asked: &Questions, scene: &BoxScene) -> Option<SolverFinding> {
    let (asked, end) = (locked(asked), scene.end());
    let times = asked.iter().map(|(t, _)| *t);
    let first = times.clone().fold(f64::INFINITY, f64::min);
    let last = times.fold(f64::NEG_INFINITY, f64::max);
    let is_inside = first >= -scene.dt && last <= end + scene.dt;
    let [first, last] = [first, last].map(shown);
    let finding = SolverFinding::defect(
        "force-of-another-time",
        format!("the requested times are {first} to {last} s, but the run is from 0 to {end} s"),
        "the force is requested at wrong times, for example at the step number instead of the time",
        "the time `t` of requests (s), which starts at `from` of `advance` and increases by `dt` \
         in each step",
    );
    (!(asked.is_empty() || is_inside)).then_some(finding)
}

fn places(asked: &Questions, scene: &BoxScene) -> Option<SolverFinding> {
    let asked = locked(asked);
    if asked.is_empty() {
        return Some(SolverFinding::defect(
            "force-not-asked",
            "the solver requested no value of the body force".to_owned(),
            "the solver states the capability `manufactured`, but does not request values",
            "the key `body_force` of the problem: if it is \"asked\", as here, the solver must \
             request values",
        ));
    }
    let (low, high) = (scene.body.0[0], scene.body.1[0]);
    let late = 0.5 * scene.end();
    let outside = asked.iter().filter(|(t, x)| *t > late && !(low..=high).contains(&x[0])).count();
    let last = asked.iter().map(|(t, _)| *t).fold(0.0, f64::max);
    let [late, way] = [late, VELOCITY[0] * last].map(shown);
    let finding = SolverFinding::defect(
        "force-at-present-positions",
        format!(
            "{outside} of the positions requested after {late} s are outside the initial body; the \
             body has moved by {way} m"
        ),
        "the force is requested at the current positions of particles instead of their reference \
         positions",
        "`reference_position` in requests: the reference position X of each particle, which does \
         not change. If a request omits this key, the reference positions of the particles are \
         used",
    );
    (outside > 0).then_some(finding)
}

fn of_time(asked: &Questions, course: &Course) -> Option<SolverFinding> {
    let (last, dt) = (course.last(), course.problem.dt);
    let end = course.times[last];
    let gained = |k: usize| course.mean(velocity, k)[0] - VELOCITY[0];
    let wanted = integral(end);
    let instants = &course.times[1..];
    // With velocities that lag by l steps and forces of a time s steps later, the error of the
    // speed is `-l dt F + (s - l) dt R t`.
    let errors: Vec<f64> = (1..=last).map(|k| gained(k) - integral(course.times[k])).collect();
    let (start, slope, off) = line(instants, &errors);
    let (lag, late) = (-start / (FORCE * dt), slope / (RATE * dt));
    let shift = late + lag;
    let is_shifted = off <= NEAR * RATE * end * dt;
    // Forces are constant in each step, or in shorter steps. Velocities lag by at most half a step.
    let is_scheme = (-NEAR..=0.5 + NEAR).contains(&lag);
    if is_shifted && is_scheme && (-0.5 - NEAR..=NEAR).contains(&shift) {
        return None;
    }
    let mut at: Vec<f64> = locked(asked).iter().map(|(t, _)| *t).collect();
    at.sort_by(f64::total_cmp);
    at.dedup();
    let count = at.len();
    let [speed, exact, first, end_of_requests] =
        [gained(last), wanted, at[0], at[count - 1]].map(shown);
    let seen = format!(
        "the speed of the body increases by {speed} m/s, expected {exact} m/s. The requested times \
         are {first} to {end_of_requests} s: {count} different times in {last} steps"
    );
    if is_shifted && (late - 0.5).abs() <= NEAR {
        return Some(SolverFinding::remark(
            "force-of-the-end-of-the-step",
            seen,
            "each step uses the body force at its end",
            "the time `t` of requests: an explicit step uses the force at its start. The force at \
             its end lowers the order in time by one",
        ));
    }
    if (gained(last) - FORCE * end).abs() <= 0.02 * wanted {
        return Some(SolverFinding::defect(
            "force-of-one-time",
            seen,
            "all steps use the force at the start of the run",
            "the time `t` of requests (s), which starts at `from` of `advance` and increases by \
             `dt` in each step. The force must be requested in each step",
        ));
    }
    if is_shifted && shift.abs() <= 3.5 {
        let side = if shift < 0.0 { "before" } else { "after" };
        return Some(SolverFinding::remark(
            "force-shifted-in-time",
            seen,
            &format!(
                "the force of each step belongs to a time about {} dt {side} the time of the \
                 velocities between which it acts",
                shown(0.1 * libm::round(10.0 * shift.abs()))
            ),
            "the time `t` of requests: a step from t - dt/2 to t + dt/2 (leapfrog) uses the force \
             at t. A shift lowers the order in time to one",
        ));
    }
    let expected: Vec<f64> = instants.iter().map(|t| integral(*t)).collect();
    let (_, slope, _) = line(&expected, &(1..=last).map(gained).collect::<Vec<f64>>());
    let (_, cause) = factor_cause(slope, course);
    let factor = format!("the force is multiplied by about {}: {cause}", shown(slope));
    let is_scaled = (slope - 1.0).abs() > 0.02;
    Some(SolverFinding::defect(
        "force-scaled",
        seen,
        if is_scaled { &factor } else { "the steps use forces of different times" },
        "the code that adds body forces: add mass times the received values (m/s2) to the nodal \
         force; the times of the requests",
    ))
}

/// Returns a finding if velocities after one step do not grow linearly with X, as the force does.
fn of_points(course: &Course, slope: f64) -> Option<SolverFinding> {
    let (mut x, mut v, mut across) = (Vec::new(), Vec::new(), 0.0_f64);
    for (label, speed) in course.points(velocity, 1) {
        x.push(label[0]);
        v.push(speed[0]);
        across = across.max((speed - speed[0] * Vector3::x()).norm());
    }
    let share = line(&x, &v).1 / slope;
    // The range is wide, because basis functions smooth a linear field near the edge of the body.
    let most = v.iter().map(|v| v.abs()).fold(0.0, f64::max);
    if (0.4..=1.3).contains(&share) && across <= 0.1 * most {
        return None;
    }
    let [share, across] = [share, across].map(shown);
    Some(SolverFinding::defect(
        "force-of-other-points",
        format!(
            "the body force increases linearly with X. After one step, the increase of the \
             velocities with X is {share} of the expected one, and velocity components normal to X \
             are up to {across} m/s"
        ),
        "received values are assigned to the wrong particles, or the columns of a state are in a \
         different order than the particles or `points`",
        "the order of particles, for example if the solver sorts them by cell: all columns and \
         values must have the order of the problem, or of `points`. A solver that needs the force \
         at other points must send their `reference_position`. Columns are stored point after \
         point",
    ))
}

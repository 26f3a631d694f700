//! Examination of a body in free fall.

use crate::subject::Precision;
use crate::testing::doctor::motion::single;
use crate::testing::doctor::prelude::*;

pub(super) const EXAMINATION: Examination = Examination {
    name: "fall",
    expected: "a body without stress falls with the velocity v = g t and the displacement \
               u = g t^2/2",
    after: &["translation"],
    covers: &["loads: gravity"],
    examine,
};

/// Gravity (m/s2). The value differs from 9.81, because a solver may use 9.81 by default.
const GRAVITY: f64 = 3.7;

/// Maximum relative difference between a measured value and the value that a cause predicts.
const NEAR: f64 = 0.02;

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = patient.able(&[2, 3, 1], &ANY_LAW, &scene)?;
    let course = patient.run(&scene)?;
    let mut g = Vector3::zeros();
    g[scene.dimension - 1] = -GRAVITY;
    let (last, d) = (course.last(), scene.dimension);
    let end = course.times[last];
    let (v, u) = (course.mean(velocity, last), course.mean(displacement, last));
    let wanted = [end * g, 0.5 * end * end * g];
    let [v, u] = [v, u].map(|mean| shown_vector(mean, d));
    let [exact_v, exact_u] = wanted.map(|wanted| shown_vector(wanted, d));
    let measured = format!(
        "after {last} steps, v = {v} m/s and u = {u} m; expected v = {exact_v} m/s and u = {exact_u} \
         m"
    );
    let finding = of_force(patient, &course, g).or_else(|| of_times(patient, &course, g));
    if finding.is_none() {
        complete(course)?;
    }
    Ok(Examined::new(measured, finding))
}

fn scene(kind: Kind) -> BoxScene {
    let mut scene = BoxScene::of_cells(kind, [0.2625, 0.3875, 0.1375], 4.0, 6.0);
    let mut gravity = vec![0.0; kind.0];
    gravity[kind.0 - 1] = -GRAVITY;
    scene.gravity = Some(gravity);
    BoxScene { steps: 40, dt: 0.01, ..scene }
}

/// Whether the solver takes several shorter steps for each step; `false` without gravity.
pub(super) fn divides_steps(patient: &Patient<'_>) -> bool {
    let course = patient.able(&[2, 3, 1], &ANY_LAW, &scene).and_then(|scene| patient.run(&scene));
    course.is_ok_and(|course| {
        course.last() > 1 && FallTimes::new(&course, -GRAVITY).is_of_shorter_steps()
    })
}

fn of_force(patient: &Patient<'_>, course: &Course, g: Vector3<f64>) -> Option<SolverFinding> {
    let (last, d) = (course.last(), course.problem.dimension);
    let end = course.times[last];
    let off = |k: usize| course.farthest(velocity, k, course.times[k] * g);
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
    let (_, slope, _) = line(&course.times[1..], &along);
    let factor = slope / g[axis];
    let across = v.remove_row(axis).norm();
    if across > NEAR * GRAVITY * end {
        return Some(SolverFinding::defect(
            "gravity-along-another-axis",
            format!("the body falls in the direction {}", shown_vector(1.0 / v.norm() * v, d)),
            "gravity acts along a different axis than in the problem",
            "the order of axes: `body_force_value` has its components in the order x, y, z",
        ));
    }
    if (factor - 1.0).abs() > 1e-3 {
        let (name, cause) = factor_cause(factor, course);
        return Some(SolverFinding::defect(
            name,
            format!("the acceleration is {} times the gravity of the problem", shown(factor)),
            cause,
            "the code that adds body forces: add mass times `body_force_value` (m/s2) to the nodal \
             force, once and with the sign given in the problem",
        ));
    }
    None
}

/// Times to which the velocities and positions of a falling body belong, in steps.
struct FallTimes {
    /// Smallest and largest l of the velocities `g (t - l dt)`.
    lag: [f64; 2],
    /// Smallest and largest q of the steps, which move the body by `v dt + (1 + q) g dt^2/2` with
    /// the velocity v before the step. Shorter steps of the lengths `f dt` give the sum of all f^2.
    share: [f64; 2],
}

impl FallTimes {
    fn new(course: &Course, g: f64) -> Self {
        let (axis, dt) = (course.problem.dimension - 1, course.problem.dt);
        let at = |field: Field, k: usize| course.mean(field, k)[axis];
        let range = |all: &dyn Fn(usize) -> f64, end: usize| {
            (1..end).map(all).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
                [low.min(x), high.max(x)]
            })
        };
        let lag = |k: usize| (course.times[k] - at(velocity, k) / g) / dt;
        let share = |k: usize| {
            let moved = at(displacement, k + 1) - at(displacement, k);
            (moved - at(velocity, k) * dt) / (0.5 * g * dt * dt) - 1.0
        };
        Self { lag: range(&lag, course.last() + 1), share: range(&share, course.last()) }
    }

    fn has_lag(&self, lag: f64) -> bool {
        self.lag.iter().all(|l| (l - lag).abs() <= NEAR)
    }

    fn has_share(&self, share: f64) -> bool {
        self.share.iter().all(|q| (q - share).abs() <= 0.1)
    }

    fn has_lag_of_scheme(&self) -> bool {
        self.has_lag(0.0) || self.has_lag(0.5)
    }

    /// Whether positions and velocities are those of shorter steps, with velocities at most half a
    /// shorter step early.
    fn is_of_shorter_steps(&self) -> bool {
        let [[lag, most_lag], [share, most_share]] = [self.lag, self.share];
        let is_lag = lag >= -NEAR && most_lag <= 0.5 * most_share.sqrt() + NEAR;
        share > NEAR && most_share < 0.98 && is_lag
    }

    /// Number of equal steps that the solver takes for each step, or `None` if the steps differ.
    fn count(&self) -> Option<f64> {
        let count = libm::round(1.0 / self.share[1].abs());
        let equal = self.share.iter().all(|q| (q.abs() * count - 1.0).abs() <= NEAR);
        equal.then_some(count)
    }
}

/// Condition, weight and name of the finding, cause, and code to check. The first rule whose
/// condition holds gives the finding.
type FallRule = (fn(&FallTimes) -> bool, FindingWeight, &'static str, &'static str, &'static str);

const RULES: [FallRule; 8] = [
    (
        |fall| fall.has_lag(0.0) && fall.has_share(1.0),
        FindingWeight::Remark,
        "start-half-a-step-off",
        "each step updates velocities first and then positions, but the run starts with the \
         velocity at t = 0 instead of -dt/2. The velocities that move particles are then too large \
         by a dt/2 (a: acceleration), which lowers the order in time by one",
        "the start of the run: subtract dt/2 times the initial acceleration from the velocity \
         before the first step. Suites then show the order in time of the scheme",
    ),
    (
        |fall| fall.has_lag(0.5) && fall.has_share(1.0),
        FindingWeight::Remark,
        "velocity-half-a-step-behind",
        "the scheme is a leapfrog: the reported velocities belong to a time half a step before the \
         reported positions",
        "the velocities in `state`. Suites that judge velocities will show order 1 in dt. The mean \
         of two successive velocities belongs to the time of the positions",
    ),
    (
        FallTimes::is_of_shorter_steps,
        FindingWeight::Remark,
        "steps-are-divided",
        "the solver takes several shorter steps for each requested step. A single step that moves \
         particles by a weighted mean of the old and the new velocity gives the same values",
        "time step control of the solver. The order in time is that of the shorter steps, if their \
         number does not change with dt",
    ),
    (
        |fall| fall.has_lag(0.5) && fall.has_share(0.0),
        FindingWeight::Defect,
        "positions-from-mean-velocity",
        "each step moves the body by the mean of the velocities before and after it, which are half \
         a step early. Velocity Verlet or Newmark without an initial acceleration does the same",
        "the velocity that moves particles (the new velocity of the grid, not a mean with the old \
         velocity of the particle), and the acceleration at the start",
    ),
    (
        |fall| fall.has_lag_of_scheme() && fall.has_share(-1.0),
        FindingWeight::Defect,
        "positions-before-velocities",
        "positions are updated with the velocity before the step. This has order 1 in time \
         (forward Euler, if strains use this velocity too)",
        "the order of the updates: first velocities, then positions with the new velocities",
    ),
    (
        |fall| fall.has_lag(0.5) && fall.has_share(2.0),
        FindingWeight::Remark,
        "velocity-half-a-step-behind",
        "the reported velocities belong to a time half a step before the end of the step, for \
         example as means of the velocities before and after the step. Positions move with the \
         later velocity, so the scheme is not a leapfrog",
        "the velocities in `state`, and the velocity at the start of the run: the positions are \
         those of a run that starts with the velocity at t = 0 instead of -dt/2",
    ),
    (
        |fall| {
            let is_in_step = fall.lag[0] >= -NEAR && fall.lag[1] <= 0.5 + NEAR;
            !is_in_step || (fall.has_share(1.0) && !fall.has_lag_of_scheme())
        },
        FindingWeight::Defect,
        "velocity-of-another-time",
        "the reported velocities belong neither to the time after the step, nor to half a step \
         before this time as in a leapfrog",
        "the code before the first step: v(-dt/2) = v0 - a dt/2, not v0 + a dt/2, or the initial \
         acceleration; the number of steps; the variable from which the answer takes velocities",
    ),
    (
        |_| true,
        FindingWeight::Defect,
        "way-not-of-velocities",
        "the reported positions do not follow from the reported velocities",
        "the velocity that moves particles, which must include gravity exactly once",
    ),
];

/// Returns a finding if the acceleration is g, but velocities or positions belong to other times.
fn of_times(patient: &Patient<'_>, course: &Course, g: Vector3<f64>) -> Option<SolverFinding> {
    let (last, dt, axis) = (course.last(), course.problem.dt, course.problem.dimension - 1);
    let (end, g) = (course.times[last], g[axis]);
    let late = (course.mean(velocity, last)[axis] / g - end) / dt;
    let ahead = (course.mean(displacement, last)[axis] / g - 0.5 * end * end) / (0.5 * end * dt);
    if late.abs().max(ahead.abs()) * dt / end <= patient.rounding() {
        return None;
    }
    let fall = FallTimes::new(course, g);
    let term = |x: f64, unit: &str| {
        let sign = if x < 0.0 { "-" } else { "+" };
        let is_zero = x.abs() * dt / end <= patient.rounding();
        if is_zero { String::new() } else { format!(" {sign} {}{unit}", shown(x.abs())) }
    };
    let [low, high] = fall.share.map(shown);
    let range = if low == high { low } else { format!("{low} to {high}") };
    let (_, weight, name, cause, look_at) = *RULES.iter().find(|(holds, ..)| holds(&fall))?;
    let count = fall.count().filter(|_| name == "steps-are-divided");
    let steps = count
        .map_or(String::new(), |k| format!(". The solver takes {k} steps of dt/{k} for each step"));
    let (late, ahead) = (term(late, " dt"), term(ahead, " g t dt/2"));
    let seen = format!(
        "the measured velocity is v = g (t{late}), expected v = g t; the measured displacement is \
         u = g t^2/2{ahead}, expected u = g t^2/2. Each step moves the body by v dt + (1 + q) g \
         dt^2/2 with q = {range}, where v is the velocity before the step{steps}"
    );
    Some(SolverFinding { weight, ..SolverFinding::defect(name, seen, cause, look_at) })
}

/// Returns the name of the finding on accelerations that are wrong by `factor`, and the cause.
pub(super) fn factor_cause(factor: f64, course: &Course) -> (&'static str, &'static str) {
    let density = course.problem.materials[0].density;
    let mass = course.problem.particles.mass.first().copied().unwrap_or(f64::NAN);
    let is = |wanted: f64| (factor / wanted - 1.0).abs() <= NEAR;
    if factor.abs() <= 1e-3 {
        return ("gravity-missing", "gravity or the body force has no effect");
    }
    if is(-1.0) {
        return ("gravity-upwards", "gravity or the body force has the wrong sign");
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
    ("gravity-scaled", known.map_or("the acceleration is multiplied by an unknown factor", |k| k.1))
}

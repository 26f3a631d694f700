//! A motion that should be uniform, and causes of its errors if the body keeps its shape.

use crate::testing::doctor::course::{
    Course, displacement, dot, line, minus, shown, shown_vector, size, times, velocity,
};
use crate::testing::doctor::finding::SolverFinding;
use crate::testing::doctor::patient::{Hindrance, Patient};
use crate::testing::doctor::scene::BoxScene;

/// Maximum relative difference between a measured value and the pattern that explains it.
const NEAR: f64 = 0.02;

/// Maximum deviation of points from their mean error, relative to the mean error, for which the
/// points count as having a common error.
const AS_ONE: f64 = 0.05;

/// A recorded motion that should be uniform.
pub(super) struct UniformMotion<'a> {
    pub(super) patient: &'a Patient<'a>,
    pub(super) scene: &'a BoxScene,
    pub(super) course: Course,
    /// Expected velocity (m/s).
    pub(super) velocity: [f64; 3],
}

impl UniformMotion<'_> {
    /// Returns the largest errors of displacements and velocities, relative to distance and speed.
    pub(super) fn off(&self) -> (f64, f64) {
        let most = |all: &dyn Fn(usize) -> f64| {
            (0..=self.course.last()).map(all).fold(0.0, f64::max) / size(self.velocity)
        };
        let end = self.course.times[self.course.last()];
        (most(&|k| self.way_off(k)) / end, most(&|k| self.speed_off(k)))
    }

    /// Returns the largest error of a displacement (m) in state `k`.
    pub(super) fn way_off(&self, k: usize) -> f64 {
        let wanted = times(self.course.times[k], self.velocity);
        self.course.farthest(displacement, k, wanted)
    }

    fn speed_off(&self, k: usize) -> f64 {
        self.course.farthest(velocity, k, self.velocity)
    }

    /// Whether all points have about the same error.
    pub(super) fn errs_as_one(&self) -> bool {
        let course = &self.course;
        (1..=course.last()).all(|k| {
            let (u, v) = (course.mean(displacement, k), course.mean(velocity, k));
            let spread = [course.farthest(displacement, k, u), course.farthest(velocity, k, v)];
            let errors = [
                size(minus(u, times(course.times[k], self.velocity))),
                size(minus(v, self.velocity)),
            ];
            // Rounding errors also differ between points.
            let small = [
                1e-6 * size(self.velocity) * course.times[course.last()],
                1e-6 * size(self.velocity),
            ];
            (0..2).all(|i| spread[i] <= AS_ONE * errors[i] + small[i])
        })
    }
}

/// Returns the cause, if the motion matches a known pattern.
pub(super) fn cause(motion: &UniformMotion<'_>) -> Result<Option<SolverFinding>, Hindrance> {
    let course = &motion.course;
    let last = course.last();
    let end = course.times[last];
    let (v, u) = (course.mean(velocity, last), course.mean(displacement, last));
    if let Some(found) = turned(motion, "velocity", v) {
        return Ok(Some(found));
    }
    if let Some(found) = turned(motion, "displacement", times(1.0 / end, u)) {
        return Ok(Some(found));
    }
    let (_, speed) = motion.off();
    if speed <= motion.patient.rounding() { Ok(way(motion)) } else { of_speed(motion) }
}

/// Returns a finding if a vector has permuted components or wrong signs.
fn turned(motion: &UniformMotion<'_>, column: &str, seen: [f64; 3]) -> Option<SolverFinding> {
    let d = motion.course.problem.dimension;
    let wanted = motion.velocity;
    let is_same = |a: f64, b: f64| (a - b).abs() <= NEAR * size(wanted);
    let is_one = |i: usize| (0..d).any(|j| is_same(seen[i].abs(), wanted[j].abs()));
    let off = size(minus(seen, wanted)) > 0.1 * size(wanted);
    if !(off && (0..d).all(is_one) && is_same(size(seen), size(wanted))) {
        return None;
    }
    let (seen, wanted) = (shown_vector(seen, d), shown_vector(wanted, d));
    Some(SolverFinding::defect(
        "axes-exchanged",
        format!("`{column}` goes along {seen} where {wanted} was expected"),
        "axes are exchanged, or have another sign",
        "the order of components in columns (point after point: x y, x y) and of axes in the solver; \
         which axis it calls upward",
    ))
}

/// Returns a finding if velocities change.
fn of_speed(motion: &UniformMotion<'_>) -> Result<Option<SolverFinding>, Hindrance> {
    let shares = shares(motion);
    let last = shares[shares.len() - 1];
    let t = &motion.course.times[1..];
    let error = (last - 1.0).abs().max((shares[0] - 1.0).abs());
    let (_, _, off) = line(t, &shares);
    let spread = shares.iter().map(|a| (a - last).abs()).fold(0.0, f64::max);
    if spread <= NEAR * error {
        return Ok(Some(SolverFinding::defect(
            "velocity-scaled",
            format!("velocities are {} of what was given, from the first step on", shown(last)),
            units(last),
            "units at the border of the solver: lengths in m, times in s",
        )));
    }
    if shares.iter().any(|a| !(*a > 0.0)) {
        return Ok(None);
    }
    let logs: Vec<f64> = shares.iter().map(|a| libm::log(*a)).collect();
    let (_, rate, log_off) = line(t, &logs);
    if !(log_off <= 0.1 * logs[logs.len() - 1].abs() || off <= 0.1 * error) {
        return Ok(None);
    }
    // Repeats the run with half the step length: a loss per unit time keeps its rate, and a loss
    // per step doubles its rate.
    let scene = motion.scene;
    let halved = scene.with_half_the_step();
    let course = motion.patient.run(&halved)?;
    let again = UniformMotion { course, ..*motion };
    let logs = shares_of(&again).into_iter().map(libm::log).collect::<Vec<f64>>();
    let (_, halved, _) = line(&again.course.times[1..], &logs);
    let per_step = 1.0 - libm::exp(rate * scene.dt);
    let verb = if rate < 0.0 { "lost" } else { "gained" };
    Ok(Some(if (halved / rate - 1.0).abs() <= 0.25 {
        SolverFinding::defect(
            "drag",
            format!("speed is {verb} at a rate of {} per second, at any time step", shown(-rate)),
            "drag or damping in proportion to the velocity acts that the problem does not have",
            "the solver's own defaults: air drag, damping of mass (Rayleigh's alpha), a viscous medium",
        )
    } else {
        SolverFinding::defect(
            "speed-lost-each-step",
            format!(
                "a share of {} of the speed is {verb} in each step, whatever its length ({} and {} \
                 per second with half of it)",
                shown(per_step.abs()),
                shown(-rate),
                shown(-halved)
            ),
            "weights sum to the same number at every place, which is not one; or velocities are \
             multiplied in each step",
            "the sum of all weights of a particle, which must be 1 to rounding; a damping factor for \
             grid velocities",
        )
    }))
}

/// Returns the remaining share of the speed in the direction of motion at each time.
fn shares(motion: &UniformMotion<'_>) -> Vec<f64> {
    shares_of(motion)
}

fn shares_of(motion: &UniformMotion<'_>) -> Vec<f64> {
    let v = motion.velocity;
    let mean = |k| motion.course.mean(velocity, k);
    (1..=motion.course.last()).map(|k| dot(mean(k), v) / dot(v, v)).collect()
}

/// Returns a finding if displacements do not follow from correct velocities.
fn way(motion: &UniformMotion<'_>) -> Option<SolverFinding> {
    let (course, v, dt) = (&motion.course, motion.velocity, motion.scene.dt);
    let t = &course.times[1..];
    let mean = |k| course.mean(displacement, k);
    let ways: Vec<f64> = (1..=course.last()).map(|k| dot(mean(k), v) / dot(v, v)).collect();
    let (ahead, slope, off) = line(t, &ways);
    // A constant part far below one step is rounding; another finding covers single precision.
    let is_systematic = (slope - 1.0).abs() > 1e-6 || ahead.abs() > 1e-4 * dt;
    if off > NEAR * dt || !is_systematic {
        return None;
    }
    if (slope - 1.0).abs() <= 1e-6 {
        let steps = ahead / dt;
        let (amount, name) = match steps.abs() {
            a if (a - 0.5).abs() <= NEAR => ("half a step", "start-half-a-step-off"),
            a if (a - 1.0).abs() <= NEAR => ("a step", "start-a-step-off"),
            _ => ("a constant time", "displaced-in-motion"),
        };
        let side = if steps > 0.0 { "ahead" } else { "behind" };
        return Some(SolverFinding::defect(
            name,
            format!("x is v times {} s {side} at all times: {amount}", shown(ahead.abs())),
            "positions belong to another time than t = 0 and those after each step",
            "whether positions are moved before the first step or reported half a step on; the number \
             of steps that `advance` takes",
        ));
    }
    if (0.9..1.1).contains(&slope) {
        return Some(SolverFinding::defect(
            "weights-do-not-sum-to-one",
            format!("displacements are {} of velocity times time, everywhere", shown(slope)),
            "velocities come from the grid with weights that sum to that number, or positions are moved by \
             that share of dt times the velocity",
            "the sum of all weights of a particle, which must be 1 to rounding; the update of positions, \
             x <- x + dt v",
        ));
    }
    Some(SolverFinding::defect(
        "displacement-scaled",
        format!("displacements are {} of velocity times time", shown(slope)),
        units(slope),
        "the units in which positions are returned; the update of positions, x <- x + dt v; the sum of all \
         weights of a particle, which must be 1",
    ))
}

/// Returns the likely cause of a factor.
fn units(factor: f64) -> &'static str {
    let log = libm::log10(factor.abs());
    if (log - libm::round(log)).abs() <= 1e-3 && libm::round(log) != 0.0 {
        "a unit is another one: the factor is a power of ten"
    } else {
        "one of them is multiplied by a number: a length or a time unit of the solver's own"
    }
}

/// Returns the finding for a motion that matches no known pattern.
pub(super) fn unknown(motion: &UniformMotion<'_>) -> SolverFinding {
    let (course, d) = (&motion.course, motion.course.problem.dimension);
    let last = course.last();
    SolverFinding::defect(
        "motion-not-kept",
        format!(
            "the body as a whole has the velocity {} m/s at the end and went {} m, where {} m/s and \
             {} m were expected",
            shown_vector(course.mean(velocity, last), d),
            shown_vector(course.mean(displacement, last), d),
            shown_vector(motion.velocity, d),
            shown_vector(times(course.times[last], motion.velocity), d)
        ),
        "a force acts that the problem does not have, or the motion meets a limit",
        "loads and walls that the solver adds by itself",
    )
}

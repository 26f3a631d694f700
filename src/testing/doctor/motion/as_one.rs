//! A motion that should be uniform, and causes of its errors if the body keeps its shape.

use crate::testing::doctor::prelude::*;

/// Maximum relative difference between a measured value and the value that a cause predicts.
const NEAR: f64 = 0.02;

/// Maximum deviation from the mean motion of a body that moves as a whole, over the mean error.
const AS_ONE: f64 = 0.05;

pub(super) struct UniformMotion<'a> {
    pub(super) patient: &'a Patient<'a>,
    pub(super) scene: &'a BoxScene,
    pub(super) course: Course,
    /// Expected velocity (m/s).
    pub(super) velocity: Vector3<f64>,
}

impl UniformMotion<'_> {
    /// Returns the largest errors of displacements and velocities, relative to distance and speed.
    pub(super) fn off(&self) -> (f64, f64) {
        let most = |all: &dyn Fn(usize) -> f64| {
            (0..=self.course.last()).map(all).fold(0.0, f64::max) / self.velocity.norm()
        };
        let end = self.course.times[self.course.last()];
        (
            most(&|k| self.way_off(k)) / end,
            most(&|k| self.course.farthest(velocity, k, self.velocity)),
        )
    }

    /// Returns the largest error of a displacement (m) in state `k`.
    pub(super) fn way_off(&self, k: usize) -> f64 {
        let wanted = self.course.times[k] * self.velocity;
        self.course.farthest(displacement, k, wanted)
    }

    /// Whether all points have about the same error.
    pub(super) fn errs_as_one(&self) -> bool {
        let course = &self.course;
        (1..=course.last()).all(|k| {
            let (u, v) = (course.mean(displacement, k), course.mean(velocity, k));
            let spread = [course.farthest(displacement, k, u), course.farthest(velocity, k, v)];
            let way = course.times[k] * self.velocity;
            let errors = [(u - way).norm(), (v - self.velocity).norm()];
            // Small differences between points may be rounding errors.
            let speed = 1e-6 * self.velocity.norm();
            let small = [speed * course.times[course.last()], speed];
            (0..2).all(|i| spread[i] <= AS_ONE * errors[i] + small[i])
        })
    }
}

pub(super) fn cause(motion: &UniformMotion<'_>) -> Result<Option<SolverFinding>, Hindrance> {
    let course = &motion.course;
    let last = course.last();
    let end = course.times[last];
    let (v, u) = (course.mean(velocity, last), course.mean(displacement, last));
    let turned =
        turned(motion, "velocity", v).or_else(|| turned(motion, "displacement", u * (1.0 / end)));
    if turned.is_some() {
        return Ok(turned);
    }
    let (_, speed) = motion.off();
    if speed <= motion.patient.rounding() { Ok(way(motion)) } else { of_speed(motion) }
}

fn turned(motion: &UniformMotion<'_>, column: &str, seen: Vector3<f64>) -> Option<SolverFinding> {
    let d = motion.course.problem.dimension;
    let wanted = motion.velocity;
    let is_same = |a: f64, b: f64| (a - b).abs() <= NEAR * wanted.norm();
    let is_one = |i: usize| (0..d).any(|j| is_same(seen[i].abs(), wanted[j].abs()));
    let off = (seen - wanted).norm() > 0.1 * wanted.norm();
    if !(off && (0..d).all(is_one) && is_same(seen.norm(), wanted.norm())) {
        return None;
    }
    let (seen, wanted) = (shown_vector(seen, d), shown_vector(wanted, d));
    Some(SolverFinding::defect(
        "axes-exchanged",
        format!("the mean of `{column}` has the direction {seen}, expected {wanted}"),
        "axes are swapped, or have the wrong sign",
        "the order of components in columns (point after point: x y, x y); the order of axes in \
         the solver; the vertical axis of the solver",
    ))
}

fn of_speed(motion: &UniformMotion<'_>) -> Result<Option<SolverFinding>, Hindrance> {
    let shares = speed_shares(motion);
    let last = shares[shares.len() - 1];
    let t = &motion.course.times[1..];
    let error = (last - 1.0).abs().max((shares[0] - 1.0).abs());
    let (_, _, off) = line(t, &shares);
    let spread = shares.iter().map(|a| (a - last).abs()).fold(0.0, f64::max);
    if spread <= NEAR * error {
        return Ok(Some(SolverFinding::defect(
            "velocity-scaled",
            format!(
                "from the first step on, velocities are {} times the velocities of the problem",
                shown(last)
            ),
            units(last),
            "the units of exchanged data: lengths in m, times in s",
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
    // A second run with half the step length distinguishes two kinds of loss: a loss per unit time
    // has the same rate, and a loss per step has twice the rate.
    let scene = motion.scene;
    let halved = scene.with_half_the_step();
    let course = motion.patient.run(&halved)?;
    let again = UniformMotion { course, ..*motion };
    let logs = speed_shares(&again).into_iter().map(libm::log).collect::<Vec<f64>>();
    let (_, halved, _) = line(&again.course.times[1..], &logs);
    let per_step = 1.0 - libm::exp(rate * scene.dt);
    let verb = if rate < 0.0 { "lost" } else { "gained" };
    let is_drag = (halved / rate - 1.0).abs() <= 0.25;
    let [share, rate, halved] = [per_step.abs(), -rate, -halved].map(shown);
    Ok(Some(if is_drag {
        SolverFinding::defect(
            "drag",
            format!("speed is {verb} at a rate of {rate} per second, independent of the time step"),
            "the solver applies drag or damping, proportional to the velocity, that is not in the \
             problem",
            "the default settings of the solver: air drag, mass-proportional damping (Rayleigh's \
             alpha), a viscous medium",
        )
    } else {
        SolverFinding::defect(
            "speed-lost-each-step",
            format!(
                "a share of {share} of the speed is {verb} in each step, independent of the step \
                 length ({rate} per second, and {halved} per second with half the step)"
            ),
            "the weights of a particle sum to the same number at every position, but this number \
             is not one; or velocities are multiplied by a factor in each step",
            "the sum of all weights of a particle, which must be 1 to rounding; a damping factor \
             for grid velocities",
        )
    }))
}

/// Returns the mean velocity along the expected one at each time, over the expected speed.
fn speed_shares(motion: &UniformMotion<'_>) -> Vec<f64> {
    let v = motion.velocity;
    let mean = |k| motion.course.mean(velocity, k);
    (1..=motion.course.last()).map(|k| mean(k).dot(&v) / v.dot(&v)).collect()
}

fn way(motion: &UniformMotion<'_>) -> Option<SolverFinding> {
    let (course, v, dt) = (&motion.course, motion.velocity, motion.scene.dt);
    let t = &course.times[1..];
    let mean = |k| course.mean(displacement, k);
    let ways: Vec<f64> = (1..=course.last()).map(|k| mean(k).dot(&v) / v.dot(&v)).collect();
    let (ahead, slope, off) = line(t, &ways);
    // Smaller errors are rounding errors, which another finding reports.
    let is_systematic = (slope - 1.0).abs() > 1e-6 || ahead.abs() > 1e-4 * dt;
    let unequal = unequal_steps(&ways, dt);
    if unequal.is_some() || off > NEAR * dt || !is_systematic {
        return unequal;
    }
    if (slope - 1.0).abs() <= 1e-6 {
        let steps = ahead / dt;
        let (amount, name) = match steps.abs() {
            a if (a - 0.5).abs() <= NEAR => ("half a step", "start-half-a-step-off"),
            a if (a - 1.0).abs() <= NEAR => ("a step", "start-a-step-off"),
            _ => ("a constant time", "displaced-in-motion"),
        };
        let (by, side) = (shown(ahead.abs()), if steps > 0.0 { "ahead" } else { "behind" });
        return Some(SolverFinding::defect(
            name,
            format!("in all states, positions are shifted in time by {by} s ({side}): {amount}"),
            "the reported positions do not belong to the times after each step",
            "positions that are moved before the first step, or reported for the middle of a step; \
             the number of steps that `advance` takes",
        ));
    }
    if (0.9..1.1).contains(&slope) {
        return Some(SolverFinding::defect(
            "weights-do-not-sum-to-one",
            format!("at all points, displacements are {} times velocity times time", shown(slope)),
            "the weights that interpolate grid velocities sum to this number, or the position \
             update multiplies dt times the velocity by this number",
            "the sum of all weights of a particle, which must be 1 to rounding; the update of \
             positions, x <- x + dt v",
        ));
    }
    Some(SolverFinding::defect(
        "displacement-scaled",
        format!("displacements are {} times velocity times time", shown(slope)),
        units(slope),
        "the units of the returned displacements; the update of positions, x <- x + dt v; the sum \
         of all weights of a particle, which must be 1",
    ))
}

/// Returns a finding if some steps do not move the body by v dt; `ways` are distances over v (s).
fn unequal_steps(ways: &[f64], dt: f64) -> Option<SolverFinding> {
    let before = std::iter::once(&0.0).chain(ways);
    let lengths: Vec<f64> = ways.iter().zip(before).map(|(now, then)| (now - then) / dt).collect();
    let other = |k: &usize| (lengths[*k] - 1.0).abs() > 1e-3;
    let steps: Vec<usize> = (0..lengths.len()).filter(other).collect();
    let first = *steps.first().filter(|_| 2 * steps.len() < lengths.len())?;
    // Positions that are half a step or a step off from the start have another cause.
    let off = (lengths[0] - 1.0).abs();
    if steps == [0] && ((off - 0.5).abs() <= NEAR || (off - 1.0).abs() <= NEAR) {
        return None;
    }
    let (count, number, length) = (lengths.len(), first + 1, shown(lengths[first]));
    let (right, several) = (count - steps.len(), " (the first of several such steps)");
    let several = if steps.len() > 1 { several } else { "" };
    Some(SolverFinding::defect(
        "steps-of-another-length",
        format!(
            "velocities are correct, and {right} of {count} steps move the body by v dt, but step \
             {number} moves it by {length} v dt{several}"
        ),
        "positions are moved with another step length in these steps, for example to end the run or \
         to write output at a certain time, or they are changed after the step",
        "the step length in x <- x + dt v; comparisons of the time with an end or output time, \
         which need a tolerance for rounding; a special first or last step",
    ))
}

fn units(factor: f64) -> &'static str {
    let log = libm::log10(factor.abs());
    if (log - libm::round(log)).abs() <= 1e-3 && libm::round(log) != 0.0 {
        "a unit is wrong: the factor is a power of ten"
    } else {
        "the solver multiplies this quantity by a factor, for example for its own unit of length \
         or time"
    }
}

pub(super) fn unknown(motion: &UniformMotion<'_>) -> SolverFinding {
    let (course, wanted) = (&motion.course, motion.velocity);
    let (last, d) = (course.last(), course.problem.dimension);
    let seen = [course.mean(velocity, last), course.mean(displacement, last)];
    let [v, u] = seen.map(|mean| shown_vector(mean, d));
    let wanted = [wanted, course.times[last] * wanted];
    let [exact_v, exact_u] = wanted.map(|wanted| shown_vector(wanted, d));
    SolverFinding::defect(
        "motion-not-kept",
        format!(
            "at the end, the whole body has the velocity {v} m/s and the displacement {u} m, \
             expected {exact_v} m/s and {exact_u} m"
        ),
        if motion.off().1 <= motion.patient.rounding() {
            "velocities are correct, but positions do not follow from them"
        } else {
            "the solver applies a force that is not in the problem, or limits the motion"
        },
        "the update of positions, x <- x + dt v; loads, walls and limits that the solver adds by \
         default",
    )
}

//! Determines the cause if the parts of a stress-free body move differently.

use super::as_one::UniformMotion;
use crate::testing::doctor::finding::{LIGHT_NODES, MASS_THRESHOLD};
use crate::testing::doctor::prelude::*;
use std::f64::consts::SQRT_2;

/// Distance (cells) from the edge of the body up to which points use nodes outside the body.
const RIM: f64 = 1.6;

/// Returns a cause that even small errors reveal: a position limit, light nodes, or cell changes.
pub(super) fn plain(motion: &UniformMotion<'_>) -> Option<SolverFinding> {
    limit(motion)
        .or_else(|| changed_on_faces(motion))
        .or_else(|| light_nodes(motion))
        .or_else(|| crossing(motion))
}

pub(super) fn cause(motion: &UniformMotion<'_>) -> Result<SolverFinding, Hindrance> {
    let soft = motion.scene.soft();
    let course = motion.patient.run(&soft)?;
    let is_whole = course.failure.is_none();
    let again = UniformMotion { course, scene: &soft, ..*motion };
    let (way, speed) = again.off();
    let (_, stiff) = motion.off();
    let v = motion.velocity;
    let scale = v.dot(&v) * motion.course.times[1];
    // Displacements of points in the first step, relative to v dt.
    let (low, high) = range(motion.course.points(displacement, 1).map(|(_, u)| u.dot(&v) / scale));
    if is_whole && way.max(speed) <= 1e-3 * stiff.max(motion.patient.rounding()) {
        let [stiff, speed] = [stiff, speed].map(shown);
        return Ok(SolverFinding::defect(
            "gradients-do-not-sum-to-zero",
            format!(
                "the largest velocity error is {stiff} of the speed, and {speed} in a run without \
                 stiffness"
            ),
            "the gradients at a particle do not sum to zero. A uniform velocity then has a \
             gradient at particles, which strains the body and causes stress",
            "the sum of all gradients at a particle, which must be zero; the nodes that are \
             visited, which must include every node whose function is not zero at the particle; \
             the gradients, which must be the derivatives of the weights, with the factor 1/h",
        ));
    }
    let slowed = uneven_drag(&again)?;
    Ok(slowed.unwrap_or_else(|| weights(motion, low, high, (way, speed))))
}

/// Returns a finding if points of a body without stiffness slow down at different rates, which do
/// not depend on the step length, unlike the losses of wrong weights.
fn uneven_drag(motion: &UniformMotion<'_>) -> Result<Option<SolverFinding>, Hindrance> {
    let scene = motion.scene;
    let halved = scene.with_half_the_step();
    let course = motion.patient.run(&halved)?;
    if course.last() < 2 {
        return Ok(None);
    }
    let again = UniformMotion { course, scene: &halved, ..*motion };
    // Compares losses after the time of the first step: two half steps double the loss of wrong
    // weights. The limit for the ratio is the geometric mean of 1 and 2.
    let (once, twice) = (lost(motion, 1), lost(&again, 2));
    let is_noise = !(once.1 * scene.steps as f64 > motion.patient.rounding());
    if is_noise || !((twice.1 / once.1).max(once.1 / twice.1) <= SQRT_2) {
        return Ok(None);
    }
    let rates = [once.0, once.1, twice.0, twice.1].map(|share| shown(share / scene.dt));
    let [low, high, halved_low, halved_high] = rates;
    Ok(Some(SolverFinding::defect(
        "drag",
        format!(
            "points lose {low} to {high} of their speed per second, depending on their positions, \
             and {halved_low} to {halved_high} with half the time step"
        ),
        "the solver applies drag or damping that is not in the problem, with different strengths \
         at different nodes",
        "the default settings of the solver: air drag, a viscous medium, damping of nodes that \
         does not depend on their mass",
    )))
}

/// Returns the smallest and largest share of the speed that points have lost in state `k`.
fn lost(motion: &UniformMotion<'_>, k: usize) -> (f64, f64) {
    let v = motion.velocity;
    range(motion.course.points(velocity, k).map(|(_, seen)| 1.0 - seen.dot(&v) / v.dot(&v)))
}

fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
}

/// Returns the finding for weights that do not sum to one. `soft` contains the relative errors of
/// displacement and velocity without stiffness.
fn weights(motion: &UniformMotion<'_>, low: f64, high: f64, soft: (f64, f64)) -> SolverFinding {
    let (way, speed) = motion.off();
    let [low, high, way, speed] = [low, high, way, speed].map(shown);
    let [soft_way, soft_speed] = [soft.0, soft.1].map(shown);
    SolverFinding::defect(
        "weights-do-not-sum-to-one",
        format!(
            "in the first step, points move by {low} to {high} of v dt, depending on their \
             positions in the cells. In the whole run, displacement errors are up to {way} of the \
             distance travelled, and velocity errors up to {speed} of the speed; without stiffness \
             they are {soft_way} and {soft_speed}"
        ),
        "the weights of a particle do not sum to one, or the transfers to the grid and back use \
         different weights",
        "the sum of all weights of a particle, at several positions in a cell; the nodes that are \
         visited; the formula of the basis functions; the weights in nodal momentum and nodal \
         mass, which must be the same",
    )
}

fn limit(motion: &UniformMotion<'_>) -> Option<SolverFinding> {
    let (course, v) = (&motion.course, motion.velocity);
    let (last, d) = (course.last(), course.problem.dimension);
    let step = course.times[1];
    (0..d).filter(|i| v[*i] != 0.0 && last > 5).find_map(|i| {
        let end = |k: usize| {
            let places = course.points(displacement, k).map(|(label, u)| label[i] + u[i]);
            places.map(|x| x * v[i].signum()).fold(f64::NEG_INFINITY, f64::max)
        };
        let (now, short) = (end(last), end(0) + v[i].abs() * course.times[last] - end(last));
        let stands = (now - end(last - 5)).abs() <= 1e-3 * (v[i] * step).abs();
        let moves = (end(1) - end(0)).abs() >= 0.5 * (v[i] * step).abs();
        if !(stands && moves && short > (v[i] * step).abs()) {
            return None;
        }
        let (axis, place) = (["x", "y", "z"][i], shown(now * v[i].signum()));
        Some(SolverFinding::defect(
            "position-limited",
            format!("the body moves up to {axis} = {place} m, and no point passes this coordinate"),
            "the solver keeps positions inside a box that is not in the problem",
            "clamps on positions or cell indices; walls of a unit cube. The grid of the problem \
             begins at `grid.origin`, and the motion stays inside this grid",
        ))
    })
}

pub(crate) const CHANGED: &str = "positions-changed";

/// Maximum change (v dt) of a position; a missing weight on a face causes a larger error.
const SLIGHT: f64 = 0.05;

/// Returns a finding if only positions of particles on a cell face have an error in a step.
fn changed_on_faces(motion: &UniformMotion<'_>) -> Option<SolverFinding> {
    let (course, v) = (&motion.course, motion.velocity);
    let (rounding, origin) = (motion.patient.rounding(), &course.problem.grid.origin);
    if !(motion.off().1 <= rounding) {
        return None;
    }
    let is_on_face = |x: Vector3<f64>| {
        let cells = origin.iter().enumerate().map(|(i, low)| (x[i] - low) / motion.scene.h);
        cells.into_iter().any(|s| (s - libm::round(s)).abs() <= 1e-3)
    };
    let (mut most, mut step) = (0.0_f64, 0);
    for k in 1..=course.last() {
        let way = (course.times[k] - course.times[k - 1]) * v;
        let pairs = course.points(displacement, k - 1).zip(course.points(displacement, k));
        for (before, after) in pairs {
            let off = (after.1 - before.1 - way).norm() / way.norm();
            if off > rounding * course.last() as f64 {
                if !(off <= SLIGHT
                    && (is_on_face(before.0 + before.1) || is_on_face(after.0 + after.1)))
                {
                    return None;
                }
                (most, step) = (most.max(off), if step == 0 { k } else { step });
            }
        }
    }
    let finding = SolverFinding::defect(
        CHANGED,
        format!(
            "velocities are correct. From step {step} on, particles that lie on a cell face move \
             by up to {} v dt more or less than v dt, and all other particles by v dt",
            shown(most)
        ),
        "the solver changes the positions of particles on cell faces, for example to move them \
         into one of the cells. Wrong weights would cause a larger error",
        "the update of positions, x <- x + dt v; code that finds the cell of a particle, which \
         must not change the position",
    );
    (step > 0).then_some(finding)
}

fn crossing(motion: &UniformMotion<'_>) -> Option<SolverFinding> {
    let course = &motion.course;
    let (h, origin) = (motion.scene.h, &course.problem.grid.origin);
    let cell = |x: Vector3<f64>| -> Vec<i64> {
        origin.iter().enumerate().map(|(i, low)| libm::floor((x[i] - low) / h) as i64).collect()
    };
    let labels: Vec<Vector3<f64>> =
        course.points(displacement, 0).map(|(label, _)| label).collect();
    let crosses = |k: &usize| {
        let way = course.times[*k] * motion.velocity;
        labels.iter().any(|x| cell(*x) != cell(x + way))
    };
    let first = (1..=course.last()).find(crosses)?;
    let error = |k| motion.way_off(k) / (motion.velocity.norm() * course.times[course.last()]);
    let (before, at) = (first.checked_sub(1).map(error)?, error(course.last()));
    // If two steps before the cell change are correct, only the cell change causes the error.
    if first < 3 || !(before < 1e-4 * at && at > 10.0 * motion.patient.rounding()) {
        return None;
    }
    let v_before = course.farthest(velocity, first - 1, motion.velocity) / motion.velocity.norm();
    if v_before > motion.patient.rounding() {
        return None;
    }
    let (last_right, error) = (first - 1, shown(at));
    Some(SolverFinding::defect(
        "wrong-after-a-cell-crossing",
        format!(
            "displacements are correct up to step {last_right}, and their error at the end is \
             {error} of the distance travelled. In step {first} the first particle moves to \
             another cell"
        ),
        "when a particle has moved to another cell, the solver still uses data of the old cell",
        "cell indices, nodes and weights of particles, which must be recomputed in every step",
    ))
}

fn light_nodes(motion: &UniformMotion<'_>) -> Option<SolverFinding> {
    let (course, v) = (&motion.course, motion.velocity);
    let whole = v.norm() * course.times[course.last()];
    let first = (1..=course.last()).find(|k| motion.way_off(*k) > 1e-6 * whole)?;
    let wanted = course.times[first] * v;
    let (low, high) = &motion.scene.body;
    let d = course.problem.dimension;
    let depth = |x: Vector3<f64>| {
        let all = (0..d).map(|i| (x[i] - low[i]).min(high[i] - x[i]));
        all.fold(f64::INFINITY, f64::min) / motion.scene.h
    };
    let (mut rim, mut inside, mut any_inside) = (0.0_f64, 0.0_f64, false);
    for (label, u) in course.points(displacement, first) {
        let off = (u - wanted).norm() / (v.norm() * course.times[1]);
        if depth(label) > RIM {
            (inside, any_inside) = (inside.max(off), true);
        } else {
            rim = rim.max(off);
        }
    }
    if !(any_inside && inside <= motion.patient.rounding() && rim > 1e3 * inside.max(1e-12)) {
        return None;
    }
    let mean = course.mean(velocity, course.last());
    let (rim, [mean, v]) = (shown(rim), [mean, v].map(|v| shown_vector(v, d)));
    Some(SolverFinding::defect(
        LIGHT_NODES,
        format!(
            "in step {first}, points near the surface have displacement errors of up to {rim} of v \
             dt, and points more than {RIM} cells below the surface have none. The mean velocity \
             at the end is {mean} m/s, expected {v} m/s"
        ),
        "nodes with little mass are skipped, and their momentum is lost",
        MASS_THRESHOLD,
    ))
}

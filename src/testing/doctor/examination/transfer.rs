//! Examination of the velocity transfer, with a stress-free body that rotates or stretches.
//!
//! The velocity is `v = L (X - C)`, a rotation or a stretch about the centre C. (A uniform velocity
//! would reveal nothing, because all weights that sum to one transfer it exactly.) The moment
//! `M = sum m (X - C) x v` (rotation) or `M = sum m (X - C) . v` (stretch) shows how much of this
//! velocity is transferred.
//!
//! A transfer that averages (PIC) loses `beta d D sum m L` of M in each step. In this formula, d is
//! the number of axes along which v varies, beta is the share of PIC in a blend with FLIP, and D is
//! the second moment of the weights along an axis: 1/4 h2 for quadratic and 1/3 h2 for cubic
//! B-splines. An affine transfer (APIC) loses nothing if its affine matrix is correct (Jiang et al.
//! 2015, eq. 8 to 11). If the matrix is wrong by the factor a, the loss is `1 - a` times that of
//! PIC. If the matrix is transposed, the loss of a rotation is twice that of PIC.

use super::fall::divides_steps;
use crate::testing::doctor::prelude::*;

pub(super) const EXAMINATION: Examination = Examination {
    name: "transfer",
    expected: "a body without stress that rotates or stretches slowly conserves the first moment \
               of its momentum about the centre, or loses as much as PIC",
    after: &["initial-velocity", "translation", "force"],
    covers: &[],
    examine,
};

pub(super) const INITIAL_VELOCITY: Examination = Examination {
    name: "initial-velocity",
    expected: "a body without stress that stretches slowly starts with the velocities of the \
               problem, which do not grow",
    after: &["rest"],
    covers: &[],
    examine: examine_initial_velocity,
};

/// Rate of rotation or stretch (1/s). No point moves by more than 1e-4 cells.
const RATE: f64 = 1e-4;

/// Basis functions whose averaging loss is known.
const BASES: [&str; 3] = ["linear", "quadratic_bspline", "cubic_bspline"];

/// Maximum relative difference between a measured loss and the predicted loss for a basis.
const NEAR: f64 = 0.03;

/// A transfer conserves the moment if its losses (in the unit of [`Losses`]) are below this value.
const KEPT: f64 = 0.004;

const STEPS: u64 = 5;

/// Velocity gradients (1/s).
const ROTATION: [[f64; 3]; 3] = [[0.0, -RATE, 0.0], [RATE, 0.0, 0.0], [0.0; 3]];
const STRETCH: [[f64; 3]; 3] = [[RATE, 0.0, 0.0], [0.0, RATE, 0.0], [0.0, 0.0, RATE]];

/// Losses of the moment M in the first step and per step from the third on (affine matrices that
/// start at zero need two), in units of `d h2 M/I` with the moment of inertia per mass I.
#[derive(Debug, Clone, Copy)]
struct Losses {
    first: f64,
    later: f64,
    /// The unit of the losses, divided by M.
    unit: f64,
}

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let plain = patient.able(&[2, 3, 1], &ANY_LAW, &|kind| scene(kind, &STRETCH))?;
    let kind = (plain.dimension, plain.law);
    let turning = (kind.0 > 1).then(|| scene(kind, &ROTATION));
    let small = plain.clone().scaled(0.125);
    let scenes: Vec<BoxScene> =
        std::iter::once(plain.clone()).chain(turning).chain([small]).collect();
    let courses = patient.run_all(&scenes)?;
    let losses: Vec<Losses> = courses.iter().zip(&scenes).map(|(c, s)| losses_of(c, s)).collect();
    let (stretch, small) = (losses[0], losses[losses.len() - 1]);
    let rotation = if kind.0 > 1 { losses[1] } else { stretch };
    // If velocities and points are in different orders, the first step loses the whole moment, and
    // later steps lose nothing.
    if losses.iter().all(|l| l.first * l.unit > 0.5 && !(l.later.abs() > KEPT)) {
        let seen = "after one step, the velocities of a stretching body belong to other points";
        let finding = SolverFinding::defect(
            "columns-in-another-order",
            seen.to_owned(),
            "the columns of a state are in a different order than the particles or `points`",
            "particles that the solver sorts by cell: columns must keep the order of the problem, \
             or of `points`",
        );
        return Ok(Examined::new(seen.to_owned(), Some(finding)));
    }
    let averaging = |basis: &&str| Ok(losses_of(&plain.averaged(basis)?, &plain));
    let averaging = BASES.iter().map(averaging).collect::<Result<Vec<Losses>, Hindrance>>()?;
    let [first, later] = [stretch.first, stretch.later].map(shown);
    let [first_turn, later_turn] = [rotation.first, rotation.later].map(shown);
    let measured = format!(
        "in units of h^2 (h: cell size), the moment of momentum decreases by {first} in the first \
         step and {later} in each later step of a stretch, and by {first_turn} and {later_turn} in \
         a rotation"
    );
    let finding = cause(patient, [stretch, rotation, small], &averaging);
    Ok(Examined::new(measured, finding))
}

/// Examines a stretching body, to find solvers that ignore the initial velocity, confuse vectors of
/// different points, or increase the velocity.
fn examine_initial_velocity(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = patient.able(&[2, 3, 1], &ANY_LAW, &|kind| scene(kind, &STRETCH))?;
    let course = patient.run(&scene)?;
    let speed = |k: usize| course.farthest(velocity, k, [0.0; 3]);
    let (start, first, end) = (speed(0), speed(1), speed(course.last()));
    let speeds = [start, first, end].map(shown);
    let measured = format!(
        "the largest speed is {} m/s at the start, {} after one step and {} at the end",
        speeds[0], speeds[1], speeds[2]
    );
    let defect = |name, cause, look_at| {
        let finding = SolverFinding::defect(name, measured.clone(), cause, look_at);
        Ok(Examined::new(measured.clone(), Some(finding)))
    };
    if !(end <= 10.0 * start) {
        return defect(
            "affine-matrix-scaled",
            "velocity gradients grow from step to step without stress: the affine matrix C is too \
             large by a power of h, or x_i - x_p is not the vector from the particle to the node",
            "the affine matrix C, which is B D^-1 in APIC, and has the factor 4/h^2 for quadratic \
             and 3/h^2 for cubic B-splines in MLS-MPM",
        );
    }
    let course = complete(course)?;
    if course.farthest(velocity, 1, course.mean(velocity, 1)) <= 1e-2 * start {
        return defect(
            "initial-velocity-dropped",
            "the solver ignores the initial velocities, or gives the same velocity to all \
             particles",
            "`particles.velocity` of the problem, which has one vector for each particle",
        );
    }
    let sorted = |numbers: &[f64], size: usize| {
        let mut all: Vec<Vec<i64>> = numbers
            .chunks_exact(size)
            .map(|x| x.iter().map(|x| libm::round(1e6 * x / start) as i64).collect())
            .collect();
        all.sort_unstable();
        all
    };
    let (before, after) = (&course.states[0].velocity, &course.states[1].velocity);
    let d = scene.dimension;
    if sorted(before, d) != sorted(after, d) && sorted(before, 1) == sorted(after, 1) {
        return defect(
            "vectors-in-another-layout",
            "columns of vectors are read or written component after component instead of point \
             after point",
            "the layout of vectors, which is point after point: x0 y0 x1 y1, not x0 x1 y0 y1",
        );
    }
    Ok(Examined::new(measured, None))
}

fn scene(kind: Kind, gradient: &[[f64; 3]; 3]) -> BoxScene {
    let mut scene = BoxScene::of_cells(kind, [0.271, 0.391, 0.141], 4.0, 3.0);
    scene.velocity = scene.linear(|i, j| gradient[i][j]);
    BoxScene { steps: STEPS, dt: 0.02, ..scene.soft() }
}

fn losses_of(course: &Course, scene: &BoxScene) -> Losses {
    let field = &scene.velocity;
    let (mut inertia, mut volume) = (0.0, 0.0);
    for ((_, v), weight) in course.points(velocity, 0).zip(&course.states[0].weight) {
        inertia += weight * v.dot(&v) / (RATE * RATE);
        volume += weight;
    }
    let moment = |k: usize| -> f64 {
        let all = course.points(velocity, k).zip(&course.states[0].weight);
        all.map(|((label, v), weight)| weight * field.at(label).dot(&v) / RATE).sum()
    };
    // Number of axes along which the motion has a gradient.
    let axes = field.gradient.iter().flatten().filter(|slope| **slope != 0.0).count() as f64;
    let unit = axes * volume * scene.h * scene.h / inertia;
    let last = course.last();
    let share = |from: usize, to: usize| (moment(from) - moment(to)) / moment(from) / unit;
    Losses { first: share(0, 1), later: share(2, last) / (last - 2) as f64, unit }
}

/// Returns the cause of losses from a comparison with those of averaging. `small` are the losses in
/// a stretch of a body of an eighth of the size.
fn cause(
    patient: &Patient<'_>,
    [stretch, rotation, small]: [Losses; 3],
    averaging: &[Losses],
) -> Option<SolverFinding> {
    let losses = [stretch.later, rotation.later, small.later];
    let [loss, of_rotation, of_small] = losses.map(shown);
    let [linear, cubic] = [averaging[0], averaging[averaging.len() - 1]].map(|l| shown(l.later));
    let seen = format!(
        "each step reduces the moment of momentum by {loss} h^2 in a stretch, by {of_rotation} h^2 \
         in a rotation, and by {of_small} h^2 in a stretch with all lengths divided by eight. PIC \
         averaging takes {linear} h^2 with linear and {cubic} h^2 with cubic functions. A correct \
         affine transfer or FLIP takes nothing"
    );
    if losses.iter().all(|loss| loss.abs() <= KEPT) {
        return first_step(stretch, rotation);
    }
    let look_at = "the affine matrix C_ab = dv_a/dx_b: its factor (B D^-1 in APIC; 4/h^2 for \
                   quadratic and 3/h^2 for cubic B-splines in MLS-MPM), its indices, and the sign \
                   of x_i - x_p";
    let defect = |name, cause| Some(SolverFinding::defect(name, seen.clone(), cause, look_at));
    let is_alike = |a: f64, b: f64| (a - b).abs() <= KEPT + NEAR * a.abs().max(b.abs());
    if stretch.later.abs() <= KEPT && rotation.later > KEPT {
        // A transposed matrix doubles the averaging loss in every step, or in every step except the
        // first if the matrix does not start with the velocity gradient.
        let averaged = averaging.iter().map(|l| l.first).fold(0.0, f64::max);
        let is_twice = rotation.later > 1.2 * rotation.first || rotation.first > 1.15 * averaged;
        return if is_twice {
            defect(
                "affine-matrix-transposed",
                "the affine matrix C is transposed, or its skew part has the wrong sign",
            )
        } else {
            defect(
                "rotation-lost",
                "the skew part of the affine matrix C is missing, so rotations are averaged",
            )
        };
    }
    if !is_alike(stretch.later, small.later) {
        return defect(
            "affine-matrix-scaled",
            "the effect of the velocity gradient depends on the unit of length: the affine matrix \
             C is wrong by a power of h",
        );
    }
    // Partial averaging affects all motions and steps equally. An affine matrix that starts at zero
    // averages completely in its first step, so only later steps show its effect.
    let most = averaging.iter().map(|l| l.later).fold(0.0, f64::max);
    let is_share = losses.iter().all(|loss| (-KEPT..=1.1 * most + KEPT).contains(loss));
    let of_basis = averaging.iter().find(|l| is_alike(l.first, stretch.first));
    let is_averaging = match of_basis {
        Some(of_basis) => is_alike(of_basis.later, stretch.later),
        // The factor 0.65 allows for the decay of the averaging error in later steps.
        None => stretch.later > 0.65 * stretch.first,
    };
    // The transfer may be a blend of PIC and FLIP, with any basis.
    let is_blend = averaging.iter().any(|l| {
        let share = stretch.first / l.first;
        let decay = 1.0 - share * (1.0 - l.later / l.first);
        share < 1.0 + NEAR && is_alike(stretch.later, stretch.first * decay)
    });
    let is_even =
        is_alike(stretch.later, rotation.later) && is_alike(stretch.first, rotation.first);
    // A solver with several shorter steps for each step averages as many times in each step.
    let is_repeated = || losses.iter().all(|loss| *loss > 0.0) && divides_steps(patient);
    let is_known = is_share && (is_averaging || is_blend);
    if !(is_even && (is_known || is_repeated())) {
        return defect(
            "affine-matrix-scaled",
            "the affine matrix C has a wrong factor or sign, or a part of C is missing: C does not \
             restore the momentum that averaging removes",
        );
    }
    Some(SolverFinding::remark(
        "momentum-spreads",
        seen,
        "velocities are averaged over cells in each step (PIC, or a share of PIC)",
        "the blend of PIC and FLIP. Smaller time steps increase the averaging, which acts as a \
         viscosity: waves are damped, and orders of convergence decrease. In an affine transfer \
         (APIC, MLS-MPM), the factor of the affine matrix C",
    ))
}

fn first_step(stretch: Losses, rotation: Losses) -> Option<SolverFinding> {
    let first = stretch.first.max(rotation.first);
    let loss = shown(first);
    let finding = SolverFinding::remark(
        "first-step-spreads",
        format!(
            "the first step reduces the moment of momentum by {loss} h^2, and later steps do not \
             change it"
        ),
        "particles start without the gradient of their velocity: the first step is a PIC step, \
         which averages velocities over cells",
        "the affine matrices at the start (APIC, MLS-MPM): use the gradient of the initial \
         velocity, from a fit to neighbouring particles or from one transfer without motion",
    );
    (first > 10.0 * KEPT).then_some(finding)
}

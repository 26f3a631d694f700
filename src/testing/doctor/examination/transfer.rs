//! The transfer of velocities between particles and grid, without stress: a body that turns or stretches.
//!
//! Weights that sum to one transfer a uniform velocity exactly, so that `translation` does not see how a
//! velocity gradient is transferred. With the velocity `v = L (X - C)` of a rotation or a stretch about
//! the centre C the moment `M = sum m (X - C) x v`, or `sum m (X - C) . v`, shows it. A transfer that
//! averages (PIC) loses `beta d D sum m L` of it in each step, where D is the second moment of the
//! weights along an axis, 1/4 h2 for quadratic and 1/3 h2 for cubic B-splines, and beta the share of PIC.
//! An affine transfer loses `1 - a` times as much if its matrix C is wrong by the factor a, twice as much
//! of a rotation if C is transposed, and nothing if C is right (Jiang et al. 2015, eq. 8 to 11).

use crate::testing::doctor::course::{Course, dot, shown, velocity};
use crate::testing::doctor::finding::SolverFinding;
use crate::testing::doctor::patient::{Examined, Hindrance, Patient};
use crate::testing::doctor::question::Examination;
use crate::testing::doctor::scene::{ANY, AffineField, BoxScene, Kind};

pub(super) const EXAMINATION: Examination = Examination {
    name: "transfer",
    expected: "a body without stress that turns or stretches slowly keeps its moment of momentum, or loses \
               the share that PIC loses",
    after: &["conversation", "rest", "translation", "force"],
    examine,
};

/// Rate of rotation or stretch (1/s): no point moves by more than 1e-4 of a cell.
const RATE: f64 = 1e-4;

/// Largest loss that averaging explains, over h2 and the inertia: that of cubic functions, and some room.
const AVERAGING: f64 = 0.36;

/// Loss (over h2 and the inertia) below which a transfer counts as one that keeps the moment.
const KEPT: f64 = 0.004;

/// Steps of each run.
const STEPS: u64 = 5;

/// A motion whose moment is examined.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Motion {
    Rotation,
    Stretch,
}

/// Losses of the moment, in units of `d h2 M/I`: that of the first step, and the mean of later steps.
#[derive(Debug, Clone, Copy)]
struct Losses {
    first: f64,
    later: f64,
}

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let plain = patient.able(&[2, 3, 1], &ANY, &|kind| scene(kind, Motion::Stretch))?;
    let kind = (plain.dimension, plain.law);
    let mut motions = vec![Motion::Stretch];
    if kind.0 > 1 {
        motions.push(Motion::Rotation);
    }
    let mut scenes: Vec<BoxScene> = motions.iter().map(|motion| scene(kind, *motion)).collect();
    scenes.push(plain.scaled(0.125, 1.0, 1.0));
    let courses = patient.run_all(&scenes)?;
    let losses: Vec<Losses> = courses.iter().zip(&scenes).map(|(c, s)| losses(c, s)).collect();
    let (stretch, small) = (losses[0], losses[losses.len() - 1]);
    let rotation = if kind.0 > 1 { losses[1] } else { stretch };
    let measured = format!(
        "in units of h2, the moment falls by {} in the first step and {} in later ones while the body \
         stretches, and by {} and {} while it turns",
        shown(stretch.first),
        shown(stretch.later),
        shown(rotation.first),
        shown(rotation.later)
    );
    Ok(Examined::new(measured, cause(stretch, rotation, small).into_iter().collect()))
}

/// A soft body with the motion about its centre.
fn scene(kind: Kind, motion: Motion) -> BoxScene {
    let mut scene = BoxScene::of_cells(kind, [0.271, 0.391, 0.141], 4.0, 3.0);
    let mut field = AffineField { centre: scene.centre(), ..AffineField::default() };
    match motion {
        Motion::Rotation => {
            field.gradient[0][1] = -RATE;
            field.gradient[1][0] = RATE;
        }
        Motion::Stretch => (0..kind.0).for_each(|i| field.gradient[i][i] = RATE),
    }
    scene.velocity = field;
    BoxScene { steps: STEPS, dt: 0.02, ..scene.soft() }
}

fn losses(course: &Course, scene: &BoxScene) -> Losses {
    let field = &scene.velocity;
    let (mut inertia, mut volume) = (0.0, 0.0);
    for ((_, v), weight) in course.points(velocity, 0).zip(&course.states[0].weight) {
        inertia += weight * dot(v, v) / (RATE * RATE);
        volume += weight;
    }
    let moment = |k: usize| -> f64 {
        let all = course.points(velocity, k).zip(&course.states[0].weight);
        all.map(|((label, v), weight)| weight * dot(field.at(label), v) / RATE).sum()
    };
    // Axes along which the motion has a gradient.
    let axes = field.gradient.iter().flatten().filter(|slope| **slope != 0.0).count() as f64;
    let unit = axes * volume * scene.h * scene.h / inertia;
    let last = course.last();
    let share = |from: usize, to: usize| (moment(from) - moment(to)) / moment(from) / unit;
    Losses { first: share(0, 1), later: share(1, last) / (last - 1) as f64 }
}

/// The finding on losses of a stretch, of a rotation, and of the stretch of a body an eighth of the size.
fn cause(stretch: Losses, rotation: Losses, small: Losses) -> Option<SolverFinding> {
    let seen = format!(
        "each step takes {} h2 of the moment of a stretch and {} h2 of that of a rotation, and {} h2 of a \
         stretch if all lengths are an eighth; averaging takes 0.25 h2 with quadratic and 0.33 h2 with \
         cubic functions, a correct affine transfer or FLIP nothing",
        shown(stretch.later),
        shown(rotation.later),
        shown(small.later)
    );
    let losses = [stretch.later, rotation.later, small.later];
    if losses.iter().all(|loss| loss.abs() <= KEPT) {
        return first_step(stretch, rotation);
    }
    let look_at = "the affine matrix C (B D^-1 in APIC; 4/h2 for quadratic and 3/h2 for cubic B-splines in \
                   MLS-MPM): C_ab = dv_a/dx_b, its factor, its indices, and the sign of x_i - x_p";
    let defect = |name, cause| Some(SolverFinding::defect(name, seen.clone(), cause, look_at));
    let is_averaging = |loss: f64| (-KEPT..=AVERAGING).contains(&loss);
    // Averaging treats both motions alike.
    let is_even = (stretch.later - rotation.later).abs()
        <= KEPT + 0.1 * stretch.later.abs().max(rotation.later.abs());
    if !is_even && stretch.later.abs() <= KEPT {
        return if rotation.later > 1.5 * rotation.first {
            defect(
                "affine-matrix-transposed",
                "the affine matrix C is transposed, or its skew part has the other sign",
            )
        } else {
            defect(
                "rotation-lost",
                "the skew part of the affine matrix C is missing: rotations are averaged",
            )
        };
    }
    let has_unit = !((stretch.later - small.later).abs() <= KEPT + 0.03 * stretch.later.abs());
    if has_unit {
        return defect(
            "affine-matrix-scaled",
            "the effect of the velocity gradient depends on the unit of length: the affine matrix C is \
             wrong by a power of h",
        );
    }
    if !losses.into_iter().all(is_averaging) || !is_even {
        return defect(
            "affine-matrix-scaled",
            "the affine matrix C is wrong by a factor or a sign, so that velocity gradients grow or \
             overshoot",
        );
    }
    // Averaging takes as much in later steps as in the first one. An affine matrix that starts at zero
    // and is too small afterwards takes less.
    if stretch.later < 0.5 * stretch.first {
        return defect(
            "affine-matrix-scaled",
            "the affine matrix C is too small: it restores only a part of what averaging takes",
        );
    }
    Some(SolverFinding::remark(
        "momentum-spreads",
        seen,
        "velocities are averaged over cells in each step (PIC, or a share of PIC)",
        "the blend of PIC and FLIP; the smaller the step, the larger the viscosity: waves are damped, and \
         orders of convergence fall. In an affine transfer (APIC), a matrix C that is almost zero",
    ))
}

/// The remark on a first step that averages, in a scheme whose later steps do not.
fn first_step(stretch: Losses, rotation: Losses) -> Option<SolverFinding> {
    let first = stretch.first.max(rotation.first);
    (first > 10.0 * KEPT).then(|| {
        SolverFinding::remark(
            "first-step-spreads",
            format!("the first step takes {} h2 of the moment, later steps nothing", shown(first)),
            "particles start without the gradient of their velocity: the first step is one of PIC, which \
             averages velocities over cells",
            "affine matrices (APIC, MLS-MPM) at the start: grad v of the initial velocity, from a fit \
             through neighbours or one transfer without motion",
        )
    })
}

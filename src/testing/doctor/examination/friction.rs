//! Examinations of Coulomb friction between a body and a wall, and between two bodies.
//!
//! While all of a contact slides, the tangential impulse is mu times the normal impulse, for any
//! motion of the bodies. Both impulses follow from the mean velocities of a body.

use crate::testing::doctor::prelude::*;

pub(super) const EXAMINATION: Examination = Examination {
    name: "friction",
    expected: "a body that slides along a wall loses mu times the normal impulse, stops and stays, \
               and leaves the wall without force",
    after: &["translation", "fall", "transfer", "stress", "vibration"],
    covers: &["conditions: friction"],
    examine: examine_wall,
};

pub(super) const CONTACT: Examination = Examination {
    name: "contact",
    expected: "two bodies that collide exert the force rho c v/2 per area (v: relative velocity) \
               and mu times this force along their common face, and separate without force",
    after: &["translation", "transfer", "stress", "vibration"],
    covers: &["several_bodies", "contact"],
    examine: examine_contact,
};

const MU: f64 = 0.3;
/// Gravity (m/s2) that presses the body on the wall.
const GRAVITY: f64 = 1e-3;
/// Relative speed of bodies that collide or separate, relative to the wave speed.
const SPEED: f64 = 1e-3;

/// While all nodes of a contact slide, the ratio of the impulses is exact. The normal force of a
/// wall oscillates, that of a collision is smoothed, and a body that has stopped vibrates.
const RULES: Rules<4> = Rules {
    quantities: [
        ("normal force", 1.0, 0.5),
        ("friction, divided by mu times the normal force", 1.0, 0.15),
        ("force during separation", 0.0, 0.1),
        ("velocity after the stop, divided by the initial velocity", 0.0, 0.7),
    ],
    findings: &[
        (
            "contact-missing",
            [0.0, ANY, 0.0, ANY],
            "the contact exerts no force: bodies pass through the wall or through each other",
        ),
        (
            "contact-pulls",
            [1.0, ANY, 1.0, ANY],
            "the contact also acts on bodies that separate, as if they were bonded",
        ),
        ("friction-missing", [1.0, 0.0, 0.0, ANY], "the contact exerts no friction"),
        (
            "friction-pushes",
            [1.0, -1.0, 0.0, ANY],
            "the friction force has the direction of the sliding velocity",
        ),
        (
            "friction-reverses",
            [1.0, 1.0, 0.0, ANY],
            "friction does not end when the body stops, and pushes it back",
        ),
        (
            "friction-differs",
            [1.0, ANY, 0.0, ANY],
            "the friction force is not mu times the normal force: another factor, no limit \
             (sticking), or a normal force of another time",
        ),
        ("contact-differs", [ANY; 4], "the normal force of the contact is wrong"),
    ],
    look_at: "nodes on a wall with `friction`, or nodes that both bodies reach: the normal \
              velocity changes only where the bodies approach each other; the tangential velocity \
              changes by at most mu times the normal change, and at most to zero",
};

/// Creates a body next to the wall at the low end of the last axis or the high end of the first.
fn on_wall(kind: Kind, high: bool, share: f64, pull: bool) -> BoxScene {
    let (axis, other) = sides(kind, high);
    let scene = BoxScene::of_cells(kind, [0.75, 0.25, 0.5], 4.0, 2.0);
    let mut scene = BoxScene { young: 3.1, ..scene }.with_waves(24.0, 96);
    let (ends, body) =
        if high { (&mut scene.grid.1, &scene.body.1) } else { (&mut scene.grid.0, &scene.body.0) };
    ends[axis] = body[axis];
    scene.extras.walls.push((FACES[axis][usize::from(high)], format!("{{friction: {MU}}}")));
    let outwards = if high { 1.0 } else { -1.0 };
    let at = |i: usize, normal: f64, along: f64| match i {
        i if i == axis => normal,
        i if i == other => along,
        _ => 0.0,
    };
    if pull {
        let speed = -outwards * SPEED * scene.wave_speed();
        scene.velocity = AffineField::uniform(std::array::from_fn(|i| at(i, speed, 0.0)));
    } else {
        let speed = share * MU * GRAVITY * scene.end();
        scene.velocity = AffineField::uniform(std::array::from_fn(|i| at(i, 0.0, speed)));
        scene.gravity = Some((0..kind.0).map(|i| at(i, outwards * GRAVITY, 0.0)).collect());
    }
    scene
}

/// Returns the normal axis of a wall, and the axis along which the body slides.
fn sides(kind: Kind, high: bool) -> (usize, usize) {
    if high { (0, 1) } else { (kind.0 - 1, 0) }
}

fn examine_wall(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = patient.able(&[2, 3], &ELASTIC, &|kind| on_wall(kind, false, 10.0, false))?;
    let kind = (scene.dimension, scene.law);
    let row = |high: bool| -> Result<Row<4>, Hindrance> {
        // The second body would stop after a fifth of the run.
        let runs = [(10.0, false), (0.2, false), (0.0, true)];
        let scenes = runs.map(|(share, pull)| on_wall(kind, high, share, pull));
        let courses = patient.run_all(&scenes)?;
        let (axis, other) = sides(kind, high);
        let outwards = if high { 1.0 } else { -1.0 };
        let speed = |run: usize, k: usize, i: usize| courses[run].mean(velocity, k)[i];
        let start = |run: usize, i: usize| scenes[run].velocity.value[i];
        let times = &courses[0].times;
        let last = courses[0].last();
        let normal: Vec<f64> =
            (0..=last).map(|k| GRAVITY * times[k] - outwards * speed(0, k, axis)).collect();
        let along: Vec<f64> = (0..=last).map(|k| start(0, other) - speed(0, k, other)).collect();
        let late = last / 2..=last;
        let stopped = late.clone().map(|k| speed(1, k, other)).sum::<f64>() / late.count() as f64;
        Ok((
            FACES[axis][usize::from(high)].to_owned(),
            [
                Some(line(times, &normal).1 / GRAVITY),
                Some(line(&normal, &along).1 / MU),
                Some(1.0 - speed(2, courses[2].last(), axis) / start(2, axis)),
                Some(stopped / start(1, other)),
            ],
        ))
    };
    let rows = [row(false)?, row(true)?];
    Ok(RULES.judge(&rows))
}

/// Creates bodies with a common face; the second moves against the first (`way` -1) or away (1).
fn colliding(kind: Kind, axis: usize, way: f64) -> BoxScene {
    let mut scene = BoxScene::of_cells(kind, [0.75, 0.25, 0.5], 6.0, 2.0);
    (scene.young, scene.poisson) = (3.1, 0.0);
    scene.grid.1[axis] += 6.0 * H;
    scene.extras.contact = Some(if kind.0 > 1 { MU } else { 0.0 });
    let mut second = scene.clone();
    second.body.0[axis] = scene.body.1[axis];
    second.body.1[axis] += 6.0 * H;
    let speed = SPEED * scene.wave_speed();
    let mut velocity = [0.0; 3];
    if kind.0 > 1 {
        velocity[(axis + 1) % kind.0] = 3.0 * speed;
    }
    velocity[axis] = way * speed;
    second.velocity = AffineField::uniform(velocity);
    scene.extras.second = Some(Box::new(second));
    scene.with_waves(6.0, 24)
}

fn examine_contact(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = patient.able(&[2, 1, 3], &ELASTIC, &|kind| colliding(kind, 0, -1.0))?;
    let kind = (scene.dimension, scene.law);
    let row = |axis: usize| -> Result<Row<4>, Hindrance> {
        let scenes = [-1.0, 1.0].map(|way| colliding(kind, axis, way));
        let courses = patient.run_all(&scenes)?;
        let times = &courses[0].times;
        let lower: Vec<Course> =
            courses.iter().map(|course| course.within(&scenes[0].body)).collect();
        let gained = |run: usize, i: usize| -> Vec<f64> {
            (0..=lower[run].last()).map(|k| lower[run].mean(velocity, k)[i]).collect()
        };
        let force = |run: usize| {
            let c = scenes[0].wave_speed();
            -6.0 * H * line(times, &gained(run, axis)).1 / (0.5 * SPEED * c * c)
        };
        let pressed: Vec<f64> = gained(0, axis).iter().map(|v| -v).collect();
        let other = (axis + 1) % kind.0;
        let ratio = (kind.0 > 1).then(|| line(&pressed, &gained(0, other)).1 / MU);
        Ok((
            format!("along {}", ["x", "y", "z"][axis]),
            [Some(force(0)), ratio, Some(-force(1)), None],
        ))
    };
    let rows = (0..kind.0).map(row).collect::<Result<Vec<_>, _>>()?;
    Ok(RULES.judge(&rows))
}

//! Examination of damping loads on a body in uniform motion.
//!
//! With `damping` of the rate c(t), the velocity is `v0 exp(-int c dt)`. With `local_damping` of
//! the share s, the acceleration under gravity g is `g (1 - s)` downwards and `g (1 + s)` upwards.

use super::stress::constant_and_rate;
use crate::testing::doctor::prelude::*;

pub(super) const EXAMINATION: Examination = Examination {
    name: "damping",
    expected: "damping of the rate c reduces a uniform velocity as exp(-c t), and local damping of \
               the share s changes gravity g to g (1 - s) for a falling body",
    after: &["translation", "fall", "force"],
    covers: &["loads: damping", "loads: local_damping"],
    examine,
};

/// Rate of damping (1/s).
const RATE: f64 = 0.4;
const SHARE: f64 = 0.3;
/// Gravity (m/s2).
const GRAVITY: f64 = 0.9;

/// A step of first order has a rate error `c dt/2` of 0.4 %; the rate of its end is 2 % larger.
const RULES: Rules<4> = Rules {
    quantities: [
        ("rate of damping", 1.0, 0.05),
        ("growth of the rate", 1.0, 0.05),
        ("share of local damping of a falling body", 1.0, 0.05),
        ("of a rising body", 1.0, 0.05),
    ],
    findings: &[
        ("damping-missing", [0.0, 0.0, ANY, ANY], "damping has no effect"),
        (
            "damping-of-one-time",
            [1.0, 0.0, ANY, ANY],
            "a rate that varies in time keeps the value of the start",
        ),
        (
            "damping-doubled",
            [2.0, 2.0, ANY, ANY],
            "velocities are damped twice, for example at nodes and again at particles",
        ),
        ("damping-sign", [-1.0, -1.0, ANY, ANY], "damping has the wrong sign"),
        ("local-damping-missing", [1.0, 1.0, 0.0, 0.0], "local damping has no effect"),
        (
            "local-damping-differs",
            [1.0, 1.0, ANY, ANY],
            "the force of local damping has a wrong factor or sign",
        ),
        ("damping-differs", [ANY; 4], "the rate of damping has a wrong factor or time"),
    ],
    look_at: "`damping`: the acceleration -c v, once per step, with the rate c (1/s) at the time of \
              the step and without mass or volume; `local_damping`: -share |f| sign(v), added to \
              the force f of a node for each axis, with all loads in f",
};

fn scene(kind: Kind, speed: f64, load: String) -> BoxScene {
    let mut scene = BoxScene::of_cells(kind, [0.2625, 0.3875, 0.1375], 4.0, 8.0).soft();
    scene.velocity = AffineField::along(kind.0 - 1, speed);
    scene.extras.loads.push(load);
    BoxScene { steps: 50, dt: 0.02, ..scene }
}

/// Creates a body with a constant rate of damping, and one whose rate grows from zero.
fn damped(kind: Kind) -> [BoxScene; 2] {
    [RATE.to_string(), format!("{RATE}*t")].map(|c| scene(kind, 0.25, format!("damping: {c}")))
}

fn locally_damped(kind: Kind) -> [BoxScene; 2] {
    [-0.125, 1.5 * GRAVITY].map(|speed| {
        let scene = scene(kind, speed, format!("local_damping: {SHARE}"));
        let down = |i| if i + 1 == kind.0 { -GRAVITY } else { 0.0 };
        BoxScene { gravity: Some((0..kind.0).map(down).collect()), ..scene }
    })
}

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    type Part = (fn(Kind) -> [BoxScene; 2], fn(&[Course]) -> [f64; 2]);
    let (mut values, mut lacks) = ([None; 4], Vec::new());
    let parts: [Part; 2] = [(damped, rates), (locally_damped, shares)];
    for (k, (scenes, measure)) in parts.into_iter().enumerate() {
        match patient.able(&[2, 3, 1], &ANY_LAW, &|kind| scenes(kind)[1].clone()) {
            Ok(scene) => {
                let courses = patient.run_all(&scenes((scene.dimension, scene.law)))?;
                values[2 * k..][..2].copy_from_slice(&measure(&courses).map(Some));
            }
            Err(Hindrance::Lacks(what)) => lacks.push(what),
            Err(broke) => return Err(broke),
        }
    }
    match lacks.len() {
        2 => Err(Hindrance::Lacks(lacks.join("; "))),
        _ => Ok(RULES.judge(&[("divided by the requested values".to_owned(), values)])),
    }
}

/// Returns the mean velocity (m/s) along the last axis after each step.
fn speeds(course: &Course) -> Vec<f64> {
    let axis = course.problem.dimension - 1;
    (1..=course.last()).map(|k| course.mean(velocity, k)[axis]).collect()
}

fn rates(courses: &[Course]) -> [f64; 2] {
    let logs = |course| speeds(course).iter().map(|v| -libm::log(*v)).collect::<Vec<_>>();
    let (_, constant, _) = line(&courses[0].times[1..], &logs(&courses[0]));
    let [_, growth] = constant_and_rate(&courses[1].times[1..], &logs(&courses[1]));
    [constant / RATE, growth / RATE]
}

fn shares(courses: &[Course]) -> [f64; 2] {
    let slope = |course: &Course| line(&course.times[1..], &speeds(course)).1;
    [1.0, -1.0].map(|sign| {
        let course = &courses[usize::from(sign < 0.0)];
        sign * (1.0 + slope(course) / GRAVITY) / SHARE
    })
}

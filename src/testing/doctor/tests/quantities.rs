//! Examinations that judge quantities by a table of expected values. Each quantity has a value just
//! inside and one just outside of its tolerance.

use super::{PointState, check};
use crate::external::LevelProblem;
use crate::testing::change::FACES;
use nalgebra::Vector3;

/// Wave speed (m/s) of a bar with E = 3.1 Pa, nu = 0 and 1.7 kg/m3.
fn bar_speed() -> f64 {
    libm::sqrt(3.1 / 1.7)
}

/// Returns a state with this velocity along an axis and along another one.
fn moving(axis: usize, speed: f64, other: usize, along: f64) -> PointState {
    let mut state = PointState::default();
    (state.v[axis], state.v[other]) = (speed, along);
    state
}

fn axis_of(face: &str) -> (usize, bool) {
    let axis = FACES.iter().position(|pair| pair.contains(&face)).expect("a face");
    (axis, FACES[axis][1] == face)
}

#[test]
fn damping_has_its_rate_and_share() {
    let motion = |q: [f64; 4]| {
        move |problem: &LevelProblem, _, step: u64| {
            let (t, v0) = (step as f64 * problem.dt, problem.particles.velocity[1]);
            let load = problem.loads.iter().find(|load| load.load.ends_with("damping"));
            let load = load.expect("damping");
            let v = match (load.load, load.numbers.asked.is_empty()) {
                ("local_damping", _) if v0 < 0.0 => v0 - 0.9 * (1.0 - 0.3 * q[2]) * t,
                ("local_damping", _) => v0 - 0.9 * (1.0 + 0.3 * q[3]) * t,
                (_, true) => v0 * libm::exp(-0.4 * q[0] * t),
                (_, false) => v0 * libm::exp(-0.2 * q[1] * t * t),
            };
            moving(1, v, 0, 0.0)
        }
    };
    let rows = "
0.955 1.045 1.042 0.958 |                       | rate of damping 0.9550, growth of the rate 1.045, share
0.945 1.0 1.0 1.0       | damping-differs       | rate of damping 0.9450
1.0 1.055 1.0 1.0       | damping-differs       | growth of the rate 1.055
1.0 1.0 0.945 1.0       | local-damping-differs | of a falling body 0.9450
1.0 1.0 1.0 1.055       | local-damping-differs | of a rising body 1.055
0.045 -0.045 1.0 1.0    | damping-missing       | rate of damping 0.04500
0.055 0.0 1.0 1.0       | damping-differs       |
1.0 0.045 1.0 1.0       | damping-of-one-time   |
2.095 1.905 1.0 1.0     | damping-doubled       |
2.105 2.0 1.0 1.0       | damping-differs       |
-0.955 -1.045 1.0 1.0   | damping-sign          |
1.0 1.0 0.045 -0.045    | local-damping-missing |
";
    check(2, "damping", motion, rows);
}

#[test]
fn traction_has_its_force_and_face() {
    let motion = |q: [f64; 4]| {
        move |problem: &LevelProblem, label: Vector3<f64>, step: u64| {
            let (axis, high) = axis_of(problem.loads[0].face.expect("a face"));
            let end = problem.steps as f64 * problem.dt;
            let t = step as f64 * problem.dt;
            let body = &problem.bodies[0];
            let is_upper = label[axis] > 0.5 * (body.from[axis] + body.to[axis]);
            let share = if is_upper == high { 2.0 * q[3] } else { 2.0 - 2.0 * q[3] };
            // The momentum per area is p t + p t^2/(2 T) at a high face; the body is 0.5 m long.
            let impulse = |pressure: f64, factor: f64, growth: f64| {
                let growth = if high { 0.5 * growth * t * t / end } else { 0.0 };
                pressure * (factor * t + growth) / (1.7 * 0.5)
            };
            let normal = impulse(3.1e-4, q[0], q[2]);
            moving(axis, share * normal, 1 - axis, impulse(-2.17e-4, q[1], 1.0))
        }
    };
    let rows = "
1.09 0.91 1.28 0.55 |                            | left: force along the normal 1.090, along the face
0.91 1.09 0.72 1.45 |                            | top: force along the normal 0.9100, along the face
1.11 1.0 1.0 1.0    | traction-differs           | bottom: force along the normal 1.110
1.0 0.89 1.0 1.0    | traction-differs           | along the face 0.8900
1.0 1.0 1.32 1.0    | traction-differs           | right: force along the normal 1.000
1.0 1.0 1.0 0.45    | traction-on-another-face   | next to the face 0.4500
0.09 -0.09 0.28 1.0 | traction-missing           |
1.09 0.91 0.28 1.0  | traction-of-one-time       | growth with time 0.2800
1.0 0.09 1.0 1.0    | traction-along-normal-only |
0.5 0.5 0.5 1.0     | traction-halved            |
2.0 2.0 2.0 1.0     | traction-doubled           |
-1.0 -1.0 -1.0 1.0  | traction-sign              | normal -1.000
";
    check(2, "traction", motion, rows);
}

#[test]
fn moving_wall_has_its_force_and_displacement() {
    let motion = |q: [f64; 4]| {
        move |problem: &LevelProblem, label: Vector3<f64>, step: u64| {
            let wall = problem.faces.iter().find(|face| face.condition == "velocity");
            let wall = wall.expect("a wall");
            let (axis, high) = (wall.axis, wall.high);
            let (t, end) = (step as f64 * problem.dt, problem.steps as f64 * problem.dt);
            let (c, depth) = (bar_speed(), (label[axis] - wall.at).abs());
            let normal = if high { -1e-3 } else { 1e-3 } * c;
            // The force rho c v per area acts on a bar of 2 m; v = v(T) t/T at high ends.
            let impulse = if high { 0.5 * q[1] * t * t / end } else { q[0] * t };
            let mut state = moving(axis, c * normal * impulse / 2.0, 1 - axis, 0.0);
            let way = if high { 0.5 } else { 1.0 } * end * (1.0 - 2.0 * depth);
            (state.u[axis], state.u[1 - axis]) = (q[2] * normal * way, q[3] * 6e-4 * c * way);
            state
        }
    };
    let rows = "
1.45 0.72 1.28 0.72   |                                  | left: force 1.450, displacement along
0.45 1.0 1.0 1.0      | wall-velocity-without-force      | bottom: force 0.4500
1.55 1.0 1.0 1.0      | wall-velocity-differs            | left: force 1.550
1.0 1.32 1.0 1.0      | wall-velocity-differs           | top: growth of the force 1.320
1.0 1.0 1.32 1.0      | wall-velocity-differs           | along the normal 1.320
1.0 1.0 1.0 0.68      | wall-velocity-differs           | along the wall 0.6800
0.45 0.28 0.28 1.0    | wall-velocity-missing           |
0.45 0.28 0.72 1.0    | wall-velocity-without-force     |
-0.55 -0.72 -1.28 1.0 | wall-velocity-sign              |
1.0 1.0 1.0 0.28      | wall-velocity-along-normal-only |
";
    check(16, "moving-wall", motion, rows);
}

#[test]
fn friction_has_its_impulses() {
    let motion = |q: [f64; 4]| {
        move |problem: &LevelProblem, _, step: u64| {
            let wall = problem.faces.iter().find(|face| face.condition == "friction");
            let wall = wall.expect("a wall");
            let (axis, other) = (wall.axis, 1 - wall.axis);
            let v0 = &problem.particles.velocity;
            let (t, end) = (step as f64 * problem.dt, problem.steps as f64 * problem.dt);
            let weight = if wall.high { 1e-3 } else { -1e-3 };
            if problem.loads.is_empty() {
                return moving(axis, (1.0 - q[2]) * v0[axis], other, 0.0);
            }
            // The initial speeds are 10 and 0.2 times that which friction stops in the whole run.
            if v0[other] < 0.3 * 1e-3 * end {
                let share = if 2 * step < problem.steps { 1.0 } else { q[3] };
                return moving(axis, 0.0, other, share * v0[other]);
            }
            let along = v0[other] - q[1] * 0.3 * q[0] * 1e-3 * t;
            moving(axis, (1.0 - q[0]) * weight * t, other, along)
        }
    };
    let rows = "
1.45 0.86 0.09 0.68   |                   | bottom: normal force 1.450, friction, divided by
0.55 1.14 -0.09 -0.68 |                   | normal force 0.5500
1.55 1.0 0.0 0.0      | contact-differs   | normal force 1.550
1.0 0.84 0.0 0.0      | friction-differs  | the normal force 0.8400
1.0 1.0 0.11 0.0      | contact-differs   | during separation 0.1100
1.0 1.0 0.0 0.72      | friction-reverses | the initial velocity 0.7200
0.45 1.0 0.0 0.0      | contact-missing   |
1.0 1.0 0.91 0.0      | contact-pulls     |
1.0 0.14 0.0 0.0      | friction-missing  |
1.0 -0.86 0.0 0.0     | friction-pushes   |
";
    check(2, "friction", motion, rows);
}

#[test]
fn contact_has_its_forces() {
    let motion = |q: [f64; 3]| {
        move |problem: &LevelProblem, label: Vector3<f64>, step: u64| {
            let [low, high] = [&problem.bodies[0], &problem.bodies[1]];
            let axis = usize::from(low.to[0] != high.from[0]);
            if label[axis] > low.to[axis] {
                // Only the lower body is measured.
                return moving(axis, 7.0, 1 - axis, -5.0);
            }
            let t = step as f64 * problem.dt;
            let velocity = &problem.particles.velocity;
            let approach = velocity[velocity.len() - 2 + axis] < 0.0;
            // The force rho c (c/1000)/2 per area acts on a body of 0.75 m.
            let speed = |force: f64| force * 0.5e-3 * 3.1 / 1.7 / 0.75 * t;
            if approach {
                moving(axis, -speed(q[0]), 1 - axis, q[1] * 0.3 * speed(q[0]))
            } else {
                moving(axis, speed(q[2]), 1 - axis, 0.0)
            }
        }
    };
    let rows = "
1.45 0.86 0.09 |                  | along x: normal force 1.450, friction, divided by mu times
1.55 1.0 0.0   | contact-differs  | normal force 1.550
1.0 1.16 0.0   | friction-differs | the normal force 1.160
1.0 1.0 0.11   | contact-differs  | during separation 0.1100
0.0 1.0 0.0    | contact-missing  |
1.0 1.0 1.0    | contact-pulls    | during separation 1.000
";
    check(2, "contact", motion, rows);
}

#[test]
fn alternating_mode_stays_small() {
    let motion = |[share]: [f64; 1]| {
        move |problem: &LevelProblem, label: Vector3<f64>, step: u64| {
            // The wave speed for E = 3.1 Pa, nu = 0.3 and 1.7 kg/m3: c^2 = E (0.7)/(1.3 0.4)/rho.
            let c = libm::sqrt(3.1 * 0.7 / 0.52 / 1.7);
            let wave = |i: usize| {
                let cells = (label[i] - problem.bodies[0].from[i]) / 0.125;
                libm::cos(std::f64::consts::PI * cells)
            };
            let way = 1e-4 * c * problem.dt * step as f64;
            PointState {
                u: share * way * wave(0) * wave(1) * Vector3::x(),
                ..PointState::default()
            }
        }
    };
    let rows = "
0.39  |                | time 0.3900
0.41  | hourglass-mode | 0.4100
-0.41 | hourglass-mode |
";
    check(0, "hourglass", motion, rows);
}

#[test]
fn kinetic_energy_of_a_vibration_does_not_grow() {
    let motion = |[energy, at]: [f64; 2]| {
        move |problem: &LevelProblem, label: Vector3<f64>, step: u64| {
            let factor = if step == at as u64 { libm::sqrt(energy) } else { 0.5 };
            let body = &problem.bodies[0];
            let centre = 0.5 * (body.from[0] + body.to[0]);
            moving(0, factor * 1e-5 * (label[0] - centre), 1, 0.0)
        }
    };
    let rows = "
1.29 40.0 |                 | in 80 of 80 steps, the kinetic energy is at most 1.290 times
1.31 40.0 | vibration-grows | at most 1.310 times
1.31 80.0 | vibration-grows | at most 1.310 times
NaN 1.0   | vibration-grows | at most inf times
";
    check(0, "vibration", motion, rows);
}

#[test]
fn load_steps_have_their_shares() {
    let motion = |q: [f64; 7]| {
        move |problem: &LevelProblem, label: Vector3<f64>, step: u64| {
            let body = &problem.bodies[0];
            let (x, y) = (label[0] - body.from[0], label[1] - body.from[1]);
            let share = match (problem.steps, step) {
                (_, 0) => 0.0,
                (1, _) => q[0],
                (_, k) => q[k as usize],
            };
            let side = if y > 0.5 { q[6] } else { -q[6] };
            // The column is 1 m high, with a strain of 0.004 at its foot.
            let u = 0.004 * (share * (0.5 * x * x - x) + 0.5 * side);
            PointState { u: u * Vector3::x(), ..PointState::default() }
        }
    };
    let rows = "
1.03 0.17 0.43 0.57 0.83 1.03 0.03 |                    | of one 1.030, of five 0.1700, after two
1.04 0.2 0.4 0.6 0.8 1.0 0.0       | column-differs     | of one 1.040
1.0 0.24 0.4 0.6 0.8 1.0 0.0       | load-steps-differ  | of five 0.2400
1.0 0.2 0.36 0.6 0.8 1.0 0.0       | load-steps-differ  | after two 0.3600
1.0 0.2 0.4 0.64 0.8 1.0 0.0       | load-steps-differ  | after three 0.6400
1.0 0.2 0.4 0.6 0.8 0.96 0.0       | load-steps-differ  | after five 0.9600
1.0 0.2 0.4 0.6 0.8 1.0 0.04       | load-steps-differ  | profile 0.04000
1.0 1.0 1.0 1.0 1.0 1.0 0.0        | load-not-ramped    |
1.0 1.0 2.0 3.0 4.0 5.0 0.0        | load-per-step      |
0.0 0.0 0.2 0.4 0.6 0.8 0.0        | load-one-step-late |
";
    check(0, "load-steps", motion, rows);
}

#[test]
fn ends_of_a_periodic_axis_stop_each_other() {
    let motion = |lost: [f64; 2]| {
        move |problem: &LevelProblem, label: Vector3<f64>, step: u64| {
            let axis = usize::from(problem.grid.periodic[1]);
            let body = &problem.bodies[0];
            let x = label[axis] - 0.5 * (body.from[axis] + body.to[axis]);
            let is_late = step == problem.steps && x > 0.0;
            moving(axis, 1e-3 * x * if is_late { 1.0 - lost[axis] } else { 1.0 }, 1 - axis, 0.0)
        }
    };
    let rows = "
0.41 0.52 |               | transfers 0.5200 of its momentum
0.39 0.9  | periodic-axis | along x: one half of the body transfers 0.3900
0.9 0.39  | periodic-axis | along y: one half of the body transfers 0.3900
";
    check(0, "periodic-ends", motion, rows);
}

/// A stretch by the ratio of the particle mass to density times volume, which is one in all units.
/// Column: factor of the displacements of particles with less than 1e-12 kg.
#[test]
fn units_have_no_effect() {
    let stretched = |[light]: [f64; 1]| {
        move |problem: &LevelProblem, label: Vector3<f64>, _| {
            let (body, particles) = (&problem.bodies[0], &problem.particles);
            let mass = problem.materials[0].density * particles.reference_volume[0];
            let factor = if mass < 1e-12 { light } else { 1.0 };
            let centre = |i: usize, _| if i < 2 { 0.5 * (body.from[i] + body.to[i]) } else { 0.0 };
            let u = (label - Vector3::from_fn(centre)) * (factor * particles.mass[0] / mass);
            PointState { u, ..PointState::default() }
        }
    };
    let rows = "
1.0  |                  | small lengths 0, small times 0, small masses 0
1.05 | depends-on-units | with small masses (displacement: 0.05000)
";
    check(0, "symmetry", stretched, rows);
}

//! Examinations of motions without stress: just inside and just outside of each tolerance.

use super::{MadeUp, PointState, assert_found, check, examine_with};
use crate::external::LevelProblem;
use crate::subject::Precision;
use nalgebra::{Matrix3, Vector3};
use std::sync::atomic::{AtomicU32, Ordering};

/// Cell size (m) of the scenes.
const H: f64 = 0.125;

fn state(u: Vector3<f64>, v: Vector3<f64>) -> PointState {
    PointState { u, v, tensors: None }
}

fn at(x: f64, y: f64) -> Vector3<f64> {
    Vector3::new(x, y, 0.0)
}

fn time(problem: &LevelProblem, step: u64) -> f64 {
    step as f64 * problem.dt
}

fn initial_velocity(problem: &LevelProblem) -> Vector3<f64> {
    at(problem.particles.velocity[0], problem.particles.velocity[1])
}

fn is_soft(problem: &LevelProblem) -> bool {
    problem.materials[0].parameter("young") < 1e-9
}

/// Returns the position relative to the centre of the body.
fn from_centre(problem: &LevelProblem, label: Vector3<f64>) -> Vector3<f64> {
    let body = &problem.bodies[0];
    label - at(0.5 * (body.from[0] + body.to[0]), 0.5 * (body.from[1] + body.to[1]))
}

/// Uniform displacements (cells) and velocities, relative to the wave speed for E = 3 Pa, nu = 0.3
/// and 1.7 kg/m3.
#[test]
fn body_at_rest_does_not_move() {
    let still = |[way, speed]: [f64; 2]| {
        let c = libm::sqrt(3.0 * 0.7 / 0.52 / 1.7);
        move |_: &LevelProblem, _, _| state(at(way * H, 0.0), at(0.0, speed * c))
    };
    let still_rows = "
0.9e-9  0      |                          | 20 steps, the largest displacement is 9.000e-10 cells
0       0.9e-9 |                          | the largest speed is 9.000e-10 of the wave speed
1.1e-9  0      | single-precision         | 1.100e-9 of the distance travelled
0       1.1e-9 | single-precision         | and 1.100e-9 of the speed
0.99e-5 0      | single-precision         | 9.900e-6 of the distance
1.02e-5 0      | displaced-from-the-start | displaced by (1.275e-6, 0) m
";
    check(0, "rest", still, still_rows);
    for (share, names) in [(0.9e-3, ""), (1.1e-3, "displaced-from-the-start")] {
        let motion = &still([share, 0.0]);
        let solver = MadeUp { dimension: 2, precision: Precision::Single, points: 0, motion };
        assert_found(&examine_with("rest", &solver), names, "");
    }
    // The velocity grows by a share of its last value, and the displacement is a multiple of v t.
    let moving_rows = "
1    0.5  | gravity-left-on          | velocity (0.1400, -0.4600) m/s after 0.2000 s, an acceleration
1    0.5  | gravity-left-on          | an acceleration of (0.7000, -2.300) m/s2
0.51 0.5  | gravity-left-on          | an acceleration of (0.3570, -1.173) m/s2
0.49 0.5  | velocity-of-its-own      | velocity (0.1400, -0.4600) m/s
0    1.95 | velocity-of-its-own      | velocity (0.1400, -0.4600) m/s
0    2.05 | displaced-from-the-start | displaced by (0.05740, -0.1886) m
";
    let moving = |[share, way]: [f64; 2]| {
        move |problem: &LevelProblem, _, step| {
            let (t, v) = (time(problem, step), at(0.14, -0.46));
            state(way * t * v, v * (1.0 - share + share * t / 0.2))
        }
    };
    check(0, "rest", moving, moving_rows);
    // Each half moves apart by a share of the displacement, and velocities grow with the distance.
    // The outermost particles are 7/4 cells from the centre along both axes.
    let apart_rows = "
0  0.001 0.0    0      | stress-at-rest             | 3.094e-4 m/s, mostly outwards
0 -0.001 0.002  0      | stress-at-rest             | inwards relative to the centre of the body, and
0 -0.001 0.002  0      | stress-at-rest             | with (0.002000, 
1  0     0      0.0195 | displaced-from-the-start   |
1  0     0      0.021  | stress-at-rest             |
";
    let apart = |[way, rate, drift, spread]: [f64; 4]| {
        move |problem: &LevelProblem, label, _| {
            let x = from_centre(problem, label);
            let u = way * (1.0 + spread * x[0].signum()) * Vector3::y();
            state(u, rate * x + drift * Vector3::x())
        }
    };
    check(0, "rest", apart, apart_rows);
    let positions = |[off]: [f64; 1]| {
        move |_: &LevelProblem, label, _| state(label + at(0.0, off * H), Vector3::zeros())
    };
    let positions_rows = "
0.9e-3 | positions-for-displacements | (0.5125, 0.6376)
1.1e-3 | stress-at-rest              |
";
    check(0, "rest", positions, positions_rows);
}

/// The body moves with (0.25, -0.15625) m/s for 80 steps of 0.025 s. Columns: relative errors of
/// displacement and speed; lead of all displacements and of the last one (dt); drag (1/s).
#[test]
fn errors_of_a_uniform_motion_have_their_cause() {
    let uniform_rows = "
0.9e-9 0       0       0    0    |                           | errors are up to 9.000e-10 of the dist
0      0.9e-9  0       0    0    |                           | up to 9.000e-10 of the speed
1.1e-9 0       0       0    0    | single-precision          | 1.100e-9 of the distance travelled
0.9e-6 0       0       0    0    | single-precision          | 9.000e-7 of the distance
1.1e-6 0       0       0    0    | weights-do-not-sum-to-one | 1.000 times velocity times time
0.09   0       0       0    0    | weights-do-not-sum-to-one | 1.090 times velocity times time
-0.09  0       0       0    0    | weights-do-not-sum-to-one | 0.9100 times velocity times time
0.11   0       0       0    0    | displacement-scaled       | 1.110 times velocity times time. the s
-0.11  0       0       0    0    | displacement-scaled       | 0.8900 times velocity times time
999    0       0       0    0    | displacement-scaled       | velocity times time. a unit is wrong
0.03   0.03    0       0    0    | velocity-scaled           | velocities are 1.030 times the velocit
-0.99  -0.99   0       0    0    | velocity-scaled           | 0.01000 times the velocities of the pr
-0.99  -0.99   0       0    0    | velocity-scaled           | a unit is wrong
0      0       0.5     0    0    | start-half-a-step-off     | by 0.01250 s (ahead): half a step
0      0       -0.485  0    0    | start-half-a-step-off     | (behind): half a step
0      0       0.475   0    0    | steps-of-another-length   | step 1 moves it by 1.475 v dt
0      0       0.984   0    0    | start-a-step-off          | 0.02460 s (ahead): a step
0      0       1.025   0    0    | steps-of-another-length   | step 1 moves it by 2.025 v dt
0      0       -0.9e-3 0    0    | displaced-in-motion       | 2.250e-5 s (behind): a constant time
0      0       0       -0.5 0    | steps-of-another-length   | 79 of 80 steps move the body by v dt
0      0       0       -0.5 0    | steps-of-another-length   | step 80 moves it by 0.5000 v dt
0      0       0       9e-4 0    | single-precision          |
0      0       0       0    0.3  | drag                      | lost at a rate of 0.3000 per second
0      0       0       0    -0.2 | drag                      | gained at a rate of -0.2000 per second
NaN    0       0       0    0    | weights-do-not-sum-to-one | are up to inf of the distance travelle
-2     0       0       0    0    | axes-exchanged            | `displacement` has the direction (-0.2
-2     0       0       0    0    | axes-exchanged            | (-0.2500, 0.1562), expected (0.2500, -
-2     -2      0       0    0    | axes-exchanged            | `velocity` has the direction (-0.2500,
";
    let uniform = |[way, speed, lead, last, drag]: [f64; 5]| {
        move |problem: &LevelProblem, _, step| {
            let (v, t) = (initial_velocity(problem), time(problem, step));
            let last = if step == problem.steps { last } else { 0.0 };
            let moved = if drag == 0.0 { t } else { -libm::expm1(-drag * t) / drag };
            let moved = (1.0 + way) * moved + (lead + last) * problem.dt;
            state(moved * v, (1.0 + speed) * libm::exp(-drag * t) * v)
        }
    };
    check(2, "translation", uniform, uniform_rows);
    let exchanged = |[x, y]: [f64; 2]| {
        move |problem: &LevelProblem, _, step| state(time(problem, step) * at(x, y), at(x, y))
    };
    let exchanged_rows = "
-0.15625 0.25    | axes-exchanged  | direction (-0.1562, 0.2500)
0.25     0.15625 | axes-exchanged  | direction (0.2500, 0.1562)
0.1      0.25    | velocity-scaled |
";
    check(2, "translation", exchanged, exchanged_rows);
    // A thousandth is lost in each step, and with half the step at this multiple of the rate.
    let losses_rows = "
1.24 | drag                 | rate of 0.04002 per second, independent
1.26 | speed-lost-each-step | (0.04002 per second, and 0.05043 per second with half
2.0  | speed-lost-each-step | a share of 0.001000 of the speed is lost in each step
";
    let losing = |[ratio]: [f64; 1]| {
        move |problem: &LevelProblem, _, step| {
            let ratio = if problem.dt < 0.02 { 0.5 * ratio } else { 1.0 };
            let (v, log) = (initial_velocity(problem), ratio * libm::log(0.999));
            let moved = problem.dt * libm::expm1(step as f64 * log) / log;
            state(moved * v, libm::exp(step as f64 * log) * v)
        }
    };
    check(2, "translation", losing, losses_rows);
}

#[test]
fn errors_that_differ_between_points_have_their_cause() {
    let limited_rows = "
1.1 -9    | position-limited | up to x = 1.100 m, and
9   -0.05 | position-limited | up to y = -0.05000 m, and
";
    let limited = |[high, low]: [f64; 2]| {
        move |problem: &LevelProblem, label: Vector3<f64>, step| {
            let v = initial_velocity(problem);
            let x = label + time(problem, step) * v;
            state(at(x[0].min(high), x[1].max(low)) - label, v)
        }
    };
    check(0, "translation", limited, limited_rows);
    // Speeds are lost at up to 0.0175 per second, in proportion to the distance from the centre and
    // to a power of the step. Without stiffness, all errors have the factor of the first column.
    let uneven_rows = "
0.9e-3 1    | gradients-do-not-sum-to-zero | is 0.03500 of the speed, and 3.150e-5 in a run without
1.1e-3 -0.6 | weights-do-not-sum-to-one    | are up to 0.01750 of the distance travelled, and velo
1.1e-3 -0.6 | weights-do-not-sum-to-one    | without stiffness they are 1.925e-5 and 3.850e-5
1      0    | drag                         | points lose -0.01750 to 0.01750 of their speed per se
1      -0.4 | drag                         | and -0.02309 to 0.02309 with half the time step
1      -0.6 | weights-do-not-sum-to-one    | points move by 0.9998 to 1.000 of v dt
";
    let uneven = |[soft, power]: [f64; 2]| {
        move |problem: &LevelProblem, label, step| {
            let (v, t) = (initial_velocity(problem), time(problem, step));
            let factor = if is_soft(problem) { soft } else { 1.0 };
            let rate = 0.02 * libm::pow(problem.dt / 0.025, power);
            let loss = factor * rate * from_centre(problem, label)[0] / 0.25;
            state((t - 0.5 * loss * t * t) * v, (1.0 - loss * t) * v)
        }
    };
    check(0, "translation", uneven, uneven_rows);
}

#[test]
fn errors_at_cells_and_surfaces_have_their_cause() {
    // Columns: number of correct steps, depth (cells) of the particles with an error. A particle
    // changes its cell in step 3 for the first time, because 0.8625 + 3 0.05 > 1.
    let near_rows = "
2 9   | wrong-after-a-cell-crossing | correct up to step 2, and
1 9   | weights-do-not-sum-to-one   |
0 1.5 | light-nodes-left-out        | in step 1, points near the surface have displacement errors
0 0.5 | light-nodes-left-out        | of up to 0.1750 of v dt
";
    let near = |[right, deepest]: [f64; 2]| {
        move |problem: &LevelProblem, label, step: u64| {
            let (v, x) = (initial_velocity(problem), from_centre(problem, label) / H);
            let is_wrong = 2.0 - x[0].abs().max(x[1].abs()) < deepest;
            let off = if is_wrong { 0.1 * x[0] } else { 0.0 };
            let steps = step.saturating_sub(right as u64) as f64;
            state((time(problem, step) + off * problem.dt * steps) * v, v)
        }
    };
    check(0, "translation", near, near_rows);
    // Columns: change of the positions on faces (v dt), velocity error with stiffness, F_yx, stress
    // over lambda + 2 mu = 0.7/0.52 E. Half of the particles lie on a face after step 3.
    let faces_rows = "
0    0    0.9e-6 0.9e-6 |                           | in 32 steps
0.04 0    0      0      | positions-changed         | From step 4 on, particles that lie on a cell face
0.04 0    0      0      | positions-changed         | move by up to 0.04000 v dt more or less
0.06 0    0      0      | particles-on-faces        |
0    0    1.1e-6 0      | light-nodes-left-out      | and the strain reaches 1.100e-6
0    0    0      1.1e-6 | light-nodes-left-out      | and the strain reaches 1.100e-6
0    0.01 0      0      | (rounding-grows-on-faces) | with stiffness: in 32 steps
";
    let on_faces = |[share, stiff, strain, stress]: [f64; 4]| {
        move |problem: &LevelProblem, label: Vector3<f64>, step: u64| {
            let v = initial_velocity(problem);
            let cells = (label[0] - problem.grid.origin[0]) / H;
            let is_on_face = (cells - libm::floor(cells) - 0.625).abs() < 1e-6 && step > 3;
            let off = if is_on_face { share * problem.dt } else { 0.0 };
            let stiff = if is_soft(problem) { 0.0 } else { stiff * label[0] };
            let mut f = Matrix3::identity();
            f[(1, 0)] = if step > 4 { strain } else { 0.0 };
            let modulus = 0.7 / 0.52 * problem.materials[0].parameter("young");
            let stress = if step > 4 { stress * modulus } else { 0.0 };
            let tensors = Some([Matrix3::from_diagonal_element(stress), f]);
            PointState { u: (time(problem, step) + off) * v, v: (1.0 + stiff) * v, tensors }
        }
    };
    check(0, "faces", on_faces, faces_rows);
}

/// Velocities `g (t - l dt)`; each step moves the body by `v dt + (1 + q) g dt^2/2`.
#[test]
fn times_of_a_fall_have_their_cause() {
    let times_rows = "
0     0     |                               | after 40 steps, v = (0, -1.480) m/s and u = (0, -0.2960)
0     1     | (start-half-a-step-off)       | v = g (t), expected v = g t; the measured displacement
0     1.09  | (start-half-a-step-off)       | u = g t^2/2 + 1.090 g t dt/2, expected
0.018 1     | (start-half-a-step-off)       | v = g (t - 0.01800 dt)
0.022 1     | velocity-of-another-time      |
0     1.11  | way-not-of-velocities         | with q = 1.110
0.5   1     | (velocity-half-a-step-behind) | v = g (t - 0.5000 dt)
0.5   2     | (velocity-half-a-step-behind) | Positions move with the later velocity
0     0.5   | (steps-are-divided)           | The solver takes 2 steps of dt/2 for each step
0.36  0.5   | (steps-are-divided)           | with q = 0.5000
0.39  0.5   | way-not-of-velocities         |
0     0.2   | (steps-are-divided)           | The solver takes 5 steps of dt/5
0.5   0     | positions-from-mean-velocity  |
0     -1.09 | positions-before-velocities   | u = g t^2/2 - 1.090 g t dt/2
0.5   -0.91 | positions-before-velocities   |
-0.5  1     | velocity-of-another-time      | v = g (t + 0.5000 dt)
0.53  0     | velocity-of-another-time      |
";
    let falling = |[lag, share]: [f64; 2]| {
        move |problem: &LevelProblem, _, step: u64| {
            let (k, dt, g) = (step as f64, problem.dt, at(0.0, -3.7));
            let steps = 0.5 * k * (k - 1.0) - lag * (k - 1.0) + 0.5 * k * (1.0 + share);
            if step == 0 {
                PointState::default()
            } else {
                state(steps * dt * dt * g, (k - lag) * dt * g)
            }
        }
    };
    check(2, "fall", falling, times_rows);
}

/// Columns: factor of gravity, its share along x, and that of the difference between two halves. A
/// particle has the mass 1.7 (1/16)^2 kg.
#[test]
fn factor_of_gravity_has_its_cause() {
    let factors_rows = "
1.0011       0    0     | gravity-scaled              | is 1.001 times the gravity of the problem
0.9e-3       0    0     | gravity-missing             | 9.000e-4 times the gravity
-0.985       0    0     | gravity-upwards             | -0.9850 times
-0.975       0    0     | gravity-scaled              | multiplied by an unknown factor
0.125        0    0     | gravity-scaled              | multiplied by the cell size
8            0    0     | gravity-scaled              | divided by the cell size
2.035        0    0     | gravity-scaled              | added twice
2.045        0    0     | gravity-scaled              | multiplied by an unknown factor
0.5          0    0     | gravity-scaled              | in one half of each step only
1.7          0    0     | gravity-scaled              | multiplied by the density
0.588235294  0    0     | gravity-scaled              | divided by the density
0.006640625  0    0     | gravity-scaled              | by the particle mass twice
150.58823529 0    0     | gravity-scaled              | divided by the mass of a particle
2.651        0    0     | gravity-scaled              | uses its own gravity of 9.81 m/s2
3.651        0    0     | gravity-scaled              | adds its own gravity of 9.81 m/s2
1000         0    0     | gravity-scaled              | in mm instead of m
1            0.03 0     | gravity-along-another-axis  | falls in the direction (0.02999, -0.9996)
1            0    0.021 | force-uneven                | from their mean by up to 0.02100 of g t
";
    let falling = |[factor, across, spread]: [f64; 3]| {
        move |problem: &LevelProblem, label, step| {
            let side = from_centre(problem, label)[0].signum();
            let (t, g) = (time(problem, step), 3.7 * factor);
            let g = g * at(across, -1.0 - spread * side);
            state(0.5 * t * t * g, t * g)
        }
    };
    check(2, "fall", falling, factors_rows);
}

/// The moment of momentum of a box of 4 x 4 cells with the particle spacing h/2 is lost in units of
/// `2 h^2/(2 (16 - 1/4)/12 h^2)`. Columns: losses in the first and in later steps of a stretch, of
/// a rotation, and of a stretch of a small body.
#[test]
fn losses_of_a_transfer_have_their_cause() {
    const UNIT: f64 = 12.0 / 15.75;
    let losses_rows = "
0.039 0.0039 0.02  0.0036 0     0     |                          | 0.03900 in the first step and 0.003900
0.039 0.0039 0.02  0.0036 0     0     |                          | 0.02000 and 0.003600 in a rotation
0.041 0      0     0      0     0     | (first-step-spreads)     | by 0.04100 h^2
0     0      0     0.0041 0     0     | affine-matrix-transposed | by 0.004100 h^2 in a rotation
0     0      0.1   0.119  0     0     | rotation-lost            |
0     0      0.1   0.121  0     0     | affine-matrix-transposed |
0.1   0.1    0.1   0.1    0.1   0.109 | affine-matrix-scaled     | 0.1090 h^2 in a stretch with all
0.1   0.1    0.1   0.1    0.1   0.106 | (momentum-spreads)       | by 0.1000 h^2 in a stretch
0.1   0.1    0.1   0.109  0.1   0.1   | affine-matrix-scaled     | C does not restore
-0.1  -0.1   -0.1  -0.1   -0.1  -0.1  | affine-matrix-scaled     | C does not restore
0.67  0      0.67  0      0.67  0     | columns-in-another-order |
0.64  0      0.64  0      0.64  0     | (first-step-spreads)     | by 0.6400 h^2
";
    let losing = |losses: [f64; 6]| {
        move |problem: &LevelProblem, label, step: u64| {
            let (x, first) = (from_centre(problem, label), &problem.particles.reference_position);
            let outwards = from_centre(problem, at(first[0], first[1]));
            let is_rotation = outwards.dot(&initial_velocity(problem)).abs() < 1e-9;
            let run = if is_rotation {
                2
            } else if problem.grid.h < 0.1 {
                4
            } else {
                0
            };
            let late = step.saturating_sub(2) as f64;
            let kept = (1.0 - losses[run] * UNIT) * (1.0 - losses[run + 1] * UNIT * late);
            let v = if is_rotation { at(-x[1], x[0]) } else { x };
            state(Vector3::zeros(), 1e-4 * if step == 0 { 1.0 } else { kept } * v)
        }
    };
    check(0, "transfer", losing, losses_rows);
    // Columns: velocities after the first and after the last step, relative to the initial ones.
    // The fastest particle is 7/4 cells from the centre along both axes.
    let growth_rows = "
0.011 9.9  |                          | largest speed is 3.094e-5 m/s at the start, 3.403e-7 after
0.009 1    | initial-velocity-dropped | 2.784e-7 after one step
1     10.1 | affine-matrix-scaled     | 3.125e-4 at the end
1     NaN  | affine-matrix-scaled     |
";
    let growing = |[first, last]: [f64; 2]| {
        move |problem: &LevelProblem, label, step: u64| {
            let late = if step == problem.steps { last } else { 1.0 };
            let share = if step == 1 { first } else { late };
            state(Vector3::zeros(), 1e-4 * share * from_centre(problem, label))
        }
    };
    check(0, "initial-velocity", growing, growth_rows);
}

/// The force per mass is 0.8 + 6 t (m/s2). Columns: steps by which velocities lag and forces are
/// late, factor of the speed, share of the growth, share of the gradient, delay of requests (s),
/// share of the motion that the positions of requests have.
#[test]
fn times_and_places_of_a_force_have_their_cause() {
    let forces_rows = "
0    0     1 1    1    0    0 |                                | in 20 steps; the speed increases by 0.80
0.59 0     1 1    1    0    0 |                                |
0    0.09  1 1    1    0    0 |                                |
0    -0.59 1 1    1    0    0 |                                |
0    0.41  1 1    1    0    0 | (force-of-the-end-of-the-step) | 20 different times in 20 steps
0    0.3   1 1    1    0    0 | (force-shifted-in-time)        | about 0.3000 dt after the time
0    -0.7  1 1    1    0    0 | (force-shifted-in-time)        | about 0.7000 dt before the time
0    3.4   1 1    1    0    0 | (force-shifted-in-time)        | about 3.400 dt after
0    3.6   1 1    1    0    0 | force-scaled                   |
0    0     1 0.03 1    0    0 | force-of-one-time              | by 0.3344 m/s, expected 0.8000 m/s
0    0     2 1    1    0    0 | force-scaled                   | by about 2.000: the acceleration is adde
0    0     1 1    0.41 0    0 |                                |
0    0     1 1    1.29 0    0 |                                |
0    0     1 1    0.39 0    0 | force-of-other-points          | with X is 0.3900 of the expected one
0    0     1 1    1.31 0    0 | force-of-other-points          | with X is 1.310 of the expected one
0    0     1 1    1    0.03 0 |                                |
0    0     1 1    1    0.05 0 | force-of-another-time          | times are 0.05000 to 0.4300 s, but the r
0    0     1 1    1    0    0.32 |                           |
0    0     1 1    1    0    0.34 | force-at-present-positions | the body has moved by 0.09500 m
";
    let forced = |[lag, late, factor, growth, gradient, delay, moved]: [f64; 7]| {
        move |problem: &LevelProblem, label: Vector3<f64>, step: u64| {
            let (t, dt, v0) = (time(problem, step), problem.dt, initial_velocity(problem));
            let field = problem.body_force.as_ref().expect("a force");
            if step == 0 {
                return state(Vector3::zeros(), v0);
            }
            let place = label + moved * (t - dt) * v0;
            let force = field.at(0, &place.as_slice()[..2], t - dt + delay)[0];
            if v0[0] == 0.0 {
                return state(Vector3::zeros(), at(gradient * force * dt, 0.0));
            }
            let shifted = (late - lag) * 6.0 * t - lag * 0.8;
            let gained = 0.8 * t + growth * 3.0 * t * t + shifted * dt;
            state(Vector3::zeros(), v0 + at(factor * gained, 0.0))
        }
    };
    check(0, "force", forced, forces_rows);
}

/// The body moves by 0.375 m, and the period is 0.5 m. Columns: axis of the mistake, displacement
/// (periods) and share of the speed that points beyond the end lose.
#[test]
fn displacements_along_a_periodic_axis_are_not_wrapped() {
    let wrapped_rows = "
2 0     0   |                       | in 60 steps
1 1     0   | displacements-wrapped | along y, some displacements differ from the distance of 0.375 m
1 1     0   | displacements-wrapped | multiples of the period of 0.5 m
0 0.998 0   | periodic-axis         | along x: 
0 0     0.2 | periodic-axis         | along x: 
";
    let wrapped = |[wrong, periods, lost]: [f64; 3]| {
        move |problem: &LevelProblem, label: Vector3<f64>, step: u64| {
            let axis = usize::from(problem.grid.periodic[1]);
            let v = initial_velocity(problem);
            let mut u = time(problem, step) * v;
            let is_beyond = label[axis] + u[axis] > problem.bodies[0].to[axis];
            let [periods, lost] =
                if is_beyond && axis == wrong as usize { [periods, lost] } else { [0.0; 2] };
            u[axis] -= 0.5 * periods;
            state(u, (1.0 - lost) * v)
        }
    };
    check(0, "periodic", wrapped, wrapped_rows);
}

/// Columns: relative change of displacements in the second run, for one message, and for one
/// message under acceleration; ratio of distances for half the step. Differences of components are
/// divided by the length sqrt(2) of the vector.
#[test]
fn runs_and_messages_give_equal_results() {
    let changes_rows = "
0      1.3e-9 1.3e-9 0.74 |                             | 36 points in 2-D, law linear_elastic, 6 steps
1.3e-9 0      0      0.5  | (rounding-differs-each-time) | differ by 9.192e-10 of the largest
1.5e-9 0      0      0.5  | another-way-each-time       | differ by 1.061e-9 of the largest
0      1.5e-9 0      0.5  | steps-depend-on-messages    | at constant speed, 6 steps in one `advance`
0      0.1    0      0.5  | steps-depend-on-messages    | differ by 0.07071 of the displacement, 0 of
0      0.1    0      0.5  | steps-depend-on-messages    | moves as far as in 6.600 single steps
0      0      1.5e-9 0.5  | steps-depend-on-messages    | under acceleration, 6 steps in one `advance`
0      0      0      0.76 | own-step                    | moves 0.7600 of the original distance
";
    let changing = |[second, one, accelerated, ratio]: [f64; 4]| {
        let runs = AtomicU32::new(0);
        move |problem: &LevelProblem, label: Vector3<f64>, step: u64| {
            let first = &problem.particles.reference_position;
            let is_start = step == 0 && label == at(first[0], first[1]);
            let run = runs.fetch_add(u32::from(is_start), Ordering::Relaxed) + u32::from(is_start);
            let of_message = if problem.body_force.is_some() { accelerated } else { one };
            let of_message = if problem.instants.len() == 1 { of_message } else { 0.0 };
            let of_run = if run == 2 { second } else { 0.0 };
            let of_step =
                if problem.dt < 0.03 && problem.body_force.is_none() { 2.0 * ratio } else { 1.0 };
            let v = initial_velocity(problem);
            state((1.0 + of_message + of_run) * of_step * time(problem, step) * v, v)
        }
    };
    check(0, "conversation", changing, changes_rows);
}

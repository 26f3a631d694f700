//! Examinations of stresses, measured from the momentum of the two halves of a body.

use super::{ALL, PointState, check};
use crate::external::{LevelProblem, everything};
use nalgebra::{Matrix3, Vector3};

#[test]
fn covered_capabilities_exist() {
    let known = everything().entries();
    for one in ALL {
        let unknown = one.covers.iter().find(|name| !known.iter().any(|known| known == *name));
        assert_eq!(unknown, None, "{}", one.name);
    }
}

/// Lame's parameters (Pa) for E = 3.1 Pa and nu = 0.3.
const LAMBDA: f64 = 3.1 * 0.3 / (1.3 * 0.4);
const MU: f64 = 3.1 / 2.6;

/// Returns the distance from the centre of the body with this index along each axis, and its
/// length.
fn from_centre(
    problem: &LevelProblem,
    body: usize,
    label: Vector3<f64>,
) -> (Vector3<f64>, [f64; 2]) {
    let body = &problem.bodies[body];
    let half = |i: usize| 0.5 * (body.from[i] + body.to[i]);
    let length = [0, 1].map(|i| body.to[i] - body.from[i]);
    (label - Vector3::new(half(0), half(1), 0.0), length)
}

/// Returns the velocity that an impulse (Pa s) of the stress gives to each half of a body: through
/// the plane with normal i, a half of the length L/2 gains the momentum per area of the impulse.
fn gained(x: Vector3<f64>, length: [f64; 2], density: f64, impulse: &Matrix3<f64>) -> Vector3<f64> {
    let mut v = Vector3::zeros();
    for i in 0..2 {
        v -= x[i].signum() * 2.0 / (density * length[i]) * impulse.row(i).transpose();
    }
    v
}

/// Columns: moduli along the stretch (lambda + 2 mu = 4.17308 Pa), across it (1.78846 Pa), and in
/// shear along y and along x (1.19231 Pa); part of the stress that is constant, over the stress at
/// the end; momentum that is gained, over that of the free faces.
#[test]
fn moduli_have_their_cause() {
    let moduli_rows = "
4.17308  1.78846  1.19231  1.19231  0      0.9e-6  |                           | are 4.173 Pa along the
4.17308  1.78846  1.19231  1.19231  0      0.9e-6  |                           | 1.788 Pa across the st
4.17308  1.78846  1.15     1.20     0      0       |                           | and 1.150 and 1.200 Pa
4.17308  1.78846  1.19231  1.19231  0      1.1e-6  | momentum-lost             | changes by 1.100e-6 of
4.29408  1.66746  1.07131  1.07131  0      0       |                           | 4.294 Pa along
4.30242  1.78846  1.19231  1.19231  0      0       | stress-scaled             | are 1.031, 1.0
4.17308  1.91783  1.19231  1.19231  0      0       | moduli-differ             | 1.072, 1.0
4.17308  1.78846  1.32168  1.32168  0      0       | moduli-differ             | 1.109 (along
4.17308  1.78846  1.13198  1.25264  0      0       |                           | 1.132 and 1.253 Pa
4.17308  1.78846  1.25699  1.12762  0      0       | stress-not-symmetric      |
0.12102  -0.12102 0.12102  0.12102  0      0       | stress-missing            |
3.40659  1.02198  1.19231  1.19231  0      0       | plane-stress              | are 0.8163, 0.5714, 1.
3.1      0        1.19231  1.19231  0      0       | poisson-ratio-ignored     | Poisson's ratio has no
3.1      0        1.55     1.55     0      0       | poisson-ratio-ignored     | the solver uses zero
4.17308  1.78846  0        0        0      0       | shear-missing             |
4.76923  1.19231  1.78846  1.78846  0      0       | lame-parameters-exchanged |
4.96795  2.58333  1.19231  1.19231  0      0       | bulk-modulus-for-lambda   |
2.38462  0        1.19231  1.19231  0      0       | volume-term-missing       |
4.17308  1.78846  2.38462  2.38462  0      0       | shear-doubled             |
4.17308  1.78846  0.59615  0.59615  0      0       | shear-halved              |
6.55769  1.78846  2.38462  2.38462  0      0       | mu-doubled                |
2.98077  1.78846  0.59615  0.59615  0      0       | mu-halved                 |
3.77564  1.39103  1.19231  1.19231  0      0       | plane-deviator            |
-4.17308 -1.78846 -1.19231 -1.19231 0      0       | stress-sign               | are -1.000, -1.0
4.17308  1.78846  1.19231  1.19231  0.124  0       |                           |
4.17308  1.78846  1.19231  1.19231  0.126  0       | viscosity                 | viscosity 0.009166 m2/
4.17308  1.78846  1.19231  1.19231  -0.126 0       | force-of-an-earlier-state | delay of 0.003734 s. i
4.17308  1.78846  1.19231  1.19231  -0.126 0       | force-of-an-earlier-state | or applied later: 0.15
";
    let strained = |[along, across, up, right, constant, lost]: [f64; 6]| {
        move |problem: &LevelProblem, label, step: u64| {
            let (x, length) = from_centre(problem, 0, label);
            let v0 = &problem.particles.velocity;
            // The lowest corner moves along +x in compression, and along -x in tension.
            let sign = v0[0].signum();
            let rates = [-5e-3 * sign, 4e-3 * sign];
            let mut v = Vector3::new(rates[0] * x[0] + rates[1] * x[1], 0.0, 0.0);
            let (t, end) = (step as f64 * problem.dt, problem.steps as f64 * problem.dt);
            if problem.materials[0].parameter("young") > 1e-9 {
                let growth = 0.5 * t * t;
                let mut impulse = Matrix3::zeros();
                impulse[(0, 0)] = along * rates[0] * (growth + constant * end * t);
                impulse[(1, 1)] = across * rates[0] * growth;
                (impulse[(0, 1)], impulse[(1, 0)]) =
                    (up * rates[1] * growth, right * rates[1] * growth);
                v += gained(x, length, 1.7, &impulse);
                let c = libm::sqrt((LAMBDA + 2.0 * MU) / 1.7);
                v[1] += lost * c * 5e-3 * t;
            }
            PointState { v, ..PointState::default() }
        }
    };
    check(4, "stress", strained, moduli_rows);
}

/// Columns: factors of all moduli, of the column `stress`, of F - I, and of F_xy alone. The body
/// has 1.7 kg/m3, cells of 0.15 m and 3 x 3 particles per cell.
#[test]
fn factors_and_columns_have_their_cause() {
    let factors_rows = "
1       1    1    1    |                                 |
1       1.19 1    1    |                                 |
1       1.21 1    1    | stress-column                   | the column is 1.210 times the expected
1       -1   1    1    | stress-column                   | the column is positive in compression
1       1    1.19 1    |                                 |
1       1    1.21 1    | deformation-gradient-column     | F - I = (-8.688e-4, 6.951e-4, 0, 0); the mo
1       1    1    0    | deformation-gradient-transposed |
1.7     1    1    1    | mass-or-volume-scaled           | the density is missing in the mass, or set
1.7     1.17 1    1    | mass-or-volume-scaled           | accelerations are 1.700 times the expected
1.7     1.18 1    1    | stress-scaled                   | accelerations due to stress are 1.700 times
1.7     1.7  1    1    | stress-scaled                   | the column `stress` and the accelerations a
1.7     1.7  1.7  1    | velocity-gradient-scaled        | F - I and the stress are 1.700 times
";
    let scaled = |[moduli, stress, strain, place]: [f64; 4]| {
        move |problem: &LevelProblem, label, step: u64| {
            let (x, length) = from_centre(problem, 0, label);
            let sign = problem.particles.velocity[0].signum();
            let (a, b, t) = (-5e-3 * sign, 4e-3 * sign, step as f64 * problem.dt);
            let whole = LAMBDA + 2.0 * MU;
            let law = Matrix3::new(whole * a, MU * b, 0.0, MU * b, LAMBDA * a, 0.0, 0.0, 0.0, 0.0);
            let mut v = Vector3::new(a * x[0] + b * x[1], 0.0, 0.0);
            if problem.materials[0].parameter("young") > 1e-9 {
                v += gained(x, length, 1.7, &(law * (moduli * 0.5 * t * t)));
            }
            let mut f = Matrix3::identity();
            f[(0, 0)] += strain * a * t;
            f[if place == 1.0 { (0, 1) } else { (1, 0) }] += strain * b * t;
            PointState { v, tensors: Some([law * (stress * t), f]), ..PointState::default() }
        }
    };
    check(8, "stress", scaled, factors_rows);
}

/// Columns: moduli of the first body, which has 1.7 kg/m3, and of the second one, which is 2.6
/// times as stiff and 1.5 times as heavy.
#[test]
fn bodies_have_their_moduli() {
    let moduli_rows = "
1.09    0.91    |                             | modulus of the first body 1.090, of the second body 0.91
1.11    1       | bodies-differ               | modulus of the first body 1.110
1       0.89    | bodies-differ               | of the second body 0.8900
1       0.38462 | one-law-for-all-bodies      | the second body has the parameters of the first body
2.6     1       | one-law-for-all-bodies      | the first body has the parameters of the last body
1       1.5     | one-density-for-all-bodies  | the second body has the density of the first body
0.66667 1       | one-density-for-all-bodies  | the first body has the density of the last body
1       0.57692 | one-material-for-all-bodies | the second body has the law and the density of the first
1.73333 1       | one-material-for-all-bodies | the first body has the law and the density of the last
";
    let strained = |factors: [f64; 2]| {
        move |problem: &LevelProblem, label: Vector3<f64>, step: u64| {
            let body = usize::from(label[0] > problem.bodies[0].to[0]);
            let (x, length) = from_centre(problem, body, label);
            let mut v = Vector3::new(-5e-3 * x[0] + 4e-3 * x[1], 0.0, 0.0);
            if problem.materials[0].parameter("young") > 1e-9 {
                let (stiffer, heavier) = [(1.0, 1.0), (2.6, 1.5)][body];
                let t = step as f64 * problem.dt;
                let mut impulse = Matrix3::zeros();
                let modulus = factors[body] * stiffer * (LAMBDA + 2.0 * MU);
                impulse[(0, 0)] = modulus * -5e-3 * 0.5 * t * t;
                v += gained(x, length, 1.7 * heavier, &impulse);
            }
            PointState { v, ..PointState::default() }
        }
    };
    check(4, "bodies", strained, moduli_rows);
}

/// Columns: force relative to that of the initial stress, its delay (steps), change of
/// displacements in the first step relative to the initial ones; velocity after one step and later
/// acceleration under a gradient of the initial stress.
#[test]
fn initial_stress_has_its_force() {
    let forces_rows = "
1.11 0    0.19 1.61 1.29 |                              | is 1.110 of the expected force and begins 0
0.89 0.74 0    0.39 0.71 |                              | is 0.8900 of the expected force and begins 0
1    0.86 0    1    1    | initial-stress-dropped       | begins 0.9000 steps after the start
1    0    0.21 1    1    | initial-displacement-ignored | by 0.2100 of the largest one
1    0    0    1.63 1    | initial-stress-gradient      | velocity after one step 1.630, acceleration
1    0    0    1    0.69 | initial-stress-gradient      | acceleration in later steps 0.6900
";
    let released = |[force, delay, moved, first, later]: [f64; 5]| {
        move |problem: &LevelProblem, label, step: u64| {
            let (x, length) = from_centre(problem, 0, label);
            let particles = &problem.particles;
            let tensor = |column: &[f64]| {
                Matrix3::new(column[0], column[1], 0.0, column[2], column[3], 0.0, 0.0, 0.0, 1.0)
            };
            let f = tensor(&particles.deformation_gradient);
            let (t, dt) = (step as f64 * problem.dt, problem.dt);
            if step == 0 {
                return PointState::default();
            }
            let last = particles.stress.len() - 4;
            if particles.stress[..4] != particles.stress[last..] {
                let acceleration = (LAMBDA + 2.0 * MU) * 0.008 / 1.7;
                let v = acceleration * (first * dt + later * (t - dt)) * Vector3::x();
                return PointState { v, ..PointState::default() };
            }
            // With P = J sigma F^-T, the impulse through the plane with normal x is P_jx t.
            let inverse = f.try_inverse().expect("F");
            let p = f.determinant() * tensor(&particles.stress) * inverse.transpose();
            let mut impulse = Matrix3::zeros();
            for j in 0..2 {
                impulse[(0, j)] = force * p[(j, 0)] * (t - delay * dt);
            }
            let u = (1.0 - moved) * (f - Matrix3::identity()) * x;
            PointState { u, v: gained(x, length, 1.7, &impulse), tensors: None }
        }
    };
    check(4, "start", released, forces_rows);
}

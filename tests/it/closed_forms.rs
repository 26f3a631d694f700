//! Compares two exact solutions of one problem: the sum of images that the suites state, with the
//! eigenfunction series of Wobbes & Tielen (2015) and with values computed by hand.

use crate::common::built_in_suite;
use approx::assert_abs_diff_eq;
use mpm_verify::exact::Truth;
use rstest::rstest;
use std::f64::consts::{PI, SQRT_2};

/// Returns the displacement by the exact solution of an embedded suite in one dimension.
fn displacement(name: &str, x: f64, t: f64) -> f64 {
    displacements(name, [x], t)[0]
}

/// Returns the displacements by the exact solution of an embedded suite.
fn displacements<const D: usize>(name: &str, place: [f64; D], t: f64) -> [f64; D] {
    let suite = built_in_suite(name);
    let plan = suite.convergence().expect("a convergence study");
    let mut u = [0.0; D];
    plan.exact.as_ref().expect("an exact solution").motion.displacement(&place, t, &mut u);
    u
}

/// Returns `u = us + sum_n a_n cos(c l_n t) sin(l_n y)`, `l_n = (2n - 1) pi/(2H)`. The series
/// cancels the static solution `us` at t = 0. H = 1, c = 10.
fn series(gravity: f64, load: f64, y: f64, t: f64) -> f64 {
    let c = 10.0;
    let still = gravity / (c * c) * (y * y / 2.0 - y) + load * y;
    let waves: f64 = (1..=20_000)
        .map(|n| {
            let l = (2.0 * f64::from(n) - 1.0) * PI / 2.0;
            let sign = if n % 2 == 1 { 1.0 } else { -1.0 };
            let a = 2.0 * gravity / (c * c) / (l * l * l) - 2.0 * load * sign / (l * l);
            a * libm::cos(c * l * t) * libm::sin(l * y)
        })
        .sum();
    still + waves
}

#[rstest]
fn the_oedometer_agrees_with_its_series(
    #[values(0.0, 0.1, 0.5, 0.73, 1.0)] y: f64,
    #[values(0.0, 0.03, 0.21, 0.4, 0.5)] t: f64,
) {
    let images = displacement("oedometer", y, t);
    assert_abs_diff_eq!(images, series(9.81, 0.0, y, t), epsilon = 1e-10);
}

/// Steffen's bar has the wave speed 1 m/s, so its series at t equals that of c = 10 at t/10.
#[rstest]
fn steffens_bar_agrees_with_its_series(
    #[values(0.0, 0.2, 0.55, 1.0)] x: f64,
    #[values(0.1, 0.6, 1.5)] t: f64,
) {
    let images = displacement("steffen-bar", x, t);
    assert_abs_diff_eq!(images, series(0.0, 0.7 / 100.0, x, t / 10.0), epsilon = 1e-7);
}

/// Before the first wave arrives, the column falls freely. After half a period all displacements
/// are twice the static solution.
#[test]
fn column_falls_freely_and_then_oscillates_about_the_static_solution() {
    assert_abs_diff_eq!(
        displacement("oedometer", 0.9, 0.05),
        -9.81 / 2.0 * 0.05 * 0.05,
        epsilon = 1e-15
    );
    assert_abs_diff_eq!(displacement("oedometer", 1.0, 0.2), -9.81 / 100.0, epsilon = 1e-15);
}

/// Stretches of gas clouds at t = 1, `sqrt(1 + C)` with C = 3/4, 1 and 5/4, were checked by
/// integration of `a'' = C/a^3`.
#[test]
fn stretches_of_gas_clouds_satisfy_their_equation_of_motion() {
    let stretches = [
        1.0 + displacements("gas-cloud", [0.3], 1.0)[0] / 0.3,
        1.0 + displacements("gas-cloud-2d", [0.3, -0.4], 1.0)[1] / -0.4,
        1.0 + displacements("gas-cloud-3d", [0.3, -0.4, 0.5], 1.0)[2] / 0.5,
    ];
    for (stretch, expected) in stretches.into_iter().zip([1.322_875_655_5, SQRT_2, 1.5]) {
        assert_abs_diff_eq!(stretch, expected, epsilon = 1e-10);
    }
}

/// Positions in a spinning cloud were computed independently, from residuals of Euler's equations
/// below 1e-12.
#[rstest]
#[case(0.5, [0.479_098_471, -0.337_030_644])]
#[case(1.0, [0.720_381_798, -0.321_791_960])]
#[case(2.0, [1.278_263_630, -0.325_641_048])]
fn positions_in_a_spinning_cloud_satisfy_the_equation_of_motion(
    #[case] t: f64,
    #[case] expected: [f64; 2],
) {
    let place = [0.3, -0.4];
    let u = displacements("spinning-cloud", place, t);
    for axis in 0..2 {
        assert_abs_diff_eq!(place[axis] + u[axis], expected[axis], epsilon = 1e-9);
    }
}

/// A fluid hits a wall with U = 0.2 c, c^2 = 1000. The speeds of fluid and front, U and
/// D = 1.395 316 674 7 c, follow from the jumps of mass and momentum for Tait's fluid.
#[test]
fn shock_speed_satisfies_the_jump_conditions() {
    let c = 1000.0_f64.sqrt();
    let (speed, front, t) = (0.2 * c, 1.395_316_674_7 * c, 0.4 / c);
    assert_abs_diff_eq!(displacement("thrown-fluid", 0.9, t), -speed * t, epsilon = 1e-12);
    let behind = displacement("thrown-fluid", 0.3, t);
    assert_abs_diff_eq!(behind, -speed * 0.3 / front, epsilon = 1e-10);
}

//! Tests of objective rates of linear elasticity along paths with rotation. In the limit of small
//! steps, stresses are compared with closed forms and with values of an independent program.

use super::MaterialPlan;
use super::specimen::{SLOW, Specimen, richardson};
use crate::mpm::foundation::algebra::{Matrix, Vector};
use approx::assert_abs_diff_eq;
use rstest::rstest;

/// Material with the Jaumann rate. All materials of these tests have lambda = mu = 1 Pa.
const JAUMANN: MaterialPlan = MaterialPlan::Jaumann { young: 2.5, poisson: 0.25 };
const GREEN_NAGHDI: MaterialPlan = MaterialPlan::GreenNaghdi { young: 2.5, poisson: 0.25 };
const LOGARITHMIC: MaterialPlan = MaterialPlan::Hencky { young: 2.5, poisson: 0.25 };

/// Returns a plane F with the shear `a`, and the stretch `b` of the second axis.
fn sheared([a, b]: [f64; 2]) -> Matrix<2> {
    Matrix::<2>::new(1.0, a, 0.0, b)
}

/// Follows a polygonal path of shears and stretches with `steps` steps per side. Returns components
/// 11 and 12 of the Kirchhoff stress (Pa) at the end of the path, and the work per reference volume
/// (J/m3).
fn follow(plan: MaterialPlan, corners: &[[f64; 2]], steps: u32) -> Vector<3> {
    let mut body = Specimen::<2>::new(plan);
    let (mut before, mut tau, mut work) = (sheared(corners[0]), Matrix::<2>::zeros(), 0.0);
    for side in corners.windows(2) {
        for step in 1..=steps {
            let share = f64::from(step) / f64::from(steps);
            let mix = |i: usize| side[0][i] + share * (side[1][i] - side[0][i]);
            let now = sheared([mix(0), mix(1)]);
            let sigma = body.deform(&(now * before.try_inverse().unwrap()), SLOW);
            let after = sigma * now.determinant();
            // Velocity gradient with respect to the configuration in the middle of the step.
            let rate = (now - before) * (0.5 * (now + before)).try_inverse().unwrap();
            work += (0.5 * (tau + after)).dot(&(0.5 * (rate + rate.transpose())));
            (before, tau) = (now, after);
        }
    }
    assert_abs_diff_eq!(tau[(1, 0)], tau[(0, 1)], epsilon = 1e-14);
    Vector::<3>::new(tau[(0, 0)], tau[(0, 1)], work)
}

fn limit(plan: MaterialPlan, corners: &[[f64; 2]]) -> (Vector<3>, f64) {
    richardson((3..=8).map(|k| follow(plan, corners, 1 << k)).collect(), 4)
}

/// After a closed cycle of shear and stretch, stress and work are not zero, except with the
/// logarithmic rate. The reversed cycle leaves a different stress, but the same work.
#[rstest]
#[case::jaumann(JAUMANN, [-0.002_977_508_1, -0.003_181_719_0], [0.003_081_891_7, 0.003_080_719_7], 9.494_445e-6)]
#[case::green_naghdi(GREEN_NAGHDI, [0.001_516_992_8, 0.001_567_942_8], [f64::NAN; 2], 2.379_856e-6)]
#[case::logarithmic(LOGARITHMIC, [0.0; 2], [0.0; 2], 0.0)]
fn residual_stress_of_a_closed_cycle_depends_on_the_rate(
    #[case] plan: MaterialPlan,
    #[case] expected: [f64; 2],
    #[case] reversed: [f64; 2],
    #[case] work: f64,
) {
    let mut corners = [[0.0, 1.0], [0.0, 1.2], [0.2, 1.2], [0.2, 1.0], [0.0, 1.0]];
    for expected in [expected, reversed] {
        let (found, order) = limit(plan, &corners);
        for i in 0..2 {
            if expected[i].is_finite() {
                assert_abs_diff_eq!(found[i], expected[i], epsilon = 1e-10);
            }
        }
        assert_abs_diff_eq!(found[2], work, epsilon = 1e-12);
        assert!(plan == LOGARITHMIC || (1.95..2.05).contains(&order), "order {order}");
        corners.reverse();
    }
}

//! The closed forms of each material's stress, which its own file states.

use super::specimen::{diagonal, every, stress};
use crate::mpm::algebra::Matrix;
use approx::{assert_abs_diff_eq, assert_relative_eq};

#[test]
fn simple_shear_has_its_closed_forms() {
    let gamma = 0.4;
    let f = Matrix::<3>::new(1.0, gamma, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    for plan in every() {
        let (space, plane) = (stress(plan, &f), stress(plan, &f.fixed_resize::<2, 2>(0.0)));
        let expected = plan.closed_forms().simple_shear(gamma);
        for (place, expected) in [(0, 0), (0, 1), (1, 1)].into_iter().zip(expected) {
            assert_abs_diff_eq!(plane[place], expected, epsilon = 1e-12);
            assert_abs_diff_eq!(space[place], expected, epsilon = 1e-12);
        }
    }
}

/// Along and across a uniaxial stretch, the others held.
#[test]
fn stretch_has_its_closed_forms() {
    let stretch = 1.3;
    for plan in every() {
        let Some([along, across]) = plan.closed_forms().uniaxial_stretch(stretch) else { continue };
        assert_relative_eq!(stress(plan, &diagonal::<1>(stretch))[0], along, epsilon = 1e-12);
        let plane = stress(plan, &diagonal::<2>(stretch));
        let space = stress(plan, &diagonal::<3>(stretch));
        for found in [plane[(0, 0)], space[(0, 0)]] {
            assert_relative_eq!(found, along, epsilon = 1e-12);
        }
        for found in [plane[(1, 1)], space[(1, 1)], space[(2, 2)]] {
            assert_relative_eq!(found, across, epsilon = 1e-12);
        }
    }
}

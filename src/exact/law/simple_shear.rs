//! Laws in rate form whose solution is known in simple shear, `F = [[1, gamma], [0, 1]]`.

#[cfg(test)]
use super::contract::ConstitutiveLaw;
use crate::exact::formula::Number;
use crate::exact::tensor::{Tensor, tensor};

/// Computes `P = tau F^-T` (Pa) for plane simple shear along the first axis; otherwise NaN.
/// `kirchhoff` returns components 11 and 12 of the trace-free Kirchhoff stress for gamma.
pub(super) fn piola_in_simple_shear<T: Number, const D: usize>(
    grad: &Tensor<T, D>,
    kirchhoff: impl FnOnce(T) -> [T; 2],
) -> Tensor<T, D> {
    let is_shear = |i: usize, j: usize| (i == 0 && j == 1) || grad[i][j].value() == 0.0;
    if D < 2 || !(0..D).all(|i| (0..D).all(|j| is_shear(i, j))) {
        return tensor(|_, _| T::from(f64::NAN));
    }
    let gamma = grad[0][1];
    let [normal, shear] = kirchhoff(gamma);
    tensor(|i, j| match (i, j) {
        (0, 0) => normal - shear * gamma,
        (0, 1) => shear,
        (1, 0) => shear + normal * gamma,
        (1, 1) => -normal,
        _ => T::from(0.0),
    })
}

/// Checks that the scene is two-dimensional. The error contains the reason and an alternative for
/// the suite.
pub(super) fn admit_a_plane(dimension: usize) -> Result<(), [&'static str; 2]> {
    if dimension == 2 {
        return Ok(());
    }
    Err([
        "the stress is a function of the deformation in simple shear only",
        "use a scene of dimension 2 with a displacement [\"gamma(t)*Y\", 0]",
    ])
}

/// Asserts components 11 and 12 of the Kirchhoff stress (Pa) in simple shear by `gamma`.
#[cfg(test)]
pub(super) fn assert_kirchhoff(law: &impl ConstitutiveLaw, gamma: f64, expected: [f64; 2]) {
    let piola = law.piola(&[[0.0, gamma], [0.0, 0.0]]);
    let tau11 = piola[0][0] + piola[0][1] * gamma;
    for (found, expected) in [(tau11, expected[0]), (piola[0][1], expected[1])] {
        approx::assert_abs_diff_eq!(found, expected, epsilon = 1e-10);
    }
    approx::assert_abs_diff_eq!(piola[1][1], -expected[0], epsilon = 1e-10);
    approx::assert_abs_diff_eq!(piola[1][0] + piola[1][1] * gamma, expected[1], epsilon = 1e-10);
    assert!(law.piola(&[[0.1, gamma], [0.0, 0.0]])[0][0].is_nan());
}

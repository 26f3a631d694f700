//! Test helpers for hyperelastic laws: stress along the axes, and stress as energy derivative.

use super::contract::ConstitutiveLaw;
use crate::exact::tensor::{Tensor, tensor, unit};
use approx::{assert_abs_diff_eq, assert_relative_eq};

/// Asserts `P = dW/dF`, and `W = 0` and `P = 0` at rest.
pub(super) fn assert_stress_is_derivative(law: &impl ConstitutiveLaw) {
    assert_stress_is_derivative_from(law, 0.0, 0.0);
}

/// Asserts `P = dW/dF`, and the energy (J/m3) and the mean stress (Pa, positive in compression) of
/// a body at rest.
pub(super) fn assert_stress_is_derivative_from(
    law: &impl ConstitutiveLaw,
    pressure: f64,
    stored: f64,
) {
    let energy = |grad: &Tensor<f64>| law.energy(grad).expect("an energy");
    let rest = [[0.0; 3]; 3];
    assert_abs_diff_eq!(energy(&rest), stored, epsilon = 1e-15 * law.modulus());
    let initial = law.piola(&rest);
    for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
        let expected = -pressure * unit::<f64>(i, j);
        assert_abs_diff_eq!(initial[i][j], expected, epsilon = 1e-14 * law.modulus());
    }
    // The energy equals the work of the mean stress, even for strains so small that differences of
    // numbers near 1 would lose digits.
    let small = [[2e-7, -1e-7, 5e-8], [3e-7, -2e-7, 1e-7], [0.0, 1.5e-7, 1e-7]];
    let stress = law.piola(&small);
    let mean = stress.iter().flatten().zip(initial.iter().flatten()).map(|(p, p0)| 0.5 * (p + p0));
    let work: f64 = mean.zip(small.iter().flatten()).map(|(p, slope)| p * slope).sum();
    assert_relative_eq!(energy(&small) - energy(&rest), work, max_relative = 1e-5);
    let grad = [[0.2, -0.1, 0.05], [0.3, -0.2, 0.1], [0.0, 0.15, 0.1]];
    let stress = law.piola(&grad);
    for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
        let at = |step: f64| {
            let mut grad = grad;
            grad[i][j] += step;
            energy(&grad)
        };
        let slope = (at(1e-6) - at(-1e-6)) / 2e-6;
        assert_relative_eq!(stress[i][j], slope, max_relative = 1e-7, epsilon = 1e-7);
    }
}

/// Asserts that `stretches` along the axes cause the stresses P `along` the axes, and that
/// `P(Q F) = Q P(F)` for a rotation by `angle` about the third axis.
pub(super) fn assert_stress_along_axes(
    law: &impl ConstitutiveLaw,
    stretches: [f64; 3],
    angle: f64,
    along: impl Fn(usize) -> f64,
    max_relative: f64,
) {
    let (c, s) = (libm::cos(angle), libm::sin(angle));
    let turn = [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]];
    let grad: Tensor<f64> = tensor(|i, j| turn[i][j] * stretches[j] - unit::<f64>(i, j));
    let found = law.piola(&grad);
    for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1), (2, 2)] {
        let wanted = turn[i][j] * along(j);
        assert_relative_eq!(found[i][j], wanted, max_relative = max_relative, epsilon = 1e-13);
    }
}

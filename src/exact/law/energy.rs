//! Stress as the derivative of an energy, for the tests of hyperelastic laws.

use super::contract::ConstitutiveLaw;
use crate::exact::tensor::{Tensor, cofactor, det, tensor, unit};
use approx::assert_relative_eq;

/// Asserts `P = dW/dF` of a law with the energy W (J/m3) as a function of F and `ln J`.
pub(super) fn assert_is_derivative(
    law: &impl ConstitutiveLaw,
    energy: impl Fn(&Tensor<f64>, f64) -> f64,
) {
    let grad = [[0.2, -0.1, 0.05], [0.3, -0.2, 0.1], [0.0, 0.15, 0.1]];
    let stress = law.piola(&grad);
    for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
        let at = |step: f64| {
            let mut f: Tensor<f64> = tensor(|a, b| grad[a][b] + unit::<f64>(a, b));
            f[i][j] += step;
            energy(&f, libm::log(det(&f, &tensor(|a, b| cofactor(&f, a, b)))))
        };
        let slope = (at(1e-6) - at(-1e-6)) / 2e-6;
        assert_relative_eq!(stress[i][j], slope, max_relative = 1e-7, epsilon = 1e-7);
    }
}

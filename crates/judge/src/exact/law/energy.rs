//! Tests of the energy of all laws, and of stresses in a closed form.

use super::contract::{ConstitutiveLaw, Lame};
use super::{
    CorotatedLaw, Equation, HenckyLaw, LinearFluidLaw, NeoHookeanLaw, PolytropicLaw,
    SmallStrainLaw, TaitLaw,
};
use crate::exact::tensor::{Tensor, tensor, unit};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use rstest::rstest;

pub(super) fn assert_stress_is_derivative(law: impl ConstitutiveLaw + Copy) {
    stress_is_the_derivative_of_the_energy(law, 0.0, 0.0);
}

/// Each case has the law, the mean pressure (Pa) and the energy (J/m3) of a body at rest.
#[rstest]
#[case::corotated(CorotatedLaw::new(50.0, 0.3), 0.0, 0.0)]
#[case::hencky(HenckyLaw::new(50.0, 0.3), 0.0, 0.0)]
#[case::linear_fluid(LinearFluidLaw::new(50.0), 0.0, 0.0)]
#[case::neo_hookean(NeoHookeanLaw::new(50.0, 0.3), 0.0, 0.0)]
#[case::polytropic(PolytropicLaw::new(50.0, 1.4), 50.0, 125.0)]
#[case::polytropic_and_steep(PolytropicLaw::new(50.0, 3.0), 50.0, 25.0)]
#[case::small_strain(SmallStrainLaw::new(50.0, 0.3), 0.0, 0.0)]
#[case::tait(TaitLaw::new(50.0, 0.0), 0.0, 0.0)]
fn stress_is_the_derivative_of_the_energy(
    #[case] law: impl ConstitutiveLaw + Copy,
    #[case] pressure: f64,
    #[case] stored: f64,
) {
    let energy = |grad: &Tensor<f64>| law.energy(grad).expect("an energy");
    let rest = [[0.0; 3]; 3];
    assert_abs_diff_eq!(energy(&rest), stored, epsilon = 1e-15 * law.modulus());
    let initial = law.piola(&rest);
    for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
        let expected = -pressure * unit::<f64>(i, j);
        assert_abs_diff_eq!(initial[i][j], expected, epsilon = 1e-14 * law.modulus());
    }
    // The energy equals the work of the mean stress, even for very small strains.
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

/// Along the axes, `P_ii = (lambda ln J + 2 mu ln s_i)/s_i` for the law of Hencky, and `P_ii = 2 mu
/// (s_i - 1) + lambda (J - 1) J/s_i` for the corotated law. `P(Q F) = Q P(F)`.
#[rstest]
fn stress_has_its_closed_form_along_the_axes(
    #[values([1.3, 0.6, 1.0], [1.2; 3], [4.0, 0.2, 1.0], [1.0 + 1e-9, 1.0, 1.0])] stretches: [f64;
        3],
    #[values(0.0, 0.7, 2.9)] angle: f64,
) {
    let Lame { lambda, mu } = Lame::new(50.0, 0.3);
    let (c, s) = (libm::cos(angle), libm::sin(angle));
    let turn = [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]];
    let grad: Tensor<f64> = tensor(|i, j| turn[i][j] * stretches[j] - unit::<f64>(i, j));
    let hencky = HenckyLaw::new(50.0, 0.3).piola(&grad);
    let corotated = CorotatedLaw::new(50.0, 0.3).piola(&grad);
    let log: f64 = stretches.iter().map(|stretch| libm::log(*stretch)).sum();
    let volume: f64 = stretches.iter().product();
    for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1), (2, 2)] {
        let stretch = stretches[j];
        let along = (lambda * log + 2.0 * mu * libm::log(stretch)) / stretch;
        let wanted = turn[i][j] * along;
        assert_relative_eq!(hencky[i][j], wanted, max_relative = 1e-11, epsilon = 1e-13);
        let along = 2.0 * mu * (stretch - 1.0) + lambda * (volume - 1.0) * volume / stretch;
        let wanted = turn[i][j] * along;
        assert_relative_eq!(corotated[i][j], wanted, max_relative = 1e-13, epsilon = 1e-13);
    }
}

#[rstest]
#[case::corotated(CorotatedLaw::new(50.0, 0.3))]
#[case::hencky(HenckyLaw::new(50.0, 0.3))]
fn vanishing_shear_still_has_a_derivative(#[case] law: impl Into<Equation>) {
    let mut second = [[[0.0; 3]; 3]; 3];
    second[0][1][1] = 1.0;
    let found = law.into().divergence(2, &[[0.0; 3]; 3], &second, None);
    assert_relative_eq!(found[0], Lame::new(50.0, 0.3).mu, max_relative = 1e-12);
}

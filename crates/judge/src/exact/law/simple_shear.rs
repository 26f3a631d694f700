//! Laws in rate form whose solution is known in simple shear, `F = [[1, gamma], [0, 1]]`.

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

/// Checks that the scene is two-dimensional. The error has the reason and an alternative.
pub(super) fn admit_a_plane(dimension: usize) -> Result<(), [&'static str; 2]> {
    if dimension == 2 {
        return Ok(());
    }
    Err([
        "the stress is a function of the deformation in simple shear only",
        "use a scene of dimension 2 with a displacement [\"gamma(t)*Y\", 0]",
    ])
}

#[cfg(test)]
mod tests {
    use crate::exact::law::contract::ConstitutiveLaw;
    use crate::exact::law::{GreenNaghdiLaw, JaumannLaw};
    use approx::assert_abs_diff_eq;
    use rstest::rstest;

    /// Each case has gamma, and components 11 and 12 of the Kirchhoff stress (Pa).
    #[rstest]
    #[case::jaumann(JaumannLaw::new(2.5, 0.25), 1.0, 0.459_697_694_1, 0.841_470_984_8)]
    #[case::jaumann_large(JaumannLaw::new(2.5, 0.25), 3.0, 1.989_992_496_6, 0.141_120_008_1)]
    #[case::green_naghdi(GreenNaghdiLaw::new(2.5, 0.25), 1.0, 0.415_900_087_2, 0.869_783_943_7)]
    #[case::green_naghdi_large(
        GreenNaghdiLaw::new(2.5, 0.25),
        3.0,
        1.766_203_744_6,
        1.817_834_265_2
    )]
    fn stress_matches_an_independent_program(
        #[case] law: impl ConstitutiveLaw + Copy,
        #[case] gamma: f64,
        #[case] normal: f64,
        #[case] shear: f64,
    ) {
        let piola = law.piola(&[[0.0, gamma], [0.0, 0.0]]);
        assert_abs_diff_eq!(piola[0][0] + piola[0][1] * gamma, normal, epsilon = 1e-10);
        assert_abs_diff_eq!(piola[0][1], shear, epsilon = 1e-10);
        assert_abs_diff_eq!(piola[1][1], -normal, epsilon = 1e-10);
        assert_abs_diff_eq!(piola[1][0] + piola[1][1] * gamma, shear, epsilon = 1e-10);
        assert!(law.piola(&[[0.1, gamma], [0.0, 0.0]])[0][0].is_nan());
    }
}

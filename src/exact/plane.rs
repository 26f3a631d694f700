//! Derivatives of a motion in a plane, completed by what happens across it.

use super::formula::{Number, Slope};
use super::law::Equation;
use super::motion::Derivatives;
use super::tensor::{Tensor, tensor};
use crate::subject::PlaneState;

/// Adds the displacement gradient across the plane, `F_33 - 1`, and its derivatives along the plane
/// to those of a motion in the plane.
pub(super) fn complete(
    plane: PlaneState,
    equation: &Equation,
    label: &[f64],
    now: &mut Derivatives,
) {
    match plane {
        PlaneState::Strain => {}
        PlaneState::Stress => {
            let varying: Tensor<Slope<2>, 2> = tensor(|i, j| {
                Slope::new(now.grad[i][j], [now.second[i][j][0], now.second[i][j][1]])
            });
            // A scene of a law that is not known there is refused.
            let Some(across) = equation.free_gradient(&varying) else { return };
            now.grad[2][2] = across.value();
            now.second[2][2] = [across.d(0), across.d(1), 0.0];
        }
        PlaneState::Axisymmetric => {
            let (radius, [along_r, along_z, _]) = (label[0], now.grad[0]);
            (now.grad[2][2], now.second[2][2]) = if radius == 0.0 {
                // The limits on the axis, where u_r = 0.
                let [along_rr, along_rz, _] = now.second[0][0];
                (along_r, [0.5 * along_rr, along_rz, 0.0])
            } else {
                let hoop = now.u[0] / radius;
                (hoop, [(along_r - hoop) / radius, along_z / radius, 0.0])
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{HenckyLaw, NeoHookeanLaw, SmallStrainLaw};
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// Nothing acts across a plate, and the stretch varies along it as its own difference says.
    #[rstest]
    fn a_plate_is_free_across(
        #[values(
            SmallStrainLaw::new(7.2, 0.3).into(),
            NeoHookeanLaw::new(7.2, 0.3).into(),
            NeoHookeanLaw::new(7.2, 0.0).into(),
            NeoHookeanLaw::new(7.2, -0.4).into(),
            NeoHookeanLaw::new(7.2, 0.4999).into(),
            HenckyLaw::new(7.2, 0.3).into(),
        )]
        law: Equation,
    ) {
        let at = |x: f64| {
            let grad = [[0.3 + 0.1 * x, 0.2, 0.0], [0.1, -0.2 - 0.5 * x, 0.0], [0.0; 3]];
            let mut now = Derivatives { grad, ..Derivatives::default() };
            (now.second[0][0][0], now.second[1][1][0]) = (0.1, -0.5);
            complete(PlaneState::Stress, &law, &[], &mut now);
            now
        };
        let here = at(0.0);
        let free = law.piola(&here.grad)[2][2].abs() < 1e-14 * law.modulus();
        assert!(free, "{:?}", law.piola(&here.grad));
        let slope = (at(1e-6).grad[2][2] - at(-1e-6).grad[2][2]) / 2e-6;
        assert_relative_eq!(here.second[2][2][0], slope, max_relative = 1e-8, epsilon = 1e-9);
    }

    /// On the axis the hoop and its slopes are the limits of those beside it: of
    /// `u_r = a r + b r^2 + c r z` the hoop `u_r/r` is `a + b r + c z`.
    #[rstest]
    fn the_hoop_is_smooth_on_the_axis(#[values(0.0, 1e-3, 0.5)] radius: f64) {
        let (a, b, c, z) = (0.1, 0.3, 0.2, 0.7);
        let mut now = Derivatives::default();
        now.u[0] = a * radius + b * radius * radius + c * radius * z;
        now.grad[0] = [a + 2.0 * b * radius + c * z, c * radius, 0.0];
        (now.second[0][0][0], now.second[0][0][1]) = (2.0 * b, c);
        let law = SmallStrainLaw::new(1.0, 0.0).into();
        complete(PlaneState::Axisymmetric, &law, &[radius, z], &mut now);
        assert_relative_eq!(now.grad[2][2], a + b * radius + c * z, max_relative = 1e-14);
        let [along_r, along_z, across] = now.second[2][2];
        assert_relative_eq!(along_r, b, max_relative = 1e-11);
        assert_relative_eq!(along_z, c, max_relative = 1e-14);
        assert_relative_eq!(across, 0.0);
    }
}

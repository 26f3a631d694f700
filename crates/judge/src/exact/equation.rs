//! Stresses and forces of an [`Equation`], and the out-of-plane derivatives of plane motions.

use super::expansion::{Swelling, piola};
use super::formula::Slope;
use super::law::Equation;
use super::motion::Derivatives;
use super::tensor::{Tensor, cofactor, in_space, pushed_forward, sum, tensor, unit, vector};
use mpm_subject::PlaneState;
use mpm_subject::with_dimension;

impl Equation {
    /// Whether the law is for finite strains, unlike small-strain laws.
    pub fn is_finite(&self) -> bool {
        self.small_strain_modulus().is_none()
    }

    /// Returns the Cauchy stress (Pa), `sigma = P F^T / J`. In small-strain theory, this is P.
    pub fn cauchy(&self, grad: &Tensor<f64>) -> Tensor<f64> {
        let piola = self.piola(grad);
        if !self.is_finite() {
            return piola;
        }
        pushed_forward(&piola, grad)
    }

    /// Returns `J F^-T N` (Nanson's formula), the current area vector of the `high` or low face
    /// along `axis` per unit reference area. N is the outward normal; for small strains, the result
    /// is N.
    pub fn present_area(&self, grad: &Tensor<f64>, axis: usize, high: bool) -> [f64; 3] {
        let outwards = if high { 1.0 } else { -1.0 };
        let f: Tensor<f64> = if self.is_finite() {
            tensor(|i, j| grad[i][j] + unit::<f64>(i, j))
        } else {
            tensor(unit)
        };
        std::array::from_fn(|i| outwards * cofactor(&f, i, axis))
    }

    /// Computes Div P (N/m3) from grad u and `second[k][a][b] = d2 u_k/dX_a dX_b`. The motion must
    /// vary only along the first `dimension` axes.
    pub(super) fn divergence(
        &self,
        dimension: usize,
        grad: &Tensor<f64>,
        second: &[Tensor<f64>; 3],
        swelling: Option<&Swelling>,
    ) -> [f64; 3] {
        with_dimension!(dimension, D => {
            let slopes = |i: usize, j: usize| vector(|axis| second[i][j][axis]);
            let varying: Tensor<Slope<D>, D> = tensor(|i, j| Slope::new(grad[i][j], slopes(i, j)));
            let theta = |all: &Swelling| Slope::new(all.theta, vector(|axis| all.grad[axis]));
            let stress = match swelling {
                None => self.piola(&varying),
                Some(swelling) => piola(self, &varying, theta(swelling)),
            };
            in_space::<D>(vector(|i| sum::<f64, D>(|j| stress[i][j].d(j))))
        })
    }
}

/// Adds `F_33 - 1` and its in-plane derivatives to the derivatives of a plane motion.
pub(super) fn complete_in_plane(
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
            // The scene has already been refused if the law does not support this state.
            let Some(across) = equation.free_gradient(&varying) else { return };
            now.grad[2][2] = across.value();
            now.second[2][2] = [across.d(0), across.d(1), 0.0];
        }
        PlaneState::Axisymmetric => {
            let (radius, [along_r, along_z, _]) = (label[0], now.grad[0]);
            (now.grad[2][2], now.second[2][2]) = if radius == 0.0 {
                // On the axis of revolution, where u_r = 0, the values are limits for r -> 0.
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

    /// Simple shear along X, u_X = g Y. The top face keeps its area and normal; the right face
    /// rotates, `n da = (1, -g) dA` (Nanson).
    #[test]
    fn side_face_of_a_sheared_body_rotates() {
        let g = 0.4;
        let grad = [[0.0, g, 0.0], [0.0; 3], [0.0; 3]];
        let law: Equation = NeoHookeanLaw::new(7.2, 0.3).into();
        assert_eq!(law.present_area(&grad, 1, true), [0.0, 1.0, 0.0]);
        assert_eq!(law.present_area(&grad, 0, true), [1.0, -g, 0.0]);
        assert_eq!(law.present_area(&grad, 0, false), [-1.0, g, 0.0]);
        let small: Equation = SmallStrainLaw::new(7.2, 0.3).into();
        assert_eq!(small.present_area(&grad, 0, true), [1.0, 0.0, 0.0]);
    }

    #[rstest]
    fn plate_has_no_out_of_plane_stress(
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
            complete_in_plane(PlaneState::Stress, &law, &[], &mut now);
            now
        };
        let here = at(0.0);
        let free = law.piola(&here.grad)[2][2].abs() < 1e-14 * law.modulus();
        assert!(free, "{:?}", law.piola(&here.grad));
        let slope = (at(1e-6).grad[2][2] - at(-1e-6).grad[2][2]) / 2e-6;
        assert_relative_eq!(here.second[2][2][0], slope, max_relative = 1e-8, epsilon = 1e-9);
    }

    /// On the axis, the hoop strain `u_r/r` of `u_r = a r + b r^2 + c r z` is `a + b r + c z`.
    #[rstest]
    fn the_hoop_is_smooth_on_the_axis(#[values(0.0, 1e-3, 0.5)] radius: f64) {
        let (a, b, c, z) = (0.1, 0.3, 0.2, 0.7);
        let mut now = Derivatives::default();
        now.u[0] = a * radius + b * radius * radius + c * radius * z;
        now.grad[0] = [a + 2.0 * b * radius + c * z, c * radius, 0.0];
        (now.second[0][0][0], now.second[0][0][1]) = (2.0 * b, c);
        let law = SmallStrainLaw::new(1.0, 0.0).into();
        complete_in_plane(PlaneState::Axisymmetric, &law, &[radius, z], &mut now);
        assert_relative_eq!(now.grad[2][2], a + b * radius + c * z, max_relative = 1e-14);
        let [along_r, along_z, across] = now.second[2][2];
        assert_relative_eq!(along_r, b, max_relative = 1e-11);
        assert_relative_eq!(along_z, c, max_relative = 1e-14);
        assert_relative_eq!(across, 0.0);
    }
}

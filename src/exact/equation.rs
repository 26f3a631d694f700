//! Stresses and forces of an [`Equation`], whatever its law.

use super::formula::Slope;
use super::law::Equation;
use super::tensor::{Tensor, cofactor, pushed_forward, sum, tensor, unit};

impl Equation {
    /// Whether strains are taken as they are; a theory of small strains has no deformed
    /// configuration.
    pub fn is_finite(&self) -> bool {
        self.small_strain_modulus().is_none()
    }

    /// Cauchy stress (Pa), `sigma = P F^T / J`. Theory of small strains does not tell it from P,
    /// which is what it is there.
    pub fn cauchy(&self, grad: &Tensor<f64>) -> Tensor<f64> {
        let piola = self.piola(grad);
        if !self.is_finite() {
            return piola;
        }
        pushed_forward(&piola, grad)
    }

    /// Present area vector of a unit of area on a face of the reference body, normal to `axis`,
    /// outwards on its `high` or low side: `J F^-T N` (Nanson's formula). Where strains are small,
    /// N.
    pub fn present_area(&self, grad: &Tensor<f64>, axis: usize, high: bool) -> [f64; 3] {
        let outwards = if high { 1.0 } else { -1.0 };
        let f: Tensor<f64> = if self.is_finite() {
            tensor(|i, j| grad[i][j] + unit::<f64>(i, j))
        } else {
            tensor(unit)
        };
        std::array::from_fn(|i| outwards * cofactor(&f, i, axis))
    }

    /// Div P (N/m3) from the gradient and its derivatives, `second[k][a][b] = d2 u_k/dX_a dX_b`,
    /// where nothing varies beyond the first `dimension` axes.
    pub fn divergence(
        &self,
        dimension: usize,
        grad: &Tensor<f64>,
        second: &[Tensor<f64>; 3],
    ) -> [f64; 3] {
        match dimension {
            1 => {
                let [x] = self.divergence_in(grad, second);
                [x, 0.0, 0.0]
            }
            2 => {
                let [x, y] = self.divergence_in(grad, second);
                [x, y, 0.0]
            }
            _ => self.divergence_in(grad, second),
        }
    }

    /// Div P in D dimensions: P once, with its slopes along all axes.
    fn divergence_in<const D: usize>(
        &self,
        grad: &Tensor<f64>,
        second: &[Tensor<f64>; 3],
    ) -> [f64; D] {
        let slopes = |i: usize, j: usize| std::array::from_fn(|axis| second[i][j][axis]);
        let varying: Tensor<Slope<D>, D> = tensor(|i, j| Slope::new(grad[i][j], slopes(i, j)));
        let stress = self.piola(&varying);
        std::array::from_fn(|i| sum::<f64, D>(|j| stress[i][j].d(j)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{HenckyLaw, NeoHookeanLaw, SmallStrainLaw};
    use rstest::rstest;

    /// Fewer dimensions are three with zeros.
    #[rstest]
    fn plane_and_uniaxial_strain_are_special_cases(
        #[values(
            SmallStrainLaw::new(7.2, 0.2).into(),
            NeoHookeanLaw::new(7.2, 0.2).into(),
            HenckyLaw::new(7.2, 0.2).into(),
        )]
        solid: Equation,
        #[values(1, 2)] dimension: usize,
    ) {
        let inside = |i: usize, j: usize, value| if i.max(j) < dimension { value } else { 0.0 };
        let grad: Tensor<f64> =
            tensor(|i, j| inside(i, j, [[0.2, -0.1], [0.3, -0.2]][i % 2][j % 2]));
        let second =
            std::array::from_fn(|k| tensor(|a, b| inside(k, a.max(b), 0.1 + (k + a + b) as f64)));
        let whole = solid.divergence(3, &grad, &second);
        assert!(whole[0] != 0.0, "something varies");
        assert_eq!(solid.divergence(dimension, &grad, &second), whole);
    }

    /// Simple shear along X, u_X = g Y: the top keeps its area and its normal, and the right end
    /// turns, `n da = (1, -g) dA` (Nanson).
    #[test]
    fn the_face_of_a_sheared_body_turns() {
        let g = 0.4;
        let grad = [[0.0, g, 0.0], [0.0; 3], [0.0; 3]];
        let law: Equation = NeoHookeanLaw::new(7.2, 0.3).into();
        assert_eq!(law.present_area(&grad, 1, true), [0.0, 1.0, 0.0]);
        assert_eq!(law.present_area(&grad, 0, true), [1.0, -g, 0.0]);
        assert_eq!(law.present_area(&grad, 0, false), [-1.0, g, 0.0]);
        let small: Equation = SmallStrainLaw::new(7.2, 0.3).into();
        assert_eq!(small.present_area(&grad, 0, true), [1.0, 0.0, 0.0]);
    }
}

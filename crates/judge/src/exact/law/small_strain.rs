//! Small-strain elasticity, `P = lambda tr(eps) I + 2 mu eps`, `eps = sym(grad u)`.

use super::contract::{ConstitutiveLaw, Lame};
use crate::exact::formula::Number;
use crate::exact::tensor::{Tensor, sum, tensor};

/// Small-strain elasticity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmallStrainLaw(Lame);

impl SmallStrainLaw {
    /// Creates the law from Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        Self(Lame::new(young, poisson))
    }
}

impl ConstitutiveLaw for SmallStrainLaw {
    const NAME: &'static str = "small_strain";
    const EQUATION: &'static str = "small strain, rho0 u_tt = Div P + rho0 b, P = C : sym(grad u)";

    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
        let (lambda, mu) = (T::from(self.0.lambda), T::from(self.0.mu));
        let pressure = lambda * sum::<T, D>(|i| grad[i][i]);
        tensor(|i, j| {
            let shear = mu * (grad[i][j] + grad[j][i]);
            if i == j { pressure + shear } else { shear }
        })
    }

    /// Computes `W = lambda/2 tr(eps)^2 + mu eps : eps`, which is half of `P : grad u`.
    fn energy(&self, grad: &Tensor<f64>) -> Option<f64> {
        let stress = self.piola(grad);
        let work = stress.iter().flatten().zip(grad.iter().flatten()).map(|(p, slope)| p * slope);
        Some(0.5 * work.sum::<f64>())
    }

    fn modulus(&self) -> f64 {
        self.0.modulus()
    }

    /// Uses `eps_33 = -lambda/(lambda + 2 mu) (eps_11 + eps_22)`.
    fn free_gradient<T: Number>(&self, grad: &Tensor<T, 2>) -> Option<T> {
        Some(T::from(-self.0.thinning()) * (grad[0][0] + grad[1][1]))
    }

    fn small_strain_modulus(&self) -> Option<f64> {
        Some(3.0 * self.0.lambda + 2.0 * self.0.mu)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::law::Equation;

    #[test]
    fn cauchy_stress_equals_p_for_small_strains() {
        let solid = Equation::from(SmallStrainLaw::new(100.0, 0.3));
        let grad = [[0.01, 0.02, 0.0], [0.0, -0.01, 0.0], [0.0; 3]];
        assert_eq!(solid.cauchy(&grad), solid.piola(&grad));
    }
}

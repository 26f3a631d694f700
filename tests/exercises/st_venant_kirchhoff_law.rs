//! St. Venant-Kirchhoff elasticity, `P = F S`, `S = lambda tr(E) I + 2 mu E`, `E = (F^T F - I)/2`
//! (Bonet & Wood 2008, section 6.3).

use super::contract::{ConstitutiveLaw, Lame};
use crate::exact::formula::Number;
use crate::exact::tensor::{Tensor, product, sum, tensor, unit};

/// St. Venant-Kirchhoff elasticity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StVenantKirchhoffLaw(Lame);

impl StVenantKirchhoffLaw {
    /// From Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        Self(Lame::new(young, poisson))
    }
}

impl ConstitutiveLaw for StVenantKirchhoffLaw {
    const NAME: &'static str = "st_venant_kirchhoff";
    const EQUATION: &'static str = "St. Venant-Kirchhoff, rho0 u_tt = Div P + rho0 b, \
        P = F (lambda tr(E) I + 2 mu E), E = (F^T F - I)/2";

    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
        let (lambda, mu) = (T::from(self.0.lambda), T::from(self.0.mu));
        let twice_strain: Tensor<T, D> =
            tensor(|i, j| grad[i][j] + grad[j][i] + sum::<T, D>(|k| grad[k][i] * grad[k][j]));
        let pressure = lambda * T::from(0.5) * sum::<T, D>(|i| twice_strain[i][i]);
        let s = tensor(|i, j| pressure * unit(i, j) + mu * twice_strain[i][j]);
        product(&tensor(|i, j| grad[i][j] + unit(i, j)), &s)
    }

    fn modulus(&self) -> f64 {
        self.0.modulus()
    }

    /// `W = lambda/2 tr(E)^2 + mu E : E`.
    fn energy(&self, grad: &Tensor<f64>) -> Option<f64> {
        let Lame { lambda, mu } = self.0;
        let strain: Tensor<f64> = tensor(|i, j| {
            let square = sum::<f64, 3>(|k| grad[k][i] * grad[k][j]);
            0.5 * (grad[i][j] + grad[j][i] + square)
        });
        let trace = sum::<f64, 3>(|i| strain[i][i]);
        let square: f64 = strain.iter().flatten().map(|component| component * component).sum();
        Some(0.5 * lambda * trace * trace + mu * square)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::law::energy::assert_stress_is_derivative;

    #[test]
    fn stress_is_the_derivative_of_the_energy() {
        assert_stress_is_derivative(StVenantKirchhoffLaw::new(50.0, 0.3));
    }
}

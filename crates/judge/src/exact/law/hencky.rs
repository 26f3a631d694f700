//! Hencky elasticity, `P = tau F^-T`, `tau = lambda tr(eps) I + 2 mu eps`, `eps = ln(F F^T)/2`
//! (Hencky 1928).

use super::contract::{ConstitutiveLaw, Lame};
use crate::exact::formula::Number;
use crate::exact::tensor::{Tensor, area, deformation, log_strain, product, sum, tensor, unit};

/// Hencky elasticity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HenckyLaw(Lame);

impl HenckyLaw {
    /// Creates the law from Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        Self(Lame::new(young, poisson))
    }
}

impl ConstitutiveLaw for HenckyLaw {
    const NAME: &'static str = "hencky";
    const EQUATION: &'static str =
        "Hencky, rho0 u_tt = Div P + rho0 b, P = (lambda ln(J) I + mu ln(F F^T)) F^-T";

    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
        let (lambda, mu) = (T::from(self.0.lambda), T::from(self.0.mu));
        let (f, cofactor, det) = deformation(grad);
        let (strain, pressure) = (log_strain(&f), lambda * Number::ln(det));
        let tau = tensor(|i, j| pressure * unit(i, j) + (mu + mu) * strain[i][j]);
        product(&tau, &tensor(|i, j| cofactor[i][j] / det))
    }

    /// Computes `W = lambda/2 ln(J)^2 + mu eps : eps`.
    fn energy(&self, grad: &Tensor<f64>) -> Option<f64> {
        let Lame { lambda, mu } = self.0;
        let f: Tensor<f64> = tensor(|i, j| grad[i][j] + unit::<f64>(i, j));
        let strain = log_strain(&f);
        let (trace, square) =
            (sum::<f64, 3>(|i| strain[i][i]), strain.iter().flatten().map(|e| e * e).sum::<f64>());
        Some(0.5 * lambda * trace * trace + mu * square)
    }

    fn modulus(&self) -> f64 {
        self.0.modulus()
    }

    /// Uses `eps_33 = -lambda/(lambda + 2 mu) ln J`, where J is the in-plane value.
    fn free_gradient<T: Number>(&self, grad: &Tensor<T, 2>) -> Option<T> {
        let strain = T::from(-self.0.thinning()) * Number::ln(area(grad));
        Some(Number::exp(strain) - T::from(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The stress is NaN for a stretch at which the series does not converge.
    #[test]
    fn an_extreme_stretch_with_shear_has_no_stress() {
        let mut grad = [[0.0; 3]; 3];
        grad[0] = [100.0, 1.0, 0.0];
        assert!(HenckyLaw::new(50.0, 0.3).piola(&grad)[0][0].is_nan());
    }
}
